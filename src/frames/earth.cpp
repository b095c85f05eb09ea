// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/earth.hpp"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/NormalGravity.hpp>

namespace earthtop {

Vec3<double> geocentric_position_L(double latitude_deg, double height_m) {
  const auto [s, c] = sin_cos_degrees(latitude_deg);
  // Along the ellipsoid's normal, from the point where it meets the axis, e^2 N s below the centre: no digits are lost at any
  // height.
  const double f = 1 / kInverseFlatteningWgs84, e2 = f * (2 - f);
  const double N = kEquatorialRadiusWgs84 / real::sqrt(1 - e2 * s * s);
  return {0.0, -e2 * N * s * c, N * (1 - e2 * s * s) + height_m};
}

double meridian_radius_m(double latitude_deg) {
  const double s = sin_cos_degrees(latitude_deg).sin, f = 1 / kInverseFlatteningWgs84, e2 = f * (2 - f), q = 1 - e2 * s * s;
  return kEquatorialRadiusWgs84 * (1 - e2) / (q * real::sqrt(q));
}

double normal_gravity(double latitude_deg, double height_m) {
  double north = 0, up = 0;
  GeographicLib::NormalGravity::WGS84().Gravity(latitude_deg, height_m, north, up);
  return real::hypot(north, up);
}

namespace {

/// Transforms a vector from Earth-centred axes at longitude 0 (x outwards in the meridian, z along the axis) to East, North,
/// Up.
Vec3<double> to_laboratory(double latitude_deg, double x, double z) {
  const auto [s, c] = sin_cos_degrees(latitude_deg);
  return {0.0, -s * x + c * z, c * x + s * z};
}

}  // namespace

Vec3<double> gravitation_L(double latitude_deg, double height_m) {
  double X = 0, Y = 0, Z = 0;
  GeographicLib::Geocentric::WGS84().Forward(latitude_deg, 0.0, height_m, X, Y, Z);
  double gX = 0, gY = 0, gZ = 0;
  GeographicLib::NormalGravity::WGS84().V0(X, Y, Z, gX, gY, gZ);
  return to_laboratory(latitude_deg, gX, gZ);
}

Vec3<double> centrifugal_acceleration_L(double latitude_deg, double height_m) {
  double X = 0, Y = 0, Z = 0;
  GeographicLib::Geocentric::WGS84().Forward(latitude_deg, 0.0, height_m, X, Y, Z);
  return to_laboratory(latitude_deg, kEarthRateWgs84 * kEarthRateWgs84 * X, 0.0);
}

}  // namespace earthtop
