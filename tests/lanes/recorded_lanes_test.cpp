// SPDX-License-Identifier: GPL-3.0-or-later
/// Points with recorded equations side by side: each agrees with the series of one point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "earthtop/drift/drift_lanes.hpp"
#include "lanes/driven_tops.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

constexpr double kTolerance = 1e-13;

/// The angle between two attitudes (rad).
double turn_between(const Quaternion<double>& p, const Quaternion<double>& q) {
  const Quaternion<double> d = p.conjugate() * q;
  return 2 * std::atan2(norm(d.v), std::abs(d.w));
}

TEST(RecordedLanes, AreTheScalarSeries) {
  for (const auto& [problems, options] : testing::driven_drifts(48, kTolerance)) {
    const auto lanes = integrate_drift_in_lanes(problems, options);
    ASSERT_GT(problems.size(), 2U);
    for (std::size_t i = 0; i < problems.size(); ++i) {
      SCOPED_TRACE(i);
      const auto scalar = integrate_drift(problems[i], options);
      ASSERT_EQ(scalar.status, RunStatus::completed);
      ASSERT_EQ(lanes[i].status, RunStatus::completed);
      ASSERT_EQ(lanes[i].samples.size(), scalar.samples.size());
      // Both have steps of their own, each with an error of some tolerances.
      const double error = testing::truncation(kTolerance, 10 * static_cast<double>(scalar.counters.accepted));
      double largest = 0;
      for (const auto& sample : scalar.samples) largest = std::max(largest, sample.measures.attitude);
      for (std::size_t row = 0; row < scalar.samples.size(); ++row) {
        const auto &got = lanes[i].samples[row], &expected = scalar.samples[row];
        ASSERT_LT(turn_between(got.state.q_LB, expected.state.q_LB), error);
        ASSERT_NEAR(got.measures.axis, expected.measures.axis, error * largest);
        ASSERT_NEAR(got.measures.attitude, expected.measures.attitude, error * largest);
        ASSERT_NEAR(got.spin, expected.spin, error * std::max(largest, std::abs(expected.spin)));
      }
    }
  }
}

}  // namespace
}  // namespace earthtop
