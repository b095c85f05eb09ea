// SPDX-License-Identifier: GPL-3.0-or-later
/// The long-horizon method compared with integrations that share nothing with it, with published digits, and with itself at
/// other rates.
#include "integrate/long_horizon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

Scenario fast_gyro(double duration_s, double rows, double spin_rad_s = 1047.2) {
  Scenario s = testing::toy_top();
  s.body.mass_kg = 0.5;
  s.body.center_of_mass_m = {0, 0, 0.005};
  testing::set_principal(s.body, 4e-4, 4e-4, 5e-4);
  s.release.tilt_deg = 60;
  s.release.spin_rad_s = spin_rad_s;
  s.duration_s = duration_s;
  s.output_step_s = duration_s / rows;
  return s;
}

IntegrationOptions by(Method method, double tolerance) {
  IntegrationOptions options;
  options.method = method;
  options.relative_tolerance = tolerance;
  return options;
}
DriftTrajectory<double> long_horizon(const Scenario& scene, double tolerance = 1e-10) {
  return integrate_drift(Scene(scene).problem<double>(), by(Method::long_horizon, tolerance));
}

struct Case {
  const char* name;
  Scenario scene;
  double tolerance = 1e-10;
};
/// Difficult cases: slow or no nutation, a hanging or balanced top, a vertical axis, a fast or backward Earth.
std::vector<Case> hard_cases() {
  std::vector<Case> cases;
  const auto add = [&](const char* name, auto&& change) {
    Scenario s = testing::toy_top();
    s.duration_s = 6;
    s.output_step_s = 0.25;
    s.release.rates_relative_to = cases.size() % 2 ? RatesRelativeTo::inertial : RatesRelativeTo::laboratory;
    change(s);
    cases.push_back({name, s});
    // The Earth turns as fast as the top precesses. It is no perturbation then, and the number of steps grows with the digits.
    if (s.rotation_rate_rad_s == 1 && s.release.spin_rad_s < 100) cases.back().tolerance = 1e-7;
  };
  add("toy top", [](Scenario&) {});
  add("spins backward", [](Scenario& s) { s.release.spin_rad_s = -150; });
  add("Earth turns backward", [](Scenario& s) { s.rotation_rate_rad_s = -1e-3; });
  add("Earth at 1 rad/s", [](Scenario& s) { s.rotation_rate_rad_s = 1; });
  add("Earth at 1 rad/s, slow top", [](Scenario& s) { s.rotation_rate_rad_s = 1, s.release.spin_rad_s = 30; });
  add("hangs", [](Scenario& s) { s.body.center_of_mass_m = {0, 0, -0.03}, s.release.spin_rad_s = 40; });
  add("pendulum", [](Scenario& s) { s.body.center_of_mass_m = {0, 0, -0.03}, s.release.spin_rad_s = 0; });
  add("balanced", [](Scenario& s) { s.body.center_of_mass_m = {0, 0, 0}; });
  add("sleeps", [](Scenario& s) { s.release.tilt_deg = 0, s.release.spin_rad_s = 400; });
  add("straight down", [](Scenario& s) { s.release.tilt_deg = 180; });
  add("southern", [](Scenario& s) { s.site.latitude_deg = -70; });
  add("nutates widely", [](Scenario& s) { s.release.angular_velocity_body_rad_s = {12.0, -7.0, 120.0}; });
  return cases;
}

