// SPDX-License-Identifier: GPL-3.0-or-later
/// The times at which the drift first passes a threshold and at which dry friction stops a motion. They are compared with
/// closed forms, and with integrations by another method with more digits just before and after. Every time must be within its
/// bound, and no bound may be larger than the error of the drift requires.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/effect_scenes.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

using testing::kPi;
constexpr Method kMethods[] = {Method::dopri5,    Method::rkf78,        Method::bulirsch_stoer, Method::extrapolation,
                               Method::abm8,      Method::taylor,       Method::dop853,         Method::gauss,
                               Method::splitting, Method::long_horizon, Method::closed_form};

/// A balanced gyroscope whose axis, at `angle` from the celestial axis, keeps its direction in space. In the laboratory it
/// drifts by 2 asin(sin(angle) |sin(Omega t / 2)|).
Scenario free_gyroscope(double angle) {
  Scenario s = testing::toy_top();
  s.site.latitude_deg = 90;
  s.body.center_of_mass_m = {0, 0, 0};
  testing::set_principal(s.body, 4e-4, 4e-4, 5e-4);
  s.release.tilt_deg = angle * 180 / kPi;
  s.release.spin_rad_s = 40;
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  s.rotation_rate_rad_s = 0.3;
  s.duration_s = s.output_step_s = 12;
  return s;
}
double passing_rate(double angle, double threshold, double rate) {
  const double half = std::sin(threshold / 2) / std::sin(angle);
  return rate * std::sin(angle) * std::sqrt(1 - half * half) / std::cos(threshold / 2);
}
double passing_time(double angle, double threshold, double rate) {
  return 2 / rate * std::asin(std::sin(threshold / 2) / std::sin(angle));
}

TEST(ThresholdTime, OfAFreeGyroscopeIsThatOfTheFormulaByEveryMethod) {
  const double angle = kPi / 3;
  for (const double threshold : {1e-9, 1e-3, 0.7, 2.0}) {
    Scenario scene = free_gyroscope(angle);
    scene.threshold_rad = threshold;
    const double expected_s = passing_time(angle, threshold, scene.rotation_rate_rad_s);
    for (const Method method : kMethods) {
      SCOPED_TRACE(::testing::Message() << threshold << " rad by " << to_string(method));
      Scenario s = scene;
      s.numerics.method = method;
      ASSERT_FALSE(Scene(s).method_refusal(method));
      const DriftSummary drift = run(s).drift;
      ASSERT_TRUE(drift.threshold_time_s && drift.threshold_time_bound_s);
      EXPECT_EQ(drift.threshold_crossing, ThresholdCrossing::clear);
      // The tilt in degrees is rounded, and the formula: some eps of the angles.
      const double rounding = 4e-16 * expected_s * (1 + std::tan(threshold / 2));
      EXPECT_NEAR(*drift.threshold_time_s, expected_s, *drift.threshold_time_bound_s + rounding);
      // It is no larger than the bound of the next row's drift makes it.
      s.output_step_s = s.duration_s / 200;
      const RunResult result = run(s);
      const auto next = std::ranges::find_if(result.rows, [&](const DriftRow& row) { return row.t_s > expected_s; });
      ASSERT_TRUE(next != result.rows.end() && result.drift.threshold_time_bound_s);
      // Near round-off the second integration's distance at the passing may be half as large again as at any row.
      const double of_drift = 1.5 * next->drift_axis_bound_rad / passing_rate(angle, threshold, s.rotation_rate_rad_s);
      // But that long_horizon takes so early a drift from the difference of two motions, with the error of one of them.
      const double of_difference = method == Method::long_horizon ? 1e-10 / s.rotation_rate_rad_s : 0;
      EXPECT_LE(*result.drift.threshold_time_bound_s, std::max(1.01e-12 * expected_s, of_drift) + of_difference);
      EXPECT_NEAR(*result.drift.threshold_time_s, expected_s, *result.drift.threshold_time_bound_s + rounding);
    }
  }
}

TEST(ThresholdTime, HasTheDigitsOfEveryPrecision) {
  for (const Precision precision : {Precision::bits64, Precision::bits113})
    for (const Method method : {Method::rkf78, Method::taylor, Method::closed_form}) {
      SCOPED_TRACE(::testing::Message() << to_string(precision) << " by " << to_string(method));
      Scenario s = free_gyroscope(kPi / 3);
      s.threshold_rad = 1e-3;
      s.duration_s = s.output_step_s = 0.1;
      s.precision = precision;
      s.numerics.method = method;
      s.numerics.relative_tolerance = default_tolerance(precision);
      const DriftSummary drift = run(s).drift;
      const double expected_s = passing_time(kPi / 3, 1e-3, s.rotation_rate_rad_s);
      ASSERT_TRUE(drift.threshold_time_s && drift.threshold_time_bound_s);
      EXPECT_NEAR(*drift.threshold_time_s, expected_s, 1e-15);
      EXPECT_DOUBLE_EQ(*drift.threshold_time_bound_s, 1e-12 * *drift.threshold_time_s);
    }
}

