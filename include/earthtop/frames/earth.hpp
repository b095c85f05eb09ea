/// The Earth: constants with their sources, degree-exact sine and cosine, the laboratory's place and its apparent gravity.
#pragma once

#include "earthtop/frames/rotation.hpp"

namespace earthtop {

/// WGS 84 nominal rate of the Earth (rad/s) [NIMA TR8350.2].
inline constexpr double kEarthRateWgs84 = 7.292115e-5;
/// WGS 84 ellipsoid: equatorial radius (m), inverse flattening, geocentric gravitational constant (m^3/s^2) [NIMA TR8350.2].
inline constexpr double kEquatorialRadiusWgs84 = 6378137.0;
inline constexpr double kInverseFlatteningWgs84 = 298.257223563;
inline constexpr double kGravitationalConstantWgs84 = 3.986004418e14;

/// Sine and cosine of an angle in degrees; exact at every multiple of 90 degrees, so that a pole has no northward rate.
template <class T>
SinCos<T> sin_cos_degrees(T degrees) {
  T r = real::fmod(degrees, T(360));  // exact
  int quadrant = 0;
  while (r > T(45)) r -= T(90), ++quadrant;
  while (r < T(-45)) r += T(90), --quadrant;
  const T radians = r * real::pi<T>() / T(180);
  const auto [s, c] = real::sin_cos(radians);
  switch (((quadrant % 4) + 4) % 4) {
    case 0: return {s, c};
    case 1: return {c, T(0) - s};
    case 2: return {T(0) - s, T(0) - c};
    default: return {T(0) - c, s};
  }
}

/// The pole in Earth-fixed axes: x towards Greenwich, y towards 90 degrees WEST (arcsec) [IERS Conventions (2010), 5.4.1].
struct PolarMotion {
  double x_arcsec = 0;
  double y_arcsec = 0;
};

/// The plumb line's zenith less the ellipsoid's normal: xi towards North, eta towards East (arcsec), each the angle between the
/// normal and the zenith's projection onto that vertical plane. Astronomical latitude = geodetic + xi, astronomical longitude =
/// geodetic + eta / cos(latitude) to first order [Heiskanen & Moritz, ch. 2].
struct VerticalDeflection {
  double north_arcsec = 0;
  double east_arcsec = 0;
};

/// Where the laboratory stands. Geodetic latitude and longitude (deg), height above the ellipsoid (m), apparent gravity
/// (m/s^2); and how the Earth's pole and the plumb line depart from the ellipsoid's.
struct Site {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
  double gravity_m_s2 = 0;
  PolarMotion pole = {};
  VerticalDeflection deflection = {};
  /// Whether the pole is the ellipsoid's and Up its normal.
  bool follows_ellipsoid() const {
    return pole.x_arcsec == 0 && pole.y_arcsec == 0 && deflection.north_arcsec == 0 && deflection.east_arcsec == 0;
  }
};

/// The site seen from the Earth's centre, in axes East, North, Up (m): no East component.
Vec3<double> geocentric_position_L(double latitude_deg, double height_m);

/// Normal gravity of WGS 84 at a geodetic latitude (deg) and height (m): what a plumb line and a gravimeter feel,
/// centrifugal part included (m/s^2). [GeographicLib::NormalGravity]
double normal_gravity(double latitude_deg, double height_m);

/// Gravitation alone (no centrifugal part) of the WGS 84 ellipsoid, in laboratory axes East, North, Up (m/s^2).
Vec3<double> gravitation_L(double latitude_deg, double height_m);

/// The centrifugal acceleration W x (W x r) with its sign turned, at the site, in laboratory axes (m/s^2): gravitation_L +
/// this = normal gravity along -Up. It is inside `Site::gravity_m_s2` already and is counted nowhere else.
Vec3<double> centrifugal_acceleration_L(double latitude_deg, double height_m);

/// Apparent gravity in laboratory axes: g along -Up, since apparent gravity is what defines Up (m/s^2).
template <class T>
Vec3<T> apparent_gravity_L(const Site& site) {
  return Vec3<T>(T(0), T(0), -T(site.gravity_m_s2));
}

/// The direction of the Earth's rotation axis in laboratory axes where pole or plumb line depart from the ellipsoid's.
/// [earth_orientation.hpp]
template <class T>
Vec3<T> departing_celestial_axis_L(const Site& site);
extern template Vec3<double> departing_celestial_axis_L(const Site&);
extern template Vec3<long double> departing_celestial_axis_L(const Site&);
extern template Vec3<float128> departing_celestial_axis_L(const Site&);

/// The direction of the Earth's rotation axis in laboratory axes: (0, cos phi, sin phi), exact at the poles and the equator,
/// but for a departing pole or plumb line.
template <class T>
Vec3<T> celestial_axis_L(const Site& site) {
  if (!site.follows_ellipsoid()) return departing_celestial_axis_L<T>(site);
  const SinCos<T> phi = sin_cos_degrees(T(site.latitude_deg));
  return Vec3<T>(T(0), phi.cos, phi.sin);
}

/// R_EL: East, North, Up at the site, in Earth-centred Earth-fixed axes (z along the rotation axis).
template <class T>
Rotation<T> laboratory_attitude(const Site& site) {
  // E -> L: turn about z by longitude + 90 deg brings x to East, then about East by 90 deg - latitude brings z to Up.
  const SinCos<T> half_lon = sin_cos_degrees((T(site.longitude_deg) + T(90)) / T(2));
  const SinCos<T> half_colat = sin_cos_degrees((T(90) - T(site.latitude_deg)) / T(2));
  const Rotation<T> about_z(Quaternion<T>{half_lon.cos, Vec3<T>(T(0), T(0), half_lon.sin)});
  const Rotation<T> about_east(Quaternion<T>{half_colat.cos, Vec3<T>(half_colat.sin, T(0), T(0))});
  return about_z * about_east;
}

}  // namespace earthtop
