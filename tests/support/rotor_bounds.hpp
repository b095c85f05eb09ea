// SPDX-License-Identifier: GPL-3.0-or-later
/// Holds the bounds of random gyrostats against truth, and the equations of the observers against each other.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "support/reference.hpp"
#include "support/rotor_scenes.hpp"

namespace earthtop::testing {

/// Runs random gyrostats in double and in 113 bits, by another method and in the equations of another observer. No error may be beyond
/// its bound, most drifts must be reliable, and the bounds not far too wide.
inline void expect_bounds_of_gyrostats(std::uint64_t seed, int scenes) {
  std::mt19937_64 random(seed);
  int reliable = 0;
  std::vector<double> widths;
  for (int i = 0; i < scenes; ++i) {
    const Scenario s = any_gyrostat(random);
    const RunResult result = run(s);
    reliable += result.verdict.verdict == Verdict::reliable;
    const auto truth = reference_run(s, Observer::inertial);
    EXPECT_GE(compare(result, truth).least_margin, 1) << "seed " << seed << ", scene " << i;
    for (std::size_t row = 0; row < result.rows.size(); ++row) {
      const RotorState<float128>& exact = *truth.samples[row].rotor;
      const float128 epsilon = truth.samples[row].state.epsilon;
      const BasicRotorRow<double>& rotor = *result.rows[row].rotor;
      const auto expect_within = [&](double drift, float128 true_drift, double bound) {
        const double error = std::abs(static_cast<double>(float128(drift) - true_drift));
        EXPECT_LE(error, bound) << "seed " << seed << ", scene " << i << ", row " << row;
        return bound / std::max(error, 1024 * 0x1p-52 * std::abs(drift));
      };
      const double width = expect_within(rotor.drift_axis_rad, exact.axis.angle, rotor.drift_axis_bound_rad);
      expect_within(rotor.drift_rate_rad_s, epsilon * exact.rate_difference_scaled, rotor.drift_rate_bound_rad_s);
      expect_within(rotor.drift_angle_rad, epsilon * exact.angle_difference_scaled, rotor.drift_angle_bound_rad);
      if (row + 1 == result.rows.size()) widths.push_back(width);
    }
  }
  EXPECT_GE(reliable, scenes * 8 / 10);
  std::ranges::sort(widths);
  EXPECT_LE(widths[widths.size() / 2], 100);
  ::testing::Test::RecordProperty("reliable", reliable);
  ::testing::Test::RecordProperty("median_width", std::to_string(widths[widths.size() / 2]));
}

/// In the equations of every observer random gyrostats drift by the same, within both bounds.
inline void expect_observers_agree(std::uint64_t seed, int scenes) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < scenes; ++i) {
    Scenario s = any_gyrostat(random);
    s.rotation_rate_rad_s = 0.05;
    std::vector<DriftRow> last;
    for (const Observer observer : {Observer::laboratory, Observer::inertial, Observer::body}) {
      s.numerics.observer = observer, s.numerics.form = ModelForm::general;
      last.push_back(run(s).rows.back());
    }
    for (std::size_t k : {1u, 2u}) {
      const BasicRotorRow<double>&a = *last[0].rotor, &b = *last[k].rotor;
      EXPECT_NEAR(a.drift_axis_rad, b.drift_axis_rad, a.drift_axis_bound_rad + b.drift_axis_bound_rad) << i;
      EXPECT_NEAR(a.drift_rate_rad_s, b.drift_rate_rad_s, a.drift_rate_bound_rad_s + b.drift_rate_bound_rad_s) << i;
      EXPECT_NEAR(a.drift_angle_rad, b.drift_angle_rad, a.drift_angle_bound_rad + b.drift_angle_bound_rad) << i;
      EXPECT_NEAR(last[0].drift_attitude_rad, last[k].drift_attitude_rad,
                  last[0].drift_attitude_bound_rad + last[k].drift_attitude_bound_rad)
          << i;
    }
    EXPECT_LT(last[0].rotor->drift_rate_bound_rad_s, 1e-6) << i;  // so that the lines above can fail: rates of 0.05 rad/s
    EXPECT_LT(last[0].rotor->drift_angle_bound_rad, 1e-6) << i;   // the same
  }
}

}  // namespace earthtop::testing