TEST(LongHorizon, AgreesWithIntegrationInEverySlowOrOddScene) {
  for (const auto& [name, scene, tolerance] : hard_cases()) {
    SCOPED_TRACE(name);
    const auto exact = long_horizon(scene, tolerance);
    const auto integrated = integrate_drift(Scene(scene).problem<double>(), by(Method::rkf78, 1e-14));
    ASSERT_EQ(exact.status, RunStatus::completed);
    ASSERT_EQ(exact.samples.size(), integrated.samples.size());
    double largest = 0;
    for (const auto& sample : integrated.samples) largest = std::max(largest, sample.measures.attitude);
    // Ten times the tolerance asked for, or 1e-7 of the drift if that is smaller: the effect is resolved to seven digits.
    const double slack = std::min(10 * tolerance, 1e-7 * largest) + 1e-15;
    for (std::size_t i = 0; i < exact.samples.size(); ++i) {
      const auto &a = exact.samples[i], &b = integrated.samples[i];
      ASSERT_NEAR(a.measures.axis, b.measures.axis, slack) << i;
      ASSERT_NEAR(a.measures.attitude, b.measures.attitude, slack) << i;
      ASSERT_NEAR(a.spin, b.spin, 10 * slack) << i;
      ASSERT_EQ(a.measures.azimuth_defined, b.measures.azimuth_defined);
      if (a.measures.azimuth_defined && scene.release.tilt_deg != 180 && scene.release.tilt_deg != 0) {
        ASSERT_NEAR(a.azimuth, b.azimuth, 30 * slack) << i;
      }
      for (int k = 0; k < 3; ++k) {
        ASSERT_NEAR(a.state.w_LB_B[k], b.state.w_LB_B[k], 1e3 * tolerance) << i;
        ASSERT_NEAR(a.state.ref_w_LB_B[k], b.state.ref_w_LB_B[k], 1e-8) << i;
        ASSERT_NEAR(a.state.q_LB.v[k], b.state.q_LB.v[k], 10 * tolerance) << i;
        ASSERT_NEAR(a.state.ref_q_LB.v[k], b.state.ref_q_LB.v[k], 1e-9) << i;
      }
    }
  }
}

TEST(LongHorizon, MotionIsTheRotatingMotionOfTheDrift) {
  for (const auto& [name, scene, tolerance] : hard_cases()) {
    SCOPED_TRACE(name);
    const auto problem = Scene(scene).problem<double>();
    const auto motion = integrate_motion(problem, by(Method::long_horizon, tolerance));
    const auto drift = long_horizon(scene, tolerance);
    ASSERT_EQ(motion.samples.size(), drift.samples.size());
    for (std::size_t i = 0; i < motion.samples.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        ASSERT_NEAR(motion.samples[i].q_LB.v[k], drift.samples[i].state.q_LB.v[k], 10 * tolerance) << i;
        ASSERT_NEAR(motion.samples[i].w_LB_B[k], drift.samples[i].state.w_LB_B[k], 1e3 * tolerance) << i;
      }
  }
}

/// The digits of tests/data/headlines.json from 113 bits: 785,000 rad of nutation, computed with some thousand evaluations.
TEST(LongHorizon, FastGyroscopeHasThePublishedDigits) {
  const auto drift = long_horizon(fast_gyro(600, 60), 1e-10);
  const auto& last = drift.samples.back();
  EXPECT_NEAR(last.measures.axis, 2.568777690328439999e-02, 5e-12);
  EXPECT_NEAR(last.measures.tilt, -2.297612074266608398e-04, 5e-12);
  EXPECT_NEAR(last.azimuth, 2.966244218467281940e-02, 5e-12);
  EXPECT_NEAR(last.measures.attitude, 2.596126284649218709e-02, 1e-10);
  EXPECT_NEAR(last.spin, -3.758465528823392489e-03, 1e-10);
  EXPECT_LT(drift.counters.evaluations, 10000);
}

TEST(LongHorizon, TheSpinCostsNothing) {
  for (const double spin : {1e3, 1e4, 1e5, 1e6}) {
    const auto drift = long_horizon(fast_gyro(86164, 60, spin), 1e-9);
    ASSERT_EQ(drift.status, RunStatus::completed);
    EXPECT_LT(drift.counters.evaluations, 80000) << spin;  // some 0.2 s; the nutation takes 1e8 to 1e11 rad
  }
}

/// At a hundred times the spin, cheap and still exact, compared with a series that follows each of 40,000 nutations.
TEST(LongHorizon, AFastSpinKeepsTheDigits) {
  const Scenario scene = fast_gyro(2, 4, 1e5);
  const auto exact = long_horizon(scene, 1e-12),
             series = integrate_drift(Scene(scene).problem<double>(), by(Method::taylor, 1e-13));
  ASSERT_EQ(exact.samples.size(), series.samples.size());
  for (std::size_t i = 0; i < exact.samples.size(); ++i) {
    const auto &a = exact.samples[i].measures, &b = series.samples[i].measures;
    // 1e-8 of a drift of 1e-4 rad, as for every small one
    EXPECT_NEAR(a.axis, b.axis, 1e-12) << i;
    EXPECT_NEAR(a.attitude, b.attitude, 1e-12) << i;
  }
  EXPECT_GT(series.samples.back().measures.axis, 1e-5);
}

