// SPDX-License-Identifier: GPL-3.0-or-later
/// The direction of the Earth's rotation axis in the laboratory if the pole is not at the z axis of the Earth-fixed frame or
/// the plumb line is not the ellipsoid's normal; and how the Earth's rate and axis change.
#pragma once

#include "earthtop/frames/earth.hpp"
#include "earthtop/frames/utc_instant.hpp"

namespace earthtop {

template <class T>
T arcsec_to_rad(double arcsec) {
  return T(arcsec) * real::pi<T>() / T(648000);
}

/// The rotation axis in Earth-fixed axes: R1(-y) R2(-x) applied to the z axis, which is (x, -y, 1) to first order [IERS
/// Conventions (2010), 5.4.1].
template <class T>
Vec3<T> celestial_axis_E(const PolarMotion& pole) {
  const T x = arcsec_to_rad<T>(pole.x_arcsec), y = arcsec_to_rad<T>(pole.y_arcsec);
  return {real::sin(x), -real::sin(y) * real::cos(x), real::cos(y) * real::cos(x)};
}

/// R_GL: attitude of the laboratory axes in geodetic East, North, Up (G). The laboratory's Up is the zenith of the plumb line,
/// (tan eta, tan xi, 1) / norm. R_GL is the smallest rotation that takes the ellipsoid's normal there, so that azimuths stay
/// geodetic to first order. Astronomical north lies west of the laboratory's North by eta tan(latitude): this is Laplace's
/// correction, and the East component of the Earth's rotation.
template <class T>
Rotation<T> plumb_line_attitude(const VerticalDeflection& deflection) {
  const T xi = arcsec_to_rad<T>(deflection.north_arcsec), eta = arcsec_to_rad<T>(deflection.east_arcsec);
  const T east = real::sin(eta) / real::cos(eta), north = real::sin(xi) / real::cos(xi);
  return Rotation<T>(Quaternion<T>{T(1) + real::hypot(east, north, T(1)), Vec3<T>(-north, east, T(0))});
}

/// The direction of the Earth's rotation axis in laboratory axes. `site` holds geodetic coordinates. If pole and deflection are
/// zero, the result equals that of celestial_axis_L(site) bit for bit.
template <class T>
Vec3<T> celestial_axis_L(const Site& site, const PolarMotion& pole, const VerticalDeflection& deflection) {
  const SinCos<T> phi = sin_cos_degrees(T(site.latitude_deg)), lambda = sin_cos_degrees(T(site.longitude_deg));
  const Vec3<T> n_E = celestial_axis_E<T>(pole);
  const T out = lambda.cos * n_E[0] + lambda.sin * n_E[1];  // component in the site's meridian plane, away from the axis
  const Vec3<T> n_G(lambda.cos * n_E[1] - lambda.sin * n_E[0], phi.cos * n_E[2] - phi.sin * out,
                    phi.sin * n_E[2] + phi.cos * out);
  return plumb_line_attitude<T>(deflection).inverse() * n_G;
}

/// The Earth's rate if a day is longer than 86400 s by `excess_s`: nominal (1 - excess / 86400). This first-order formula
/// defines the excess and so is exact [IERS: omega = Omega_N (1 - D/86400 s)].
/// @param nominal  rate for a day without excess (rad/s): 7.292115146706979e-5 rad/s
template <class T>
T earth_rate_with_length_of_day(T nominal, T excess_s) {
  return nominal * (T(1) - excess_s / T(86400));
}

/// The secular pole, used if no pole was measured: the true pole moves about it by up to some 0.3 arcsec with periods of 433
/// and 365 days [IERS Conventions (2010) v1.3.0, 7.1.4, eq. 21].
/// @param julian_epoch_year  e.g. 2026.5
constexpr PolarMotion secular_pole(double julian_epoch_year) {
  const double years = julian_epoch_year - 2000;
  return {0.0550 + 0.001677 * years, 0.3205 + 0.003460 * years};
}

/// The angular velocity with which precession turns the Earth's mean axis, in celestial axes (rad/s): normal to the axis,
/// 3.1e-12 rad/s. The part along the axis is contained in the Earth's rate. Nutation is left out: it is of the same size, but
/// goes to and fro within weeks to years. [IAU 2006, ERFA; difference over two years]
Vec3<double> precession_rate_I(const UtcInstant& utc);
/// The same in laboratory axes (geodetic East, North, Up) at that instant (rad/s).
Vec3<double> precession_rate_L(const Site& site, const UtcInstant& utc);

}  // namespace earthtop
