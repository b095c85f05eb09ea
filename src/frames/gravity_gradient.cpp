// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/frames/gravity_gradient.hpp"

#include <array>

namespace earthtop {

namespace {

// At 12 km depth the term of J_24 contributes e^24 (1 + 24 * 12 km / a) * 24^2, some 1e-25 of the whole gradient.
constexpr int kHarmonics = 12;  // J_2 to J_24
constexpr int kDegree = 2 * kHarmonics;

/// Coefficients C_n with V = GM sum_n C_n a^n P_n / r^(n+1): C_0 = 1, C_2k = -J_2k, and 0 for odd n.
std::array<double, kDegree + 1> zonal_coefficients() {
  const double a = kEquatorialRadiusWgs84, f = 1 / kInverseFlatteningWgs84, b = a * (1 - f);
  const double e2 = f * (2 - f), second_e2 = e2 / ((1 - f) * (1 - f)), second_e = real::sqrt(second_e2);
  const double m = kEarthRateWgs84 * kEarthRateWgs84 * a * a * b / kGravitationalConstantWgs84;
  // 2 q0 = (1 + 3/e'^2) atan e' - 3/e', summed as a series: the terms of the closed form cancel to a part in e'^4 [Heiskanen &
  // Moritz 2-58].
  double q0 = 0, power = second_e;
  for (int k = 1; k <= kHarmonics; ++k) {
    power *= -second_e2;
    q0 -= power * 2 * k / ((2 * k + 1.0) * (2 * k + 3.0));
  }
  const double J2 = e2 / 3 * (1 - 2.0 / 15 * m * second_e / q0);  // [2-90]
  std::array<double, kDegree + 1> C{};
  C[0] = 1;
  double minus_e2_to_k = 1;
  for (int k = 1; k <= kHarmonics; ++k) {
    minus_e2_to_k *= -e2;
    C[2 * static_cast<std::size_t>(k)] =
        minus_e2_to_k * 3 / ((2 * k + 1.0) * (2 * k + 3.0)) * (1 - k + 5 * k * J2 / e2);  // [2-92]
  }
  return C;
}

}  // namespace

Mat3<double> normal_gravity_gradient_L(double latitude_deg, double height_m) {
  static const std::array<double, kDegree + 1> C = zonal_coefficients();
  const Vec3<double> up = geocentric_up_L(latitude_deg, height_m);
  const auto [s, c] = sin_cos_degrees(latitude_deg);
  const double sine = c * up[1] + s * up[2], cosine = c * up[2] - s * up[1];  // sine and cosine of the geocentric latitude
  const double r = norm(geocentric_position_L(latitude_deg, height_m)), a_over_r = kEquatorialRadiusWgs84 / r;

  // With rho the distance from the axis, P_n/r^(n+1) has the derivatives
  //   (d/drho)/rho: -P'_(n+1)   d/dz d/drho: (n+1) cos P'_(n+2)   d/dz d/dz: (n+1)(n+2) P_(n+2),   each by r^-(n+3)
  // (Legendre polynomials of the sine of the geocentric latitude), so that nothing is singular at a pole. East is the direction
  // along the parallel.
  double along_parallel = 0, axial_radial = 0, axial = 0;
  double power = 1;
  std::array<double, kDegree + 3> P{1, sine}, slope{0, 1};
  for (std::size_t n = 2; n < P.size(); ++n) {
    const double k = static_cast<double>(n);
    P[n] = ((2 * k - 1) * sine * P[n - 1] - (k - 1) * P[n - 2]) / k;
    slope[n] = slope[n - 2] + (2 * k - 1) * P[n - 1];
  }
  for (std::size_t n = 0; n < C.size(); ++n, power *= a_over_r) {
    const double k = static_cast<double>(n), weight = C[n] * power;
    along_parallel -= weight * slope[n + 1];
    axial_radial += weight * (k + 1) * cosine * slope[n + 2];
    axial += weight * (k + 1) * (k + 2) * P[n + 2];
  }
  const double radial = -(along_parallel + axial);  // Laplace's equation

  // Transforms (away from the axis, along the axis) to North = (-s, c) and Up = (c, s).
  Mat3<double> G = Mat3<double>::Zero();
  G(0, 0) = along_parallel;
  G(1, 1) = s * s * radial - 2 * s * c * axial_radial + c * c * axial;
  G(2, 2) = c * c * radial + 2 * s * c * axial_radial + s * s * axial;
  G(1, 2) = G(2, 1) = s * c * (axial - radial) + (c * c - s * s) * axial_radial;
  return geocentric_gm_over_r3(latitude_deg, height_m) * G;
}

double geocentric_gm_over_r3(double latitude_deg, double height_m) {
  const double r = norm(geocentric_position_L(latitude_deg, height_m));
  return kGravitationalConstantWgs84 / (r * r * r);
}

Vec3<double> geocentric_up_L(double latitude_deg, double height_m) {
  const Vec3<double> r_L = geocentric_position_L(latitude_deg, height_m);
  return r_L / norm(r_L);
}

Mat3<double> spherical_gradient(double gm_over_r3, const Vec3<double>& up) {
  return gm_over_r3 * (3 * up * up.transpose() - Mat3<double>::Identity());
}

}  // namespace earthtop
