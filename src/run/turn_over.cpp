// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/turn_over.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "earthtop/elementary.hpp"

namespace earthtop {

std::optional<Moments> three_moments(const Mat3<double>& I_BP_B) {
  if (I_BP_B(0, 1) != 0 || I_BP_B(0, 2) != 0 || I_BP_B(1, 2) != 0) return std::nullopt;
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return I_BP_B(i, i) < I_BP_B(j, j); });
  const auto [a, b, c] = order;
  const Moments moments{I_BP_B(a, a), I_BP_B(b, b), I_BP_B(c, c), a, b, c};
  constexpr double kApart = 0.01;
  if (moments.B - moments.A < kApart * moments.B || moments.C - moments.B < kApart * moments.B) return std::nullopt;
  return moments;
}

std::optional<TurnOver> turn_over(const Moments& m, const Vec3<double>& w_B) {
  constexpr double kMostAcross = 0.1, kSecondOrder = 3, kNone = 1e-15;
  const double spin = m.handed() * w_B[m.b];
  const double x = std::sqrt(m.A * (m.B - m.A)) * w_B[m.a], y = std::sqrt(m.C * (m.C - m.B)) * w_B[m.c];
  const double most = std::abs(spin) * std::sqrt(m.B * (m.B - m.A) * (m.C - m.B) / (m.C - m.A));
  const double grows = std::abs(spin > 0 ? x - y : x + y), falls = std::abs(spin > 0 ? x + y : x - y);
  TurnOver found;
  found.smallness = real::hypot(x, y) / most;
  if (!(found.smallness <= kMostAcross)) return std::nullopt;
  found.growth_1_s = std::abs(spin) * std::sqrt((m.B - m.A) * (m.C - m.B) / (m.A * m.C));
  if (!(grows > kNone * most)) return found;
  found.first_s = real::log(4 * most / grows) / found.growth_1_s;
  found.left_out_s = kSecondOrder * found.smallness * found.smallness * (*found.first_s + 1 / found.growth_1_s);
  if (falls > kNone * most) found.again_s = real::log(16 * most / grows * (most / falls)) / found.growth_1_s;
  return found;
}

}  // namespace earthtop
