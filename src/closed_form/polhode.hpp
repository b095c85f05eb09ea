// SPDX-License-Identifier: GPL-3.0-or-later
/// The polhode: the path of the angular velocity of a free body in its principal axes. The axes are numbered and oriented so
/// that one formula holds for all cases, see `FreeBody`.
#pragma once

#include <array>
#include <utility>

#include "closed_form/carlson.hpp"
#include "closed_form/wider.hpp"
#include "earthtop/closed_form/free_body.hpp"

namespace earthtop {

/// A proper rotation that only exchanges axes and reverses some: v_P[i] = sign[i] v_B[index[i]].
struct AxisPermutation {
  std::array<int, 3> index = {0, 1, 2};
  std::array<int, 3> sign = {1, 1, 1};

  template <class T>
  Vec3<T> operator()(const Vec3<T>& v_B) const {
    return {T(sign[0]) * v_B[index[0]], T(sign[1]) * v_B[index[1]], T(sign[2]) * v_B[index[2]]};
  }
  template <class T>
  Vec3<T> inverse(const Vec3<T>& v_P) const {
    Vec3<T> v_B;
    for (std::size_t i = 0; i < 3; ++i) v_B[index[i]] = T(sign[i]) * v_P[static_cast<int>(i)];
    return v_B;
  }
  /// q_PB. The largest of w^2, x^2, y^2, z^2 is at least 1/4; the other components follow from its products with them.
  template <class T>
  Quaternion<T> quaternion() const {
    T R[3][3] = {};
    for (std::size_t i = 0; i < 3; ++i) R[i][index[i]] = T(sign[i]);
    const T trace = R[0][0] + R[1][1] + R[2][2];
    if (trace >= T(0))
      return Quaternion<T>{T(1) + trace, Vec3<T>(R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1])}.normalized();
    const int i = R[0][0] >= R[1][1] && R[0][0] >= R[2][2] ? 0 : R[1][1] >= R[2][2] ? 1 : 2, j = (i + 1) % 3, k = (i + 2) % 3;
    Quaternion<T> q;
    q.w = R[k][j] - R[j][k];
    q.v[i] = T(1) + R[i][i] - R[j][j] - R[k][k];
    q.v[j] = R[j][i] + R[i][j];
    q.v[k] = R[k][i] + R[i][k];
    return q.normalized();
  }
};

template <class W>
struct Polhode {
  FreeBodyRegime regime = FreeBodyRegime::at_rest;
  AxisPermutation from_body;
  W s = W(1);                ///< sign(C - B)
  Vec3<W> rate_amplitude;    ///< w1m, w2m, w3m (rad/s)
  Vec3<W> direction;         ///< A w1m / L, B w2m / L, C w3m / L
  W p = W(0);                ///< rate of the elliptic argument (1/s)
  W u0 = W(0);               ///< the elliptic argument at t = 0; at most a quarter period away from 0
  W m = W(0), m1 = W(1);     ///< parameter of the elliptic functions and its complement
  W tangent_squared = W(0);  ///< eta = F(atan(sqrt(tangent_squared)) | m1), where dn(i eta) = L / (C w3m)
  W momentum_rate = W(0);    ///< dpsi/dt where dn = 1 (rad/s)
  W separation = W(1);       ///< |L^2 - 2 T B| over the sum of the magnitudes of its two terms
  bool separation_is_exact = true;
  W largest_ratio = W(1);  ///< largest over smallest moment
  W condition = W(1);      ///< largest relative change of p and of L^2 - 2 T B over the relative change of tensor and rate that
                           ///< causes it
};

/// One term I |I - B| w^2 of the number that decides which axis the rate circles: L^2 - 2 T B = C (C - B) w3^2 + A (A - B)
/// w1^2. It is the only difference in the whole solution that can cancel. As a sum of two numbers of 113 bits the term is exact
/// if its factors are doubles.
struct SeparationTerm {
  float128 high, low;
  bool exact;

  SeparationTerm(float128 I, float128 B, float128 w) {
    const float128 difference = I - B, moved = difference - I, lost = (I - (difference - moved)) - (B + moved);
    const float128 factor = I * real::abs(difference), square = w * w;
    high = factor * square;
    low = real::fma(factor, square, -high);
    exact = lost == 0 && real::fma(I, real::abs(difference), -factor) == 0 && real::fma(w, w, -square) == 0;
  }
};

