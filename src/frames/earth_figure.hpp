// SPDX-License-Identifier: GPL-3.0-or-later
/// The figure of the Earth and its normal gravity as formulas on a scalar or a power series.
#pragma once

#include "earthtop/frames/site.hpp"
#include "earthtop/frames/travel_spec.hpp"
#include "frames/power_series.hpp"

namespace earthtop {

/// The flattening of WGS 84 and its rate (rad/s) to the digits of T: the decimals that define them are no doubles.
template <class T>
T flattening_wgs84() {
  return T(1'000'000'000) / T(298'257'223'563);
}
template <class T>
T earth_rate_wgs84() {
  return T(7'292'115) / T(100'000'000'000);
}

/// The ellipsoid of WGS 84, or a sphere.
template <class T>
class EarthFigure {
 public:
  explicit EarthFigure(const TravelSpec& spec)
      : is_sphere_(spec.figure == TravelFigure::sphere), radius_(is_sphere_ ? spec.radius_m : kEquatorialRadiusWgs84) {}

  /// The radii of curvature along the meridian and across it, from the sine of the latitude (m).
  void radii(const PowerSeries<T>& sin_latitude, PowerSeries<T>& meridian, PowerSeries<T>& prime) const {
    using Series = PowerSeries<T>;
    if (is_sphere_) {
      meridian = prime = Series(T(radius_));
      return;
    }
    const T f = flattening_wgs84<T>(), e2 = f * (T(2) - f);
    const Series q = Series(T(1)) - Series(e2) * sin_latitude * sin_latitude;
    prime = Series(T(radius_)) / sqrt(q);
    meridian = prime * Series(T(1) - e2) / q;
  }
  /// A bound of both (m).
  double largest_radius() const { return is_sphere_ ? radius_ : 1.01 * radius_; }

 private:
  bool is_sphere_;
  double radius_;
};

/// Normal gravity of WGS 84, its size, in ellipsoidal coordinates [Heiskanen & Moritz, Physical Geodesy, section 2-7..2-8].
/// @tparam S  a power series of T   @param height  (m)
template <class T, class S>
S normal_gravity_of(const S& sin_latitude, const S& cos_latitude, const S& height) {
  const T a = T(kEquatorialRadiusWgs84), f = flattening_wgs84<T>(), e2 = f * (T(2) - f), b = a * (T(1) - f);
  const T E2 = a * a * e2, GM = T(kGravitationalConstantWgs84), w = earth_rate_wgs84<T>();
  // q and q' as series in x = E/u, since their closed forms cancel.
  constexpr int kTerms = 18;
  const auto sums = [&](const S& x2, S& q_over_x, S& q1) {
    q_over_x = q1 = S(T(0));
    for (int k = kTerms; k >= 1; --k) {
      const T sign = T(k % 2 == 1 ? 1 : -1), both = T((2 * k + 1) * (2 * k + 3));
      q_over_x = x2 * (S(sign * T(2 * k) / both) + q_over_x);
      q1 = x2 * (S(sign * T(6) / both) + q1);
    }
  };
  const S N = S(a) / sqrt(S(S(T(1)) - S(e2) * sin_latitude * sin_latitude));
  const S X = (N + height) * cos_latitude, Z = (S(T(1) - e2) * N + height) * sin_latitude;
  const S A = X * X + Z * Z - S(E2);
  const S u2 = S(T(1) / T(2)) * (A + sqrt(S(A * A + S(T(4) * E2) * Z * Z))), v2 = u2 + S(E2);
  const S sin2 = Z * Z / u2, cos2 = X * X / v2;  // of the reduced latitude
  const S sin_cos_beta = X * Z / sqrt(S(u2 * v2));
  const S u = sqrt(u2), v = sqrt(v2);
  S q_over_x, q1, q0_over_x, unused;
  sums(S(E2) / u2, q_over_x, q1);
  sums(S(E2 / (b * b)), q0_over_x, unused);
  const S ratio = q_over_x / q0_over_x * (S(b) / u);          // q/q0
  const S ratio1 = q1 / (q0_over_x * S(real::sqrt(E2) / b));  // q'/q0
  const S W2 = (u2 + S(E2) * sin2) / v2;
  const S along_u = S(T(0)) -
                    (S(GM) + S(w * w * a * a * real::sqrt(E2)) * ratio1 * (S(T(1) / T(2)) * sin2 - S(T(1) / T(6)))) / v2 +
                    S(w * w) * u * cos2;
  const S along_beta = (S(w * w * a * a) * ratio / v - S(w * w) * v) * sin_cos_beta;
  return sqrt(S((along_u * along_u + along_beta * along_beta) / W2));
}

}  // namespace earthtop