/// The error must not accumulate when the step is near a multiple of the nutation period, over an octave of steps in
/// hundredths.
TEST(LongHorizon, NoStepIsInResonanceWithTheNutation) {
  const auto problem = Scene(fast_gyro(600, 1)).problem<double>();
  const auto axis = [&](double step_s) {
    IntegrationOptions options = by(Method::long_horizon, 1e-9);
    options.step_s = step_s;
    return Vec3<double>(rotation_matrix(integrate_motion(problem, options).samples.back().q_LB).col(2));
  };
  const Vec3<double> exact(-0.8469779559481886600, 0.1801237044963939736, 0.5001837594487889119);  // as above
  std::vector<double> errors;
  for (double step = 5; step <= 10; step *= 1.01) errors.push_back(norm(Vec3<double>(axis(step) - exact)));
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors.back() / errors[errors.size() / 2], 10);
  EXPECT_LT(errors.back(), 5e-12);
}

TEST(LongHorizon, WithoutEarthThereIsNoDrift) {
  for (auto [name, scene, tolerance] : hard_cases()) {
    SCOPED_TRACE(name);
    scene.rotation_rate_rad_s = 0;
    for (const auto& sample : long_horizon(scene, tolerance).samples) {
      for (const double drift :
           {sample.measures.axis, sample.measures.attitude, sample.measures.tilt, sample.spin, sample.azimuth}) {
        EXPECT_EQ(drift, 0);
        EXPECT_FALSE(std::signbit(drift));
      }
    }
  }
}

/// Drift divided by rate is constant to 1e-8 of the largest value, at rates so small that a plain difference would have no
/// digits.
TEST(LongHorizon, DriftOverRateIsTheSameForEveryTinyRate) {
  for (Scenario scene : {testing::toy_top(), fast_gyro(20, 10)}) {
    scene.duration_s = std::min(scene.duration_s, 20.0);
    scene.output_step_s = 2;
    const auto at = [&](double rate) {
      scene.rotation_rate_rad_s = rate;
      return long_horizon(scene);
    };
    const auto tiny = at(1e-300), small = at(1e-12), plain = at(1e-3), half = at(5e-4);
    double largest = 0;
    for (const auto& sample : tiny.samples) largest = std::max(largest, sample.measures.axis / 1e-300);
    EXPECT_GT(largest, 1);
    for (std::size_t i = 0; i < tiny.samples.size(); ++i) {
      const auto ratio = [&](const DriftTrajectory<double>& t, double rate) {
        return Vec3<double>(t.samples[i].measures.axis_difference_L_scaled * (t.samples[i].state.epsilon / rate));
      };
      const double slack = 1e-8 * largest;
      EXPECT_NEAR(tiny.samples[i].measures.axis / 1e-300, small.samples[i].measures.axis / 1e-12, slack);
      EXPECT_NEAR(tiny.samples[i].spin / 1e-300, small.samples[i].spin / 1e-12, slack);
      // Extrapolated to rate 0 from two plain differences, which leaves an error of the drift squared.
      const Vec3<double> derivative = 2 * ratio(half, 5e-4) - ratio(plain, 1e-3);
      const double square = 10 * std::pow(plain.samples[i].measures.attitude, 2) * largest;
      const double unit = tiny.samples[i].state.epsilon / 1e-300;
      EXPECT_LT(norm(Vec3<double>(tiny.samples[i].measures.axis_difference_L_scaled * unit - derivative)), slack + square);
    }
  }
}

/// Over a day, round-off of the attitude is far larger than the drift due to a tiny rate.
TEST(LongHorizon, ATinyRateDriftsForADay) {
  Scenario scene = fast_gyro(86164, 4);
  const auto ratio = [&](double rate) {
    scene.rotation_rate_rad_s = rate;
    return long_horizon(scene).samples.back().measures.axis / rate;
  };
  const double tiny = ratio(1e-300), small = ratio(1e-13);
  EXPECT_GT(tiny, 1e4);  // s: nearly the time, times the sine of an angle
  EXPECT_LT(tiny, 1e5);
  EXPECT_NEAR(small / tiny, 1, testing::rounding(1e5));
}

