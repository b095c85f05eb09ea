// SPDX-License-Identifier: GPL-3.0-or-later
// A run says more of a body in gimbals than numbers: theory, sentences, and what would imitate the Earth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "earthtop/run.hpp"
#include "earthtop/scenario/scenario.hpp"
#include "earthtop/scene/top_figures.hpp"

namespace earthtop {
namespace {

RunResult suspension_run(const std::string& name, const Overrides& changes = {}) {
  return run(parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + name + ".json"), changes));
}

const TheoryReport* suspension_theory(const RunResult& result, std::string_view name) {
  const auto found = std::ranges::find(result.theory, name, &TheoryReport::name);
  return found == result.theory.end() ? nullptr : &*found;
}

bool suspension_says(const RunResult& result, std::string_view name) {
  return std::ranges::find(result.why, name, &WhySentence::name) != result.why.end();
}

/// The theory is there, holds within what it leaves out, and is told.   @param share  of the number, above which the errors would be no
/// test
void expect_theory(const RunResult& result, const char* name, double share) {
  SCOPED_TRACE(result.scene.scenario().name + ", " + name);
  const TheoryReport* theory = suspension_theory(result, name);
  ASSERT_NE(theory, nullptr);
  ASSERT_TRUE(theory->computed && theory->computed_error);
  EXPECT_TRUE(theory->applies);
  const double error = theory->predicted_error + *theory->computed_error;
  EXPECT_LE(std::abs(*theory->computed - theory->predicted), error);
  EXPECT_LE(error, share * std::abs(theory->predicted));
  EXPECT_TRUE(suspension_says(result, name));
}

TEST(GimbalReports, TheoryHoldsAndIsTold) {
  expect_theory(suspension_run("magnus-drift"), "magnus_drift", 1e-4);
  expect_theory(suspension_run("gyrocompass-in-gimbals"), "compass_period", 0.01);
  expect_theory(suspension_run("gyrocompass-in-gimbals", {{"/motion/duration_s", "60"}, {"/motion/output_step_s", "60"}}),
                "compass_period", 0.01);
  Scenario still = suspension_run("rate-gyro-on-turntable").scene.scenario();
  still.platform.reset();  // on a platform a run says nothing of why
  still.release.gimbals->inner_angle_deg = 80;
  expect_theory(run(still), "settled_angle", 1e-9);
  expect_theory(suspension_run("isotomeograph"), "turn_by_masses", 1e-4);
}

// A theory that does not apply is not printed.
TEST(GimbalReports, NoTheoryWhereNoneApplies) {
  const RunResult braked =
      suspension_run("magnus-drift", {{"/gimbals/inner/viscous_torque_N_m_s", "1e-4"}, {"/motion/duration_s", "0.5"}});
  EXPECT_EQ(suspension_theory(braked, "magnus_drift"), nullptr);
  EXPECT_FALSE(suspension_says(braked, "magnus_drift"));
  const RunResult early = suspension_run("rate-gyro-on-turntable", {{"/motion/duration_s", "0.1"}});
  EXPECT_EQ(suspension_theory(early, "settled_angle"), nullptr);
  const RunResult short_run = suspension_run("gyrocompass-in-gimbals", {{"/motion/duration_s", "20"}});
  EXPECT_EQ(suspension_theory(short_run, "compass_period"), nullptr);
}

// Both motions go through the vertical itself; the azimuth of neither has a side there.
TEST(GimbalReports, AzimuthThroughTheVerticalIsThatOfTheOuterGimbal) {
  for (const char* step_s : {"0.02", "0.5"}) {
    const RunResult result = suspension_run("through-gimbal-lock", {{"/motion/output_step_s", step_s}});
    const DriftRow& last = result.rows.back();
    ASSERT_TRUE(last.drift_azimuth_rad);
    EXPECT_NEAR(*last.drift_azimuth_rad, -(last.gimbals->outer_angle_rad - last.gimbals->ref_outer_angle_rad),
                1e-12);  // 1e-8 of the drift
  }
}

// A torque h Omega across the rotor's axis, the weight's arm for it, and the nutation whose drift after Magnus is the Earth's rate.
TEST(GimbalReports, WhatImitatesTheEarthDoes) {
  const RunResult result = suspension_run("magnus-drift", {{"/release/outer_rate_rad_s", "0"}, {"/motion/duration_s", "0.1"}});
  const TopFigures top = result.scene.top();
  ASSERT_TRUE(top.gimbals && top.gimbals->earth_torque_N_m && top.gimbals->earth_offset_m && top.gimbals->earth_nutation_rad);
  const double Omega = result.scene.rotation_rate_rad_s(), h = 7.8e-4 * 1100;
  EXPECT_NEAR(*top.gimbals->earth_torque_N_m, h * Omega, 1e-9 * h * Omega);               // roundings
  EXPECT_NEAR(*top.gimbals->earth_offset_m, h * Omega / ((0.2 + 0.6) * 9.80925), 1e-12);  // 1e-6 of it
  const double X = *top.gimbals->earth_nutation_rad;
  const double nutation = top.nutation_rad_s.value();
  // The release whose nutation is X: an inner rate of X times the rate of nutation.
  const RunResult imitated = suspension_run("magnus-drift", {{"/release/outer_rate_rad_s", "0"},
                                                             {"/release/inner_rate_rad_s", std::to_string(X * nutation)},
                                                             {"/motion/duration_s", "2"}});
  const TheoryReport* theory = suspension_theory(imitated, "magnus_drift");
  ASSERT_NE(theory, nullptr);
  constexpr double kNextOrder = 0.01;
  EXPECT_NEAR(std::abs(*theory->computed), Omega, kNextOrder * Omega);
}

}  // namespace
}  // namespace earthtop
