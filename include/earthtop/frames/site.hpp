// SPDX-License-Identifier: GPL-3.0-or-later
/// The laboratory's position on the Earth as a scenario gives it, and the Earth's constants with their sources.
#pragma once

namespace earthtop {

/// WGS 84 nominal rate of the Earth (rad/s) [NIMA TR8350.2].
inline constexpr double kEarthRateWgs84 = 7.292115e-5;
/// WGS 84 ellipsoid: equatorial radius (m), inverse flattening, geocentric gravitational constant (m^3/s^2) [NIMA TR8350.2].
inline constexpr double kEquatorialRadiusWgs84 = 6378137.0;
inline constexpr double kInverseFlatteningWgs84 = 298.257223563;
inline constexpr double kGravitationalConstantWgs84 = 3.986004418e14;

/// The pole in Earth-fixed axes: x towards Greenwich, y towards 90 degrees WEST (arcsec) [IERS Conventions (2010), 5.4.1].
struct PolarMotion {
  double x_arcsec = 0;
  double y_arcsec = 0;
  bool operator==(const PolarMotion&) const = default;
};

/// Deflection of the vertical: the zenith of the plumb line relative to the ellipsoid's normal, xi towards North and eta
/// towards East (arcsec), each the angle between the normal and the projection of the zenith onto that vertical plane. To first
/// order astronomical latitude = geodetic latitude + xi, astronomical longitude = geodetic longitude + eta / cos(latitude)
/// [Heiskanen & Moritz, ch. 2].
struct VerticalDeflection {
  double north_arcsec = 0;
  double east_arcsec = 0;
  bool operator==(const VerticalDeflection&) const = default;
};

/// The laboratory's site: geodetic latitude and longitude (deg), height above the ellipsoid (m), apparent gravity (m/s^2), and
/// how the Earth's pole and the plumb line depart from the ellipsoid's.
struct Site {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
  double gravity_m_s2 = 0;
  PolarMotion pole = {};
  VerticalDeflection deflection = {};
  bool operator==(const Site&) const = default;
  /// Whether the pole is the ellipsoid's axis and Up is the ellipsoid's normal.
  bool follows_ellipsoid() const {
    return pole.x_arcsec == 0 && pole.y_arcsec == 0 && deflection.north_arcsec == 0 && deflection.east_arcsec == 0;
  }
};

/// Normal gravity of WGS 84 at a geodetic latitude (deg) and height (m), centrifugal part included (m/s^2): the model value of
/// what a plumb line and a gravimeter measure. [GeographicLib::NormalGravity]
double normal_gravity(double latitude_deg, double height_m);

}  // namespace earthtop