// A vertical top at a pole has no drift, and one near the vertical at most its tilt; runs with amplified Earth rates cannot
// find such a drift.
TEST(LongHorizon, WhatHardlyDriftsIsNotSearchedFor) {
  for (const double tilt : {0.0, 1e-7, 1e-4}) {
    Scenario scene = testing::toy_top();
    scene.site.latitude_deg = 90;
    scene.release.tilt_deg = tilt;
    scene.duration_s = 0.5;
    scene.output_step_s = 0.05;
    const auto drift = long_horizon(scene, 1e-12);
    const auto integrated = integrate_drift(Scene(scene).problem<double>(), by(Method::rkf78, 1e-14));
    ASSERT_EQ(drift.status, RunStatus::completed);
    EXPECT_LT(drift.counters.evaluations, 1'000'000) << tilt;
    const double expected = integrated.samples.back().measures.axis;
    EXPECT_NEAR(drift.samples.back().measures.axis, expected, 1e-15 + 1e-6 * expected) << tilt;
  }
}

// A top that falls without a spin on a fast Earth, at a tolerance below what its round-off grows to: the search would go on halving the
// step for ten times its limit. It ends with the plan that it has, and the motion by this plan is complete and as good as others.
TEST(LongHorizon, ASearchThatIsTooLongEndsWithThePlanThatItHas) {
  Scenario scene = testing::toy_top();
  scene.rotation_rate_rad_s = 1;
  scene.release.spin_rad_s = 0;
  scene.duration_s = scene.output_step_s = 6;
  const auto problem = Scene(scene).problem<double>();
  const TiltedTop<double> top(problem.model, reduced_top(problem.model), problem.natural_release(), problem.model.W_IL_L);
  const double duration = problem.units.time_from_s(scene.duration_s), tolerance = 1e-12;
  constexpr std::int64_t kLimit = 400'000;
  StepCounters counters;
  const LongHorizonPlan<double> plan = find_plan(top, duration, tolerance, counters);
  EXPECT_GT(counters.evaluations, kLimit);
  EXPECT_LT(counters.evaluations, 2 * kLimit);  // the last trial takes about as long as all before
  EXPECT_LT(walking_work(top, plan, duration, 0).evaluations, kLimit);

  const auto motion = integrate_motion(problem, by(Method::long_horizon, tolerance));
  ASSERT_EQ(motion.status, RunStatus::completed);
  const auto exact = integrate_motion(problem, by(Method::taylor, 1e-15));
  const Quaternion<double> turn = motion.samples.back().q_LB.conjugate() * exact.samples.back().q_LB;
  EXPECT_LT(2 * norm(turn.v), 1e-7);  // round-off grows to 6e-9 between series and extrapolation
}

TEST(LongHorizon, ARunsBoundHoldsAndIsSmall) {
  Scenario scene = fast_gyro(600, 60);
  scene.numerics = by(Method::long_horizon, 1e-10);
  const RunResult result = run(scene);
  EXPECT_EQ(result.solution.method, Method::long_horizon);
  EXPECT_EQ(result.certificate.method, Method::long_horizon);
  const DriftRow& last = result.rows.back();
  const double error = std::abs(last.drift_axis_rad - 2.568777690328439999e-02);
  EXPECT_LE(error, last.drift_axis_bound_rad);
  EXPECT_LT(last.drift_axis_bound_rad, 1e-9);

  scene = testing::toy_top();
  scene.duration_s = 5;
  scene.numerics = by(Method::long_horizon, 1e-10);
  EXPECT_EQ(run(scene).certificate.method, Method::taylor);
}

