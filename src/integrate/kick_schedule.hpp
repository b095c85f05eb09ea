// SPDX-License-Identifier: GPL-3.0-or-later
/// The times and weights of the kicks in a step, for a composition of exact flows A (the large one) and B (the kick).
///
/// gauss(s) has the s nodes and weights of Gauss and Legendre. For near-integrable systems it is called ABA(2s, 2), with a
/// local error eps h^2s + eps^2 h^2 (times h), where eps is the size of B relative to A (J. Laskar, P. Robutel 2001). aba864
/// (compositions.hpp) is for an eps that is not small.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "earthtop/real.hpp"
#include "integrate/compositions.hpp"

namespace earthtop {

struct KickSchedule {
  static constexpr int kMost = 8;
  int kicks = 1;
  std::array<double, kMost> at{0.5};    ///< times of the kicks, in units of the step
  std::array<double, kMost> weight{1};  ///< weights of the kicks; their sum is 1
};

namespace kick_schedules {

/// @param kicks  1 to KickSchedule::kMost
inline KickSchedule gauss(int kicks) {
  KickSchedule schedule;
  schedule.kicks = kicks;
  for (int i = 0; i < (kicks + 1) / 2; ++i) {
    // Newton's method on [-1, 1], which starts between the two extrema beside the root.
    float80 x = real::cos(real::pi<float80>() * (i + 0.75) / (kicks + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      float80 value = 1, before = 0;
      for (int j = 0; j < kicks; ++j) {
        const float80 next = ((2 * j + 1) * x * value - j * before) / (j + 1);
        before = value;
        value = next;
      }
      slope = kicks * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    const int mirrored = kicks - 1 - i;
    schedule.at[i] = static_cast<double>((1 - x) / 2);
    schedule.at[mirrored] = static_cast<double>((1 + x) / 2);
    schedule.weight[i] = schedule.weight[mirrored] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
  }
  return schedule;
}

/// The composition ABA(8, 6, 4), in which each flow of B is a kick.
inline KickSchedule aba864() {
  const CompositionTable& table = composition_table(Composition::aba864);
  KickSchedule schedule;
  schedule.kicks = table.stages;
  double now = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.stages); ++i) {
    now += table.a[i];
    schedule.at[i] = now;
    schedule.weight[i] = table.b[i];
  }
  return schedule;
}

}  // namespace kick_schedules
}  // namespace earthtop