/// @param moments  principal moments along the axes B   @param w0_B  neither zero nor along a principal axis; not all moments
/// equal
template <class W>
Polhode<W> make_polhode(const Vec3<W>& moments, const Vec3<W>& w0_B) {
  std::array<int, 3> sorted = {0, 1, 2};
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}})
    if (moments[sorted[static_cast<std::size_t>(j)]] < moments[sorted[static_cast<std::size_t>(i)]])
      std::swap(sorted[static_cast<std::size_t>(i)], sorted[static_cast<std::size_t>(j)]);
  const auto [low, middle, high] = sorted;
  const SeparationTerm low_term(moments[low], moments[middle], w0_B[low]),
      high_term(moments[high], moments[middle], w0_B[high]);
  const float128 difference = (high_term.high - low_term.high) + (high_term.low - low_term.low);

  Polhode<W> f;
  bool around_high = difference >= 0;
  if (moments[low] == moments[middle] || moments[middle] == moments[high]) {
    f.regime = FreeBodyRegime::symmetric;
    around_high = moments[low] == moments[middle];
  } else {
    f.regime = difference == 0 ? FreeBodyRegime::separatrix
               : around_high   ? FreeBodyRegime::around_largest
                               : FreeBodyRegime::around_smallest;
    f.separation = static_cast<W>(real::abs(difference) / (high_term.high + low_term.high));
    f.separation_is_exact = low_term.exact && high_term.exact;
  }
  const int axis1 = around_high ? low : high, axis3 = around_high ? high : low;
  const int parity = middle == (axis1 + 1) % 3 ? 1 : -1;
  const int sign1 = w0_B[axis1] < W(0) ? -1 : 1, sign3 = w0_B[axis3] < W(0) ? -1 : 1;
  f.from_body = {{axis1, middle, axis3}, {sign1, parity * sign1 * sign3, sign3}};

  const Vec3<W> w = f.from_body(w0_B);
  f.largest_ratio = moments[high] / moments[low];
  const W A = moments[axis1], B = moments[middle], C = moments[axis3];
  const W CA = real::abs(C - A), CB = real::abs(C - B), BA = real::abs(B - A);
  f.s = C > B ? W(1) : W(-1);
  // |2 T C - L^2| and |L^2 - 2 T A|.
  const W a = A * CA * w[0] * w[0] + B * CB * w[1] * w[1], b = B * BA * w[1] * w[1] + C * CA * w[2] * w[2];
  f.rate_amplitude = Vec3<W>(real::sqrt(a / (A * CA)), real::sqrt(a / (B * CB)), real::sqrt(b / (C * CA)));
  const W L = norm(Vec3<W>(A * w[0], B * w[1], C * w[2]));
  const W twice_T = A * w[0] * w[0] + B * w[1] * w[1] + C * w[2] * w[2];
  f.direction = Vec3<W>(A * f.rate_amplitude[0], B * f.rate_amplitude[1], C * f.rate_amplitude[2]) / L;
  f.p = real::sqrt(CB * b / (A * B * C));
  if (f.regime != FreeBodyRegime::symmetric) {
    f.m = BA * a / (CB * b);
    f.m1 = CA * static_cast<W>(real::abs(difference)) / (CB * b);
    f.tangent_squared = A * CB / (C * BA);
    // The principal axes found for a tensor are rotated by an error of eps largest / difference, and the rate's components with
    // them.
    const W of_1 = A * BA * w[0] * w[0], of_3 = C * CB * w[2] * w[2], to_1 = moments[high] / BA, to_3 = moments[high] / CB;
    const W of_rate = norm(w) * (to_1 + to_3) * (A * BA * w[0] + C * CB * w[2]);
    f.condition = to_3 + f.m * to_1 + (of_3 * to_3 + of_1 * to_1 + of_rate) / ((of_1 + of_3) * f.separation);
  }
  f.momentum_rate = (twice_T + L * f.rate_amplitude[2]) / (L + C * f.rate_amplitude[2]);
  // cn >= 0 because w1 >= 0: |u0| is at most a quarter period.
  const W sn = f.rate_amplitude[1] > W(0) ? f.s * w[1] / f.rate_amplitude[1] : W(0);
  const W cn = f.rate_amplitude[0] > W(0) ? w[0] / f.rate_amplitude[0] : W(1);
  const W dn = f.rate_amplitude[2] > W(0) ? w[2] / f.rate_amplitude[2] : W(1);
  // The test excludes NaN, for which the duplication of the integral would never end.
  if (real::abs(sn) > W(0) && cn * cn + dn * dn > W(0)) f.u0 = sn * elliptic::carlson_rf<W>(cn * cn, dn * dn, W(1));
  return f;
}

}  // namespace earthtop