/// Ten minutes of various gyroscopes, compared with a series that follows every nutation and whose own round-off is some 1e-12
/// rad.
TEST(LongHorizon, RandomFastGyroscopesKeepTheirBounds) {
  struct Release {
    double latitude_deg, spin_rad_s, tilt_deg, azimuth_deg;
  };
  // The first two accumulated most error of 120 cases; the last drifts by less than a thousandth of a radian.
  for (const Release& r : {Release{-16.7244, 1143.28, 57.4182, 65.5518}, Release{-21.5441, 989.145, 110.8885, 161.4581},
                           Release{0.516657, 325.083, 88.3312, 268.322}}) {
    Scenario scene = fast_gyro(600, 1, r.spin_rad_s);
    scene.site.latitude_deg = r.latitude_deg;
    scene.release.tilt_deg = r.tilt_deg;
    scene.release.azimuth_deg = r.azimuth_deg;
    const RunResult result = run(scene);
    SCOPED_TRACE(r.spin_rad_s);
    ASSERT_EQ(result.solution.method, Method::long_horizon);
    ASSERT_EQ(result.certificate.method, Method::long_horizon);
    EXPECT_LT(result.solution.counters.evaluations, 20000);
    // The witness takes its steps from the solution, and integrates once.
    EXPECT_LT(result.certificate.counters.evaluations, result.solution.counters.evaluations);
    const auto series = integrate_drift(Scene(scene).problem<double>(), by(Method::taylor, 1e-14));
    const double error = std::abs(result.drift.axis_final_rad - series.samples.back().measures.axis);
    EXPECT_LT(error, 3e-11);
    EXPECT_LT(error, result.drift.axis_bound_rad + 2e-12);
    EXPECT_LT(result.drift.axis_bound_rad, 1e-9);
  }
}

/// A gyroscope whose precession is 0.007 of its nutation, and whose effects of second order in the perturbation are 2e-10 rad in
/// ten minutes.
Scenario unbalanced_gyro(double duration_s, double rows) {
  Scenario s = testing::toy_top();
  s.body.mass_kg = 0.14;
  s.body.center_of_mass_m = {0, 0, 0.05};
  testing::set_principal(s.body, 4.2e-4, 4.2e-4, 6e-5);
  s.release.tilt_deg = 75;
  s.release.spin_rad_s = 1047.2;
  s.site.latitude_deg = -33.9;
  s.duration_s = duration_s;
  s.output_step_s = duration_s / rows;
  return s;
}

TEST(LongHorizon, StepsOverTheNutationOfAnUnbalancedGyroscope) {
  Scenario scene = unbalanced_gyro(600, 5);
  scene.numerics.method = Method::long_horizon;
  const RunResult result = run(scene);
  EXPECT_GT(result.solution.step_s.value_or(0), 1);  // 24 periods of the nutation
  const auto series = integrate_drift(Scene(scene).problem<double>(), by(Method::taylor, 1e-13));
  ASSERT_EQ(series.samples.size(), result.rows.size());
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const DriftRow& row = result.rows[i];
    const double error = std::abs(row.drift_axis_rad - series.samples[i].measures.axis);
    const double attitude_error = std::abs(row.drift_attitude_rad - series.samples[i].measures.attitude);
    EXPECT_LE(error, row.drift_axis_bound_rad) << i;
    EXPECT_LE(attitude_error, row.drift_attitude_bound_rad) << i;
    EXPECT_LT(error, 3e-11) << i;  // a seventh of the effects of second order
  }
}

/// The rounding of each flow is mostly of one sign. Unless the tilt is held, 150,000 flows leave an attitude error of 2e-9 rad.
TEST(LongHorizon, RoundingDoesNotTiltASteadyPrecession) {
  Scenario scene = fast_gyro(190, 2, 900);
  testing::set_principal(scene.body, 4e-4, 4e-4, 4e-4);
  scene.body.center_of_mass_m = {0, 0, 0.00065};
  scene.body.mass_kg = 500;
  scene.release.precession = Precession::steady_slow;
  scene.release.rates_relative_to = RatesRelativeTo::inertial;
  const auto drift = long_horizon(scene, 1e-11);
  const auto series = integrate_drift(Scene(scene).problem<double>(), by(Method::taylor, 1e-13));
  EXPECT_GT(drift.counters.evaluations, 100000);
  EXPECT_NEAR(drift.samples.back().measures.axis, series.samples.back().measures.axis, 2e-11);
  EXPECT_NEAR(drift.samples.back().measures.attitude, series.samples.back().measures.attitude, 2e-10);
}