// The gyroscope's drift rises to twice its angle and turns back there.
TEST(ThresholdTime, ATouchIsNamed) {
  const double angle = 0.4, top = 2 * angle;
  const auto crossing = [&](double threshold, Method method) {
    Scenario s = free_gyroscope(angle);
    s.threshold_rad = threshold;
    s.numerics.method = method;
    return run(s).drift;
  };
  for (const Method method : kMethods) {
    SCOPED_TRACE(to_string(method));
    EXPECT_EQ(crossing(top + 1e-6, method).threshold_crossing, ThresholdCrossing::not_reached);
    EXPECT_FALSE(crossing(top + 1e-6, method).threshold_time_s);
    for (const double beside : {1e-16, -1e-16}) {
      const DriftSummary touch = crossing(top + beside, method);
      EXPECT_EQ(touch.threshold_crossing, ThresholdCrossing::tangential);
      EXPECT_FALSE(touch.threshold_time_bound_s);
    }
    const DriftSummary clear = crossing(top - 1e-6, method);
    ASSERT_EQ(clear.threshold_crossing, ThresholdCrossing::clear);
    const double expected_s = passing_time(angle, top - 1e-6, 0.3);
    EXPECT_NEAR(*clear.threshold_time_s, expected_s, *clear.threshold_time_bound_s + 1e-11);
    EXPECT_LE(*clear.threshold_time_bound_s, 1e-3);  // where the drift nearly stands, its error counts hundredfold
  }
}

TEST(ThresholdTime, AtTheEndOfARunIsUncertain) {
  Scenario s = free_gyroscope(kPi / 3);
  s.duration_s = s.output_step_s = 1;
  const double last = run(s).drift.axis_final_rad;
  for (const double beside : {1e-16, -1e-16}) {
    s.threshold_rad = last + beside;
    const DriftSummary drift = run(s).drift;
    EXPECT_EQ(drift.threshold_crossing, ThresholdCrossing::uncertain);
    EXPECT_FALSE(drift.threshold_time_bound_s);
  }
}

// A fast top makes thousands of nutations between two rows and in one step of long_horizon. The first passing is at a peak of
// the nutation, not where the trend passes.
TEST(ThresholdTime, OfANutatingDriftIsTheFirstByLongSteps) {
  for (const double spin : {400.0, 1500.0})
    for (const double threshold : {2e-5, 3e-4}) {
      Scenario s = testing::toy_top();
      s.body.center_of_mass_m = {0, 0, 0.01};
      s.release.spin_rad_s = spin;
      s.duration_s = s.output_step_s = 20;
      s.threshold_rad = threshold;
      SCOPED_TRACE(::testing::Message() << spin << " rad/s, " << threshold << " rad");
      s.numerics.method = Method::taylor;
      const DriftSummary expected = run(s).drift;
      s.numerics.method = Method::long_horizon;
      ASSERT_FALSE(Scene(s).method_refusal(s.numerics.method));
      const DriftSummary drift = run(s).drift;
      ASSERT_TRUE(expected.threshold_time_s && drift.threshold_time_s);
      ASSERT_EQ(expected.threshold_crossing, ThresholdCrossing::clear);
      ASSERT_EQ(drift.threshold_crossing, ThresholdCrossing::clear);
      EXPECT_NEAR(*drift.threshold_time_s, *expected.threshold_time_s,
                  *drift.threshold_time_bound_s + *expected.threshold_time_bound_s);
      EXPECT_LT(*drift.threshold_time_bound_s, 1e-8 * s.duration_s);  // eight digits
    }
}

// The stop time w0 I / k of an upright top at the pole, and of a balanced one; with additional viscous friction, a logarithm.
TEST(StopTime, IsThatOfTheFormula) {
  for (const Method method : {Method::automatic, Method::rkf78, Method::extrapolation})
    for (const double rate : {0.0, kEarthRateWgs84, 1.0}) {
      SCOPED_TRACE(::testing::Message() << to_string(method) << " " << rate);
      Scenario s = testing::stopping_top(90, 0, rate);
      s.numerics.method = method;
      const double I3 = s.body.inertia_kg_m2[2][2], k = s.effects.applied.coulomb_N_m;
      const RunResult result = run(s);
      ASSERT_EQ(result.stops.size(), 2U);
      for (const StopEvent& stop : result.stops) {
        const double spin = stop.prediction == Prediction::rotating ? 100 - rate : 100;
        ASSERT_TRUE(stop.bound_s);
        EXPECT_NEAR(stop.t_s, I3 * spin / k, *stop.bound_s);
        EXPECT_LT(*stop.bound_s, 1e-10);
      }
    }
}

// About a tilted axis, under gravity and on a fast Earth, no formula is known: methods must agree within their bounds.
TEST(StopTime, OfATiltedTopLiesWithinItsBound) {
  for (const double rate : {kEarthRateWgs84, 0.3, 1.0}) {
    SCOPED_TRACE(rate);
    Scenario s = testing::stopping_top(45, 35, rate);
    s.output_step_s = 0.05;
    s.numerics.method = Method::rkf78;
    const RunResult a = run(s);
    s.numerics.method = Method::extrapolation;
    s.numerics.relative_tolerance = 1e-13;
    const RunResult b = run(s);
    ASSERT_EQ(a.stops.size(), 2U);
    ASSERT_EQ(b.stops.size(), 2U);
    for (const StopEvent& stop : a.stops) {
      const auto other = std::ranges::find(b.stops, stop.prediction, &StopEvent::prediction);
      ASSERT_TRUE(stop.bound_s && other->bound_s);
      EXPECT_NEAR(stop.t_s, other->t_s, *stop.bound_s);
      EXPECT_LT(*stop.bound_s, 1e-8);
    }
  }
}

}  // namespace
}  // namespace earthtop
