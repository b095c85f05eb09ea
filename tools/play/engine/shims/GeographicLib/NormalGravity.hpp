// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of GeographicLib's NormalGravity that the core library uses: the closed formulas of Heiskanen and Moritz, Physical Geodesy
/// (1967), section 2-7, which GeographicLib uses as well.
#pragma once

#include "Geocentric.hpp"

namespace GeographicLib {

class NormalGravity {
 public:
  static NormalGravity WGS84() { return {}; }
  /// Gravity (m/s^2) of the rotating ellipsoid, to the North and upwards.
  void Gravity(double latitude_deg, double height_m, double& north, double& up) const {
    const SineAndCosine at(latitude_deg);
    const float80 N = Wgs84::a / std::sqrt(1 - Wgs84::e2 * at.s * at.s);
    const float80 X = (N + height_m) * at.c;
    Plane g = attraction(X, (N * (1 - Wgs84::e2) + height_m) * at.s);
    g.X += Wgs84::omega * Wgs84::omega * X;
    north = static_cast<double>(-at.s * g.X + at.c * g.Z);
    up = static_cast<double>(at.c * g.X + at.s * g.Z);
  }
  /// The attraction alone (m/s^2) at a place of longitude 0. @returns nothing: the potential is not computed
  void V0(double X, double /*Y*/, double Z, double& gX, double& gY, double& gZ) const {
    const Plane g = attraction(X, Z);
    gX = static_cast<double>(g.X);
    gY = 0;
    gZ = static_cast<double>(g.Z);
  }

 private:
  struct Plane {  ///< in the plane of the meridian
    float80 X, Z;
  };
  /// H. and M.'s q (2-57) and q' (2-67), at the ellipsoid whose semi-minor axis is u.
  static float80 q(float80 u, float80 E) { return ((1 + 3 * u * u / (E * E)) * std::atan(E / u) - 3 * u / E) / 2; }
  static float80 q_prime(float80 u, float80 E) { return 3 * (1 + u * u / (E * E)) * (1 - u / E * std::atan(E / u)) - 1; }
  /// The gradient of the potential (2-62) in the coordinates u and beta, with X = sqrt(u^2 + E^2) cos beta and Z = u sin beta.
  static Plane attraction(float80 X, float80 Z) {
    const float80 E2 = Wgs84::E2, E = std::sqrt(E2), b = Wgs84::b;
    const float80 rest = X * X + Z * Z - E2, u = std::sqrt((rest + std::sqrt(rest * rest + 4 * E2 * Z * Z)) / 2);
    const float80 v = std::sqrt(u * u + E2), s = Z / u, c = X / v;
    const float80 w2 = (u * u + E2 * s * s) / (v * v), turning = Wgs84::omega * Wgs84::omega * Wgs84::a * Wgs84::a / q(b, E);
    const float80 by_u = -(Wgs84::GM + turning * E * q_prime(u, E) * (s * s - 1.0L / 3) / 2) / (v * v);
    const float80 by_beta = turning * q(u, E) * s * c / v;
    return {(by_u * u / v * c - by_beta * s) / w2, (by_u * s + by_beta * u / v * c) / w2};
  }
};

}  // namespace GeographicLib
