// SPDX-License-Identifier: GPL-3.0-or-later
/// Holds the bounds of random suspensions against truth, and the equations of both observers against each other.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "support/gimbal_scenes.hpp"
#include "support/reference.hpp"

namespace earthtop::testing {

/// Runs random suspensions in double and in 113 bits, by another method and in the laboratory's equations, which count [F]'s torques. No
/// error may be beyond its bound, most drifts must be reliable, and the bounds not far too wide.
inline void expect_bounds_of_suspensions(std::uint64_t seed, int scenes) {
  std::mt19937_64 random(seed);
  int reliable = 0, beyond = 0;
  std::vector<double> widths;
  for (int i = 0; i < scenes; ++i) {
    const Scenario s = any_suspension(random);
    const RunResult result = run(s);
    ASSERT_EQ(result.status, RunStatus::completed) << "seed " << seed << ", scene " << i;
    reliable += result.verdict.verdict == Verdict::reliable;
    const auto truth = reference_run(s, Observer::laboratory);
    ASSERT_EQ(truth.status, RunStatus::completed) << "seed " << seed << ", scene " << i;
    EXPECT_GE(compare(result, truth).least_margin, 1) << "seed " << seed << ", scene " << i;
    for (std::size_t row = 0; row < result.rows.size(); ++row) {
      const DriftSample<float128>& sample = truth.samples[row];
      const float128 epsilon = sample.state.epsilon;
      const auto width_of = [&](double drift, float128 true_drift, double bound, const char* what) {
        const double error = std::abs(static_cast<double>(float128(drift) - true_drift));
        beyond += error > bound;
        EXPECT_LE(error, bound) << what << ", seed " << seed << ", scene " << i << ", row " << row;
        return bound / std::max(error, 1024 * 0x1p-52 * std::abs(drift));
      };
      const BasicGimbalRow<double>& gimbals = *result.rows[row].gimbals;
      const GimbalState<float128>& exact = *sample.gimbals;
      const double outer =
          width_of(gimbals.drift_outer_angle_rad, epsilon * exact.outer.diff, gimbals.drift_outer_angle_bound_rad, "outer");
      const double inner =
          width_of(gimbals.drift_inner_angle_rad, epsilon * exact.inner.diff, gimbals.drift_inner_angle_bound_rad, "inner");
      double watched = gimbals.headline == GimbalHeadline::inner ? inner : outer;
      if (result.rows[row].rotor) {
        const BasicRotorRow<double>& rotor = *result.rows[row].rotor;
        const RotorState<float128>& true_rotor = *sample.rotor;
        watched = width_of(rotor.drift_axis_rad, true_rotor.axis.angle, rotor.drift_axis_bound_rad, "axis");
        width_of(rotor.drift_rate_rad_s, epsilon * true_rotor.rate_difference_scaled, rotor.drift_rate_bound_rad_s, "rate");
        width_of(rotor.drift_angle_rad, epsilon * true_rotor.angle_difference_scaled, rotor.drift_angle_bound_rad, "angle");
      }
      if (row + 1 == result.rows.size()) widths.push_back(watched);
    }
  }
  EXPECT_GE(reliable, scenes * 8 / 10);
  std::ranges::sort(widths);
  EXPECT_LE(widths[widths.size() / 2], 100);
  ::testing::Test::RecordProperty("reliable", reliable);
  ::testing::Test::RecordProperty("median_width", std::to_string(widths[widths.size() / 2]));
}

/// In the equations of both observers random suspensions drift by the same, within both bounds, at an Earth rate that is not small.
inline void expect_formulations_agree(std::uint64_t seed, int scenes) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < scenes; ++i) {
    Scenario s = any_suspension(random);
    s.rotation_rate_rad_s = 0.05;
    std::vector<DriftRow> last;
    for (const Observer observer : {Observer::laboratory, Observer::inertial}) {
      s.numerics.observer = observer, s.numerics.form = ModelForm::general;
      last.push_back(run(s).rows.back());
    }
    const BasicGimbalRow<double>&a = *last[0].gimbals, &b = *last[1].gimbals;
    EXPECT_NEAR(a.drift_outer_angle_rad, b.drift_outer_angle_rad, a.drift_outer_angle_bound_rad + b.drift_outer_angle_bound_rad)
        << i;
    EXPECT_NEAR(a.drift_inner_angle_rad, b.drift_inner_angle_rad, a.drift_inner_angle_bound_rad + b.drift_inner_angle_bound_rad)
        << i;
    EXPECT_LT(a.drift_outer_angle_bound_rad, 1e-6) << i;  // so that the lines above can fail: the drifts are some 0.01 rad
    if (!last[0].rotor) continue;
    const BasicRotorRow<double>&c = *last[0].rotor, &d = *last[1].rotor;
    EXPECT_NEAR(c.drift_axis_rad, d.drift_axis_rad, c.drift_axis_bound_rad + d.drift_axis_bound_rad) << i;
    EXPECT_NEAR(c.drift_rate_rad_s, d.drift_rate_rad_s, c.drift_rate_bound_rad_s + d.drift_rate_bound_rad_s) << i;
    EXPECT_NEAR(c.drift_angle_rad, d.drift_angle_rad, c.drift_angle_bound_rad + d.drift_angle_bound_rad) << i;
  }
}

}  // namespace earthtop::testing
