// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/drift/trend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "earthtop/run_batch.hpp"
#include "trend/trend_tops.hpp"

namespace earthtop {
namespace {

using testing::set_principal;
using testing::toy_top;

/// A drift with a line, swings of precession and of both, and a swing of nutation that grows with the time.
std::vector<double> made_drift(double rate, double p, double n, double step, int count) {
  std::vector<double> drift;
  for (int i = 0; i < count; ++i) {
    const double t = step * i;
    drift.push_back(rate * t + 3e-5 * std::sin(p * t + 0.4) + 4e-6 * std::cos(2 * p * t) + 2e-6 * std::sin((n - p) * t + 1) +
                    1e-6 * t * std::cos(n * t));
  }
  return drift;
}

TEST(EstimateTrend, TakesTheSwingsOutOfALine) {
  const double p = 2.2, n = 17.3, rate = 5e-5;
  for (const double turns : {1.2, 2.5, 4.0, 12.0}) {
    const int count = 600;
    const double step = turns * 2 * std::numbers::pi / p / (count - 1);
    const std::vector<double> drift = made_drift(rate, p, n, step, count);
    const TrendEstimate estimate = estimate_trend(drift, step, {p + rate, n});  // the drift counts azimuths clockwise
    const double error = std::abs(estimate.rate_rad_s - rate);
    EXPECT_LE(error, estimate.bound_rad_s) << turns;
    // A straight line alone is off by 6 A sin(phase) / (pi N T), about a swing per duration. Of that a millionth is left.
    EXPECT_LT(estimate.bound_rad_s, 1e-6 * 3e-5 / (step * (count - 1))) << turns;
  }
}

TEST(EstimateTrend, DoesNotDependOnTheSizeOfTheDrift) {
  std::vector<double> drift = made_drift(5e-5, 2.2, 17.3, 0.02, 600);
  const TrendEstimate whole = estimate_trend(drift, 0.02, {2.2, 17.3});
  for (double& value : drift) value *= 1e-290;
  const TrendEstimate tiny = estimate_trend(drift, 0.02, {2.2, 17.3});
  EXPECT_NEAR(tiny.rate_rad_s / 1e-290, whole.rate_rad_s, whole.bound_rad_s);
  EXPECT_GT(tiny.bound_rad_s, 0);
  EXPECT_EQ(estimate_trend(std::vector<double>(600, 0.0), 0.02, {2.2, 17.3}).rate_rad_s, 0);
}

TEST(Trend, DoesNotDependOnTheOutputStep) {
  std::vector<SecularDrift> trends;
  for (const double step : {0.5, 0.03, 0.001}) {
    Scenario s = toy_top();
    s.duration_s = 6;
    s.output_step_s = step;
    trends.push_back(run(s).drift.secular.value());
  }
  for (const SecularDrift& trend : trends) {
    EXPECT_EQ(trend.azimuth_rate_rad_s, trends[0].azimuth_rate_rad_s);
    EXPECT_EQ(trend.azimuth_oscillation_rad, trends[0].azimuth_oscillation_rad);
    EXPECT_NEAR(*trend.azimuth_rate_bound_95_rad_s, *trends[0].azimuth_rate_bound_95_rad_s,
                0.2 * *trends[0].azimuth_rate_bound_95_rad_s);
  }
}

// Methods that look for the trend on their way, those that need an integration of their own, and lanes agree.
TEST(Trend, IsTheSameByEveryMethod) {
  Scenario s = toy_top();
  s.duration_s = 4;
  const SecularDrift trend = run(s).drift.secular.value();
  const double bound = *trend.azimuth_rate_bound_95_rad_s;
  for (const Method method : {Method::rkf78, Method::dop853, Method::long_horizon}) {
    Scenario other = s;
    other.numerics.method = method;
    other.threshold_rad = method == Method::dop853 ? std::optional(1e-4) : std::nullopt;
    EXPECT_NEAR(*run(other).drift.secular->azimuth_rate_rad_s, *trend.azimuth_rate_rad_s, bound) << to_string(method);
  }
  Scenario watched = s;
  watched.threshold_rad = 1e-4;
  EXPECT_NEAR(*run(watched).drift.secular->azimuth_rate_rad_s, *trend.azimuth_rate_rad_s, bound);
  const std::vector<Scene> scenes(2, Scene(s));
  for (const BatchOutcome& outcome : run_batch(scenes))
    EXPECT_NEAR(*outcome.result->drift.secular->azimuth_rate_rad_s, *trend.azimuth_rate_rad_s, bound);
}

TEST(Trend, TakesATurnOfPrecession) {
  Scenario s = toy_top();
  s.duration_s = 1.5;  // a turn takes 1.62 s
  const SecularDrift trend = run(s).drift.secular.value();
  EXPECT_FALSE(trend.azimuth_rate_rad_s);
  EXPECT_FALSE(trend.azimuth_rate_bound_95_rad_s);
  EXPECT_NEAR(trend.turns_seen.value(), 1.5 / 1.617, 0.01);
  EXPECT_NE(trend.reason.find("turns of precession"), std::string::npos);
  s.duration_s = 1.7;
  EXPECT_TRUE(run(s).drift.secular->azimuth_rate_rad_s);
}

TEST(Trend, OfABodyWithoutPrecessionIsNotDetermined) {
  Scenario gyro = toy_top();
  gyro.body.center_of_mass_m = {0, 0, 0};
  gyro.duration_s = 20;
  EXPECT_FALSE(run(gyro).drift.secular->azimuth_rate_rad_s);
  EXPECT_NE(run(gyro).drift.secular->reason.find("no torque of gravity"), std::string::npos);
}

// With friction the rate is the mean of the time that is stated, and not that of a conservative top.
TEST(Trend, WithFrictionIsTheMeanOfItsWindow) {
  Scenario s = toy_top();
  s.duration_s = 10;
  s.effects.applied.viscous_N_m_s = 2e-6;
  const RunResult result = run(s);
  const SecularDrift& trend = result.drift.secular.value();
  EXPECT_TRUE(trend.of_window);
  EXPECT_EQ(trend.reason, "friction acts");
  EXPECT_EQ(trend.window_s, (std::array<double, 2>{0, 10}));
  EXPECT_DOUBLE_EQ(*trend.azimuth_rate_rad_s, *result.rows.back().drift_azimuth_rad / 10);
  EXPECT_GT(*trend.azimuth_rate_bound_95_rad_s, 0);
  EXPECT_FALSE(trend.turns_seen);
  EXPECT_TRUE(result.theory.empty());
}

/// The error of a scenario's trend, found by a run ten times as long, is within its bound, and the bound is at most this.
void expect_holds_ten_times_as_long(const Scenario& scenario, double most_bound_rad_s) {
  Scenario longer = scenario;
  longer.duration_s *= 10, longer.output_step_s *= 10;
  const SecularDrift trend = run(scenario).drift.secular.value(), truth = run(longer).drift.secular.value();
  EXPECT_NEAR(*trend.azimuth_rate_rad_s, *truth.azimuth_rate_rad_s, *trend.azimuth_rate_bound_95_rad_s) << scenario.name;
  EXPECT_LE(*trend.azimuth_rate_bound_95_rad_s, most_bound_rad_s) << scenario.name;
}

Scenario top_of(const char* name, double mass, double lever, std::array<double, 3> moments, ReleaseSpec release, Site site,
                double duration) {
  Scenario s;
  s.name = name;
  s.site = site;
  s.body.mass_kg = mass;
  s.body.center_of_mass_m = {0, 0, lever};
  set_principal(s.body, moments[0], moments[1], moments[2]);
  s.release = release;
  s.duration_s = duration;
  s.output_step_s = duration / 20;
  return s;
}

// The fifth multiple of the nutation less the precession is within a fortieth of the precession of twice a rate of looks that is in
// the golden ratio to the nutation: at such looks that swing seems to take the whole run.
TEST(Trend, LooksShowNoFastSwingAsASlowOne) {
  ReleaseSpec release;
  release.tilt_deg = 147.3, release.azimuth_deg = -90, release.spin_rad_s = 13.94;
  // The trend's floor, where the rate is known to all the digits that rounding leaves, is 1e-9 of the rate.
  expect_holds_ten_times_as_long(
      top_of("slow looks", 2.4415, 0.02765, {4.3588e-3, 4.3588e-3, 4.9837e-3}, release, {60, 0, 0, 9.785}, 60), 2e-13);
}

// The ellipse of a spherical pendulum turns by a few degrees while the run lasts. Its orientation matters to second order in the Earth's
// rate, which no window of the run can tell from a trend.
TEST(Trend, OfAPendulumAllowsForTheEllipseThatHardlyTurns) {
  ReleaseSpec release;
  release.tilt_deg = 177.3, release.azimuth_deg = 180, release.rates_relative_to = RatesRelativeTo::inertial;
  release.precession = Precession::given, release.precession_rate_rad_s = -7.85;
  expect_holds_ten_times_as_long(top_of("pendulum", 2.95, 0.227, {0.1566, 0.1566, 0.0091}, release, {59.5, 0, 0, 9.827}, 15),
                                 1e-10);
}

// In 31,000 turns the rounding of the integration grows to 1e-7 of the rate. The first 400 turns do not have it.
TEST(Trend, OfAVeryLongRunRestsOnItsFirstTurns) {
  ReleaseSpec release;
  release.tilt_deg = 96.3, release.azimuth_deg = -92.8, release.spin_rad_s = -127.4,
  release.precession = Precession::steady_slow;
  Scenario s = top_of("many turns", 0.8176, 0.0708, {4.2065e-3, 4.2065e-3, 2.123e-4}, release, {-82.8, 0, 0, 9.82}, 120);
  const SecularDrift trend = run(s).drift.secular.value();
  EXPECT_NEAR(*trend.turns_seen, 314, 1);
  s.duration_s *= 100, s.output_step_s *= 100;
  const SecularDrift of_longer = run(s).drift.secular.value();
  EXPECT_NEAR(*of_longer.turns_seen, 400, 1);
  EXPECT_LT(of_longer.window_s[1], 160);
  constexpr double kOfRounding = 1e-9;
  EXPECT_NEAR(*of_longer.azimuth_rate_rad_s, *trend.azimuth_rate_rad_s, kOfRounding * std::abs(*trend.azimuth_rate_rad_s));
}

// A thin disc nutates nearly twice a turn, and unequal moments come round twice a turn.
TEST(Trend, OfAThinDiscAllowsForUnequalMomentsThatKeepPaceWithTheNutation) {
  ReleaseSpec release;
  release.tilt_deg = 71, release.azimuth_deg = 62, release.spin_angle_deg = -81, release.spin_rad_s = 16.46;
  release.precession = Precession::given, release.precession_rate_rad_s = 8.22;
  expect_holds_ten_times_as_long(
      top_of("disc", 0.785, 0.0024, {4.942e-4, 4.969e-4, 9.82e-4}, release, {-88, 0, 0, 9.793}, 6.25), 1e-7);
}

/// A sample of what earthtop-trend-coverage counts, with runs 8 times as long.
const std::vector<testing::TrendJudged>& judged_sample() {
  static const std::vector<testing::TrendJudged> sample = [] {
    std::vector<testing::TrendJudged> all;
    constexpr std::size_t kTops = 66;
    constexpr double kTimes = 8, kMostSeconds = 0.05;
    for (std::uint64_t i = 0; all.size() < kTops; ++i)
      if (const auto scenario = testing::random_trend_top(i, kTimes, kMostSeconds))
        if (auto judged = testing::judge_trend(*scenario, kTimes)) all.push_back(*std::move(judged));
    return all;
  }();
  return sample;
}

TEST(Trend, BoundHoldsForLongerRunsAndIsNoLooserThanItMustBe) {
  constexpr double kOfRounding = 4e-9;  // a bound that is less is mostly what rounding leaves of the rate
  std::vector<double> ratios;
  std::size_t inside = 0;
  for (const auto& judged : judged_sample()) {
    const double bound = *judged.trend.azimuth_rate_bound_95_rad_s, size = std::abs(judged.true_rate_rad_s);
    // The longer run's own error counts as well.
    inside += judged.error() <= bound + judged.true_bound_rad_s;
    if (bound > kOfRounding * size) ratios.push_back(bound / judged.error());
  }
  // If 93.5 % of all tops are inside, fewer than 57 of 66 are in one of 100 samples.
  EXPECT_GE(inside, 57U);
  ASSERT_GE(ratios.size(), 15U);
  std::ranges::sort(ratios);
  // Over 367 tops the median was 7.4. The ratios are so widely spread that 28 % are above 41, and of 27 of them, as here, the median is in
  // one of 100 samples.
  EXPECT_LT(ratios[ratios.size() / 2], 41);
}

TEST(Theory, IsWithinItsStatedErrorWhereItApplies) {
  std::size_t seen = 0, applies = 0, holds = 0;
  for (const auto& judged : judged_sample()) {
    const TheoryReport& theory = judged.theory;
    if (theory.name != "precession_rate_change" || !theory.computed) continue;
    ++seen;
    if (!theory.applies) continue;
    ++applies;
    holds += std::abs(theory.predicted - *theory.computed) <= theory.predicted_error + *theory.computed_error;
  }
  EXPECT_GE(seen, 40U);
  EXPECT_GE(10 * applies, 6 * seen);     // its domain is not needlessly small
  EXPECT_GE(100 * holds, 94 * applies);  // as often as the computed rate's bound holds
}

// The formula of a fast top, -Omega sin(latitude), is what is left of the prediction where the spin is fast.
TEST(Theory, OfAFastTopIsOmegaSineOfTheLatitude) {
  Scenario s = toy_top();
  s.release.spin_rad_s = 3200;
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  s.duration_s = 1;
  const RunResult result = run(s);
  ASSERT_EQ(result.theory.size(), 1U);
  const double expected = -s.rotation_rate_rad_s * std::sin(s.site.latitude_deg * std::numbers::pi / 180);
  EXPECT_NEAR(result.theory[0].predicted, expected, 1e-3 * std::abs(expected));
  EXPECT_FALSE(result.theory[0].computed);  // a second is less than a turn
}

// Slow tops released next to the vertical: their mean precession bends within the part of the constants over which it is
// differentiated, so that a wrong derivative would look as good as a right one.
TEST(Theory, NextToTheVerticalItAppliesOnlyWhereItHolds) {
  std::size_t seen = 0;
  std::size_t applied = 0;
  for (const double spin : {5.0, 65.0, 75.0, 85.0, 92.0})  // the critical spin is 93.9 rad/s
    for (const double tilt : {0.2, 0.5, 1.0, 5.0, 20.0}) {
      Scenario s = toy_top();
      s.release.spin_rad_s = spin;
      s.release.tilt_deg = tilt;
      s.duration_s = 30;
      const RunResult result = run(s);
      if (result.theory.empty() || !result.theory[0].computed) continue;
      const TheoryReport& theory = result.theory[0];
      ++seen;
      applied += theory.applies ? 1 : 0;
      if (theory.applies)
        EXPECT_LE(std::abs(theory.predicted - *theory.computed), theory.predicted_error + *theory.computed_error)
            << spin << " rad/s, " << tilt << " deg: " << theory.predicted << " " << *theory.computed;
    }
  EXPECT_GE(seen, 15U);
  EXPECT_GE(applied, 5U);
}

}  // namespace
}  // namespace earthtop
