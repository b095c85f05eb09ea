// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of travelling laboratories compared with the journey by brute force.
#pragma once

#include <gtest/gtest.h>

#include "earthtop/run.hpp"
#include "support/tolerances.hpp"
#include "support/travel_scenes.hpp"
#include "support/travelling_by_force.hpp"

namespace earthtop::testing {

inline Mat3<float128> extended_matrix(const std::array<double, 4>& q) {
  return rotation_matrix(Quaternion<float128>{q[0], Vec3<float128>(q[1], q[2], q[3])});
}

/// Every row's drift and both of its attitudes are those of the brute force, within the bounds of the run, which are small: one as wide as
/// the effect of a missing term would hide it.
inline void expect_as_by_force(const Scenario& scenario) {
  SCOPED_TRACE(scenario.name);
  const RunResult result = run(scenario);
  ASSERT_EQ(result.status, RunStatus::completed);
  std::vector<double> times;
  for (const DriftRow& row : result.rows) times.push_back(row.t_s);
  const auto truth = TravellingByForce(scenario).rows(times);
  ASSERT_EQ(truth.size(), result.rows.size());
  constexpr double kTruth = 1e-20;  // rad: what the brute force leaves, of which drifts are differences
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const DriftRow& row = result.rows[i];
    const auto& exact = truth[i];
    const auto off = [](double made, float128 of) { return static_cast<double>(real::abs(float128(made) - of)); };
    EXPECT_LE(off(row.drift_axis_rad, exact.axis), row.drift_axis_bound_rad + kTruth) << row.t_s;
    EXPECT_LE(off(row.drift_attitude_rad, exact.attitude), row.drift_attitude_bound_rad + kTruth) << row.t_s;
    const auto turned = [](const std::array<double, 4>& q, const Mat3<float128>& R) {
      return static_cast<double>(TravellingByForce::angle_of(R.transpose() * extended_matrix(q)));
    };
    EXPECT_LE(turned(row.q_LB, exact.R_LB), result.attitude_bound_rad + rounding(2)) << row.t_s;
    EXPECT_LE(turned(row.ref_q_LB, exact.ref_R_LB), result.attitude_bound_rad + rounding(2)) << row.t_s;
  }
  constexpr double kSmall = 1e-7;  // so that what is compared within the bounds can fail
  EXPECT_LT(result.drift.attitude_bound_rad, kSmall * static_cast<double>(truth.back().attitude));
}

}  // namespace earthtop::testing