/// The steps of a run are searched for by trial, so that its work is not known beforehand. But the rule that begins the search
/// is the one that the estimate uses.
TEST(LongHorizon, TheEstimateHoldsFromShortToLongAndFromSlowToFast) {
  std::vector<Scenario> scenes;
  for (const double duration_s : {20.0, 60.0, 600.0})
    for (const double rows : {10.0, 300.0}) scenes.push_back(fast_gyro(duration_s, rows));
  for (const double spin_rad_s : {150.0, 250.0, 500.0, 1e5}) scenes.push_back(fast_gyro(60, 20, spin_rad_s));
  for (const double duration_s : {10.0, 60.0, 200.0}) scenes.push_back(unbalanced_gyro(duration_s, 4));
  for (Scenario& scene : scenes) {
    scene.numerics = by(Method::long_horizon, 1e-11);
    SCOPED_TRACE(canonical_json(scene));
    const RunEstimate estimate = Scene(scene).estimate();
    const RunResult result = run(scene);
    constexpr double kFew = 300;  // evaluations in less than a millisecond
    const auto ratio = [](const Work& promised, const StepCounters& used) {
      return (static_cast<double>(used.evaluations) + kFew) / (promised.evaluations + kFew);
    };
    EXPECT_LT(ratio(estimate.solution, result.solution.counters), 3);
    EXPECT_GT(ratio(estimate.solution, result.solution.counters), 1.0 / 3);
    EXPECT_LT(ratio(estimate.certificate, result.certificate.counters), 3);
    EXPECT_GT(ratio(estimate.certificate, result.certificate.counters), 1.0 / 3);
  }
}

/// `auto` takes the method whose whole run is estimated to be cheaper, so that a scene costs about as much as its neighbour.
TEST(LongHorizon, TheChoiceHasNoCliffs) {
  const auto seconds = [](const Scenario& scene) {
    const RunSeconds estimated = Scene(scene).estimate().seconds;
    return estimated.solution + estimated.bound + estimated.largest;
  };
  constexpr double kHardlyAny_s = 2e-2;  // chosen: nobody notices a cliff below it
  for (double duration_s = 2, before = 0; duration_s < 1000; duration_s *= 1.4) {
    const double now = seconds(fast_gyro(duration_s, 20)) + kHardlyAny_s;
    if (before > 0) {
      EXPECT_LT(now, 3 * before) << duration_s;
      EXPECT_GT(now, before / 4) << duration_s;  // where one walk begins to suffice instead of five
    }
    before = now;
  }
  for (const double duration_s : {20.0, 30.0, 40.0, 60.0}) {
    const Scene scene = fast_gyro(duration_s, duration_s);
    const Method method = scene.choice().options.method;
    EXPECT_TRUE(method == Method::long_horizon || method == Method::fourier) << duration_s;
    EXPECT_LT(seconds(scene.scenario()), 0.12) << duration_s;  // chosen: a series alone takes 0.05 s and more for 20 s
  }
  // Between these two spins the filter of 17 parts takes over from that of five.
  EXPECT_LT(seconds(fast_gyro(600, 600, 250)), 6 * seconds(fast_gyro(600, 600, 500)));
}

TEST(LongHorizon, ScenesThatItDoesNotFitAreRefused) {
  Scenario s = testing::toy_top();
  EXPECT_FALSE(Scene(s).method_refusal(Method::long_horizon));
  const auto refusal = [](const Scenario& scene) { return Scene(scene).method_refusal(Method::long_horizon).value_or("none"); };
  EXPECT_NE(refusal(testing::asymmetric_top()).find("symmetric"), std::string::npos);
  s.effects.coriolis = false;
  EXPECT_NE(refusal(s).find("torques"), std::string::npos);
  s = testing::toy_top();
  s.platform = PlatformSpec{};
  EXPECT_NE(refusal(s).find("platform"), std::string::npos);
  s = testing::toy_top();
  s.numerics.observer = Observer::body;
  EXPECT_NE(refusal(s).find("laboratory"), std::string::npos);
  s = testing::toy_top();
  s.body.center_of_mass_m = {0.03, 0, 0};
  testing::set_principal(s.body, 4e-5, 1.2e-4, 1.2e-4);
  EXPECT_NE(refusal(s).find("axis 3"), std::string::npos);
  s = testing::toy_top();
  s.release.spin_rad_s = 0;
  EXPECT_NE(refusal(s).find("faster spin"), std::string::npos);
  s.numerics.method = Method::long_horizon;
  EXPECT_THROW(run(s), ScenarioError);
}

}  // namespace
}  // namespace earthtop
