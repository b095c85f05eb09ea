// SPDX-License-Identifier: GPL-3.0-or-later
/// The Earth in laboratory axes: gravity, and the direction of its rotation axis.
#pragma once

#include "earthtop/frames/degrees.hpp"
#include "earthtop/frames/rotation.hpp"
#include "earthtop/frames/site.hpp"

namespace earthtop {

/// Position of the site relative to the Earth's centre, in axes East, North, Up (m); its East component is zero.
Vec3<double> geocentric_position_L(double latitude_deg, double height_m);

/// The radius of curvature of the WGS 84 ellipsoid along the meridian (m).
double meridian_radius_m(double latitude_deg);

/// Gravitation alone (no centrifugal part) of the WGS 84 ellipsoid, in laboratory axes East, North, Up (m/s^2).
Vec3<double> gravitation_L(double latitude_deg, double height_m);

/// Minus the centrifugal term W x (W x r) at the site, in laboratory axes (m/s^2): gravitation_L plus this is normal gravity
/// along -Up. `Site::gravity_m_s2` already contains it, and it is added nowhere else.
Vec3<double> centrifugal_acceleration_L(double latitude_deg, double height_m);

/// Apparent gravity in laboratory axes (m/s^2): g along -Up, because the direction of apparent gravity defines Up.
template <class T>
Vec3<T> apparent_gravity_L(const Site& site) {
  return Vec3<T>(T(0), T(0), -T(site.gravity_m_s2));
}

/// The direction of the Earth's rotation axis in laboratory axes (unit vector) for a site whose pole or plumb line departs from
/// the ellipsoid's [earth_orientation.hpp].
template <class T>
Vec3<T> corrected_celestial_axis_L(const Site& site);
extern template Vec3<double> corrected_celestial_axis_L(const Site&);
extern template Vec3<float80> corrected_celestial_axis_L(const Site&);
extern template Vec3<float128> corrected_celestial_axis_L(const Site&);

/// The direction of the Earth's rotation axis in laboratory axes (unit vector): (0, cos phi, sin phi), exact at the poles and
/// the equator, unless the site has a departing pole or plumb line.
template <class T>
Vec3<T> celestial_axis_L(const Site& site) {
  if (!site.follows_ellipsoid()) return corrected_celestial_axis_L<T>(site);
  const SinCos<T> phi = sin_cos_degrees(T(site.latitude_deg));
  return Vec3<T>(T(0), phi.cos, phi.sin);
}

/// R_EL: attitude of the laboratory axes (East, North, Up at the site) in Earth-centred Earth-fixed axes (z along the rotation
/// axis).
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
