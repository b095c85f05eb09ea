// SPDX-License-Identifier: GPL-3.0-or-later
/// The bounds of more random bodies with moving masses than the gate has time for.
#include <gtest/gtest.h>

#include "support/mass_scenes.hpp"
#include "support/reference.hpp"

namespace earthtop {

TEST(MovingMassesBounds, HoldOverMoreRandomScenes) {
  std::mt19937_64 random(81);
  int reliable = 0;
  std::vector<double> widths;
  constexpr int kScenes = 20;
  for (int i = 0; i < kScenes; ++i) {
    const Scenario s = testing::any_body_with_masses(random);
    const RunResult result = run(s);
    reliable += result.verdict.verdict == Verdict::reliable;
    const DriftTrajectory<float128> truth = testing::reference_run(s, Observer::inertial);
    EXPECT_GE(testing::compare(result, truth).least_margin, 1) << i;
    const DriftRow& last = result.rows.back();
    const double error = std::abs(static_cast<double>(float128(last.drift_axis_rad) - truth.samples.back().measures.axis));
    widths.push_back(last.drift_axis_bound_rad / std::max(error, 1024 * 0x1p-52 * last.drift_axis_rad));
  }
  EXPECT_GE(reliable, kScenes * 8 / 10);
  std::ranges::sort(widths);
  EXPECT_LE(widths[widths.size() / 2], 100);
}

}  // namespace earthtop
