// SPDX-License-Identifier: GPL-3.0-or-later
/// Holds the bounds of random gyrostats against truth.
#pragma once

#include <gtest/gtest.h>

#include "support/reference.hpp"
#include "support/rotor_scenes.hpp"

namespace earthtop::testing {

/// Runs random gyrostats in double and in 113 bits, by another method and in the equations of another observer. No error may be beyond
/// its bound, and most drifts must be reliable.
inline void expect_bounds_of_gyrostats(std::uint64_t seed, int scenes) {
  std::mt19937_64 random(seed);
  int reliable = 0;
  for (int i = 0; i < scenes; ++i) {
    const Scenario s = any_gyrostat(random);
    const RunResult result = run(s);
    reliable += result.verdict.verdict == Verdict::reliable;
    const auto truth = reference_run(s, Observer::inertial);
    EXPECT_GE(compare(result, truth).least_margin, 1) << "seed " << seed << ", scene " << i;
    for (std::size_t row = 0; row < result.rows.size(); ++row) {
      const auto& sample = truth.samples[row];
      const Vec3<float128> v = sample.state.epsilon * sample.state.e_v_scaled, axis = sample.rotor->axis_B;
      const float128 exact =
          2 * real::atan2(norm(Vec3<float128>(v.cross(axis))), real::hypot(sample.state.e_w, float128(v.dot(axis))));
      EXPECT_LE(std::abs(static_cast<double>(result.rows[row].rotor->drift_axis_rad - exact)),
                result.rows[row].rotor->drift_axis_bound_rad)
          << "seed " << seed << ", scene " << i;
    }
  }
  EXPECT_GE(reliable, scenes * 8 / 10);
}

}  // namespace earthtop::testing
