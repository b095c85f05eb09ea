// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of GeographicLib's Geocentric that the core library uses. Computed in 128 bits and rounded once, so that the numbers agree
/// with GeographicLib's to their last digit or the one before.
#pragma once

#include <cmath>

namespace GeographicLib {

/// WGS 84 [NIMA TR8350.2]; lengths in m.
struct Wgs84 {
  static constexpr float80 a = 6378137, f = 1 / 298.257223563L, GM = 3986004.418e8L, omega = 7292115e-11L;
  static constexpr float80 e2 = f * (2 - f), b = a * (1 - f), E2 = a * a * e2;  ///< E: half the distance of the foci
};

/// The sine and cosine of an angle in degrees, exact at multiples of 90 degrees.
struct SineAndCosine {
  explicit SineAndCosine(float80 deg)
      : s(deg == 0 ? 0 : std::sin(deg * kDegree)), c(std::fabs(deg) == 90 ? 0 : std::cos(deg * kDegree)) {}
  static constexpr float80 kDegree = 3.14159265358979323846264338327950288L / 180;
  float80 s, c;
};

class Geocentric {
 public:
  static Geocentric WGS84() { return {}; }
  /// Earth-centred coordinates (m). The longitude is 0 wherever the core library asks.
  void Forward(double latitude_deg, double /*longitude_deg*/, double height_m, double& X, double& Y, double& Z) const {
    const SineAndCosine at(latitude_deg);
    const float80 N = Wgs84::a / std::sqrt(1 - Wgs84::e2 * at.s * at.s);
    X = static_cast<double>((N + height_m) * at.c);
    Y = 0;
    Z = static_cast<double>((N * (1 - Wgs84::e2) + height_m) * at.s);
  }
};

}  // namespace GeographicLib
