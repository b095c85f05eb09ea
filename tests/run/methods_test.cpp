// SPDX-License-Identifier: GPL-3.0-or-later
/// All methods give the same drift: each run agrees within the stated bounds with a run by another method.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

std::vector<Scenario> scenes() {
  std::vector<Scenario> all{testing::toy_top(), testing::heavy_rotor_top(), testing::asymmetric_top(), testing::toy_top(),
                            testing::toy_top()};
  all[3].platform = PlatformSpec{PlatformMotion::harmonic, {1, 1, 0.2}, 0, 0, 0.1, 0.7, 20, {0.1, -0.2, 0.3}};
  all[4].effects.centrifugal = false;
  std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {  // and on an Earth as fast as the top precesses
    all.push_back(all[i]);
    all.back().rotation_rate_rad_s = 1;
    all.back().release.rates_relative_to = RatesRelativeTo::inertial;
  }
  for (Scenario& s : all) s.duration_s = 3, s.output_step_s = 0.05;
  return all;
}

/// Each bound covers its run's distance from the truth, so the sum of both covers the distance between the runs.
void expect_within_bounds(const RunResult& a, const RunResult& b) {
  ASSERT_EQ(a.status, RunStatus::completed);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    const DriftRow &x = a.rows[i], &y = b.rows[i];
    EXPECT_LE(std::abs(x.drift_axis_rad - y.drift_axis_rad), x.drift_axis_bound_rad + y.drift_axis_bound_rad);
    EXPECT_LE(std::abs(x.drift_attitude_rad - y.drift_attitude_rad), x.drift_attitude_bound_rad + y.drift_attitude_bound_rad);
  }
}

TEST(Methods, AgreeWithinTheirBounds) {
  for (const Scenario& scene : scenes()) {
    const RunResult expected = run(scene);
    for (const Method method : {Method::dop853, Method::gauss, Method::splitting})
      for (const testing::Equations& equations : testing::kEquations) {
        Scenario s = scene;
        equations.take(s);
        if (method == Method::splitting) s.numerics.form = ModelForm::automatic;
        s.numerics.method = method;
        if (Scene(s).method_refusal(method)) continue;
        SCOPED_TRACE(to_string(method));
        SCOPED_TRACE(equations);
        s.numerics.relative_tolerance = 1e-13;
        const RunResult r = run(s);
        expect_within_bounds(r, expected);
        EXPECT_LT(r.drift.axis_bound_rad, 1e-8 * std::max(1e-4, r.drift.axis_max_rad));
        EXPECT_NEAR(r.drift.spin_final_rad, expected.drift.spin_final_rad, 1e-9);
      }
  }
}

// Every method, on the beginning of every shipped scenario that it fits; `auto` states its choice.
TEST(Methods, AgreeOnEveryShippedScenario) {
  constexpr std::array kAll{Method::taylor,        Method::dopri5, Method::rkf78,      Method::bulirsch_stoer,
                            Method::extrapolation, Method::dop853, Method::gauss,      Method::splitting,
                            Method::long_horizon,  Method::abm8,   Method::closed_form};
  std::array<int, kAll.size()> taken{};
  int scenarios = 0;
  for (const auto& file : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS)) {
    if (file.path().extension() != ".json") continue;
    ++scenarios;
    Scenario scene = testing::shipped(file.path().stem());
    SCOPED_TRACE(scene.name);
    scene.duration_s = std::min(scene.duration_s, scene.name == "fast-gyro" ? 0.3 : 1.5);
    scene.output_step_s = scene.duration_s / 15;
    const RunResult expected = run(scene);
    EXPECT_FALSE(expected.solution.reason.empty());
    for (std::size_t m = 0; m < kAll.size(); ++m) {
      Scenario s = scene;
      s.numerics.method = kAll[m];
      if (Scene(s).method_refusal(kAll[m])) continue;
      ++taken[m];
      if (kAll[m] == Method::abm8) s.numerics.step_s = 0.01 / Scene(s).fastest_rate_rad_s();
      SCOPED_TRACE(to_string(kAll[m]));
      const RunResult r = run(s);
      expect_within_bounds(r, expected);
      // A wide bound would agree with anything; the two unstable scenes' are wide.
      if (expected.drift.axis_bound_rad < 1e-10) {
        EXPECT_LT(r.drift.axis_bound_rad, 1e-8 * std::max(1e-3, r.drift.axis_max_rad));
      }
    }
  }
  EXPECT_EQ(taken[0], scenarios);
  EXPECT_EQ(taken[2], scenarios);
  for (const int times : taken) EXPECT_GE(times, 4);
}

// The drift is computed without cancellation: at 1e-300 rad/s it has as many digits as at the Earth's rate.
TEST(Methods, TinyRatesKeepTheirDigits) {
  Scenario s = testing::toy_top();
  s.duration_s = 3;
  for (const RatesRelativeTo rule : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial}) {
    s.release.rates_relative_to = rule;
    s.rotation_rate_rad_s = 1e-300;
    s.numerics.method = Method::automatic;
    const double expected = run(s).drift.axis_final_rad / 1e-300;
    for (const Method method : {Method::dop853, Method::gauss, Method::splitting})
      for (const double Omega : {1e-300, 1e-12}) {
        s.rotation_rate_rad_s = Omega;
        s.numerics.method = method;
        EXPECT_NEAR(run(s).drift.axis_final_rad / Omega, expected, 2e-10 * expected) << to_string(method) << ", " << Omega;
      }
  }
}

// A Runge-Kutta method lets the norm of the axis drift away from 1. If it scaled a torque in one place alone, ten minutes would show it.
TEST(Methods, TheNormOfTheAxisHasNoPartInALongDrift) {
  Scenario s = testing::toy_top();
  s.duration_s = s.output_step_s = 600;
  const double expected = run(s).drift.axis_final_rad;
  s.numerics.method = Method::rkf78;
  EXPECT_NEAR(run(s).drift.axis_final_rad, expected, testing::truncation(s.numerics.relative_tolerance, 100));
}

TEST(Methods, WhatDoesNotSplitIsRefusedWithTheReason) {
  Scenario s = testing::toy_top();
  EXPECT_FALSE(Scene(s).method_refusal(Method::splitting));
  s.numerics.observer = Observer::body;
  EXPECT_NE(Scene(s).method_refusal(Method::splitting).value_or("").find("no body axes"), std::string::npos);
  s = testing::toy_top();
  s.numerics.form = ModelForm::general;
  EXPECT_NE(Scene(s).method_refusal(Method::splitting).value_or("").find("no general model"), std::string::npos);
  s = testing::toy_top();
  s.platform = PlatformSpec{};
  EXPECT_NE(Scene(s).method_refusal(Method::splitting).value_or("").find("platform"), std::string::npos);
  s = testing::toy_top();
  s.effects.transverse = false;
  EXPECT_NE(Scene(s).method_refusal(Method::splitting).value_or("").find("non-inertial torques"), std::string::npos);
  EXPECT_NE(Scene(testing::asymmetric_top()).method_refusal(Method::splitting).value_or("").find("symmetric tops"),
            std::string::npos);
}

}  // namespace
}  // namespace earthtop
