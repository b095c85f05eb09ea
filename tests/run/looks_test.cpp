// SPDX-License-Identifier: GPL-3.0-or-later
/// Statements on the whole motion do not depend on the output rows, and are true of the motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drift/motion_way.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/scenario.hpp"
#include "run/largest.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
/// Maxima come from polynomials through the looks, or from an integration that ends at their time: errors far below this.
constexpr double kTruncation = 1e-9;

Scenario shipped_scenario(const std::string& name) {
  return parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/" + name + ".json"));
}

Scenario with_rows(Scenario s, int rows) {
  s.output_step_s = s.duration_s / (rows - 1);
  return s;
}

/// A body without symmetry under a tide: the motion is chaotic, and the drift ends beyond a radian.
Scenario tumbling_under_the_moon() {
  return parse_scenario(ScenarioSource{"tumbling-under-the-moon", R"json({
    "name": "tumbling-under-the-moon",
    "site": { "latitude_deg": -42.36, "gravity_m_s2": 4.83397 },
    "body": { "mass_kg": 3.2223, "center_of_mass_m": [0, 0, 0.00434398],
              "inertia": { "about": "center_of_mass", "principal_kg_m2": [0.00083528, 0.00130455, 0.000996628] } },
    "release": { "tilt_deg": 2.8195, "azimuth_deg": 82.324, "spin_angle_deg": 359.53, "spin_rad_s": -6.29037,
                 "precession": { "rate_rad_s": 4.53424 }, "rates_relative_to": "inertial" },
    "effects": { "tide": { "amplitude_m_s2": [-9.458e-05, 0.0002788, 3.611e-05], "frequency_hz": 0.001272, "phase_deg": 133.1 } },
    "motion": { "duration_s": 62.57 }
  })json",
                                       false});
}

/// A body without symmetry whose pivot has dry friction that may stop it; its integration is not a series.
Scenario rubbed() {
  Scenario s = shipped_scenario("asymmetric-top");
  s.duration_s = 3;
  s.effects.applied.coulomb_N_m = 1e-5;
  s.numerics.method = Method::rkf78;
  return s;
}

TEST(Looks, RowsDoNotChangeTheMotion) {
  Scenario s = shipped_scenario("asymmetric-top");
  s.duration_s = 2;
  for (const MethodRow& row : kMethodRows) {
    if (ends_steps_at_rows(row.method) || row.method == Method::automatic || Scene(s).method_refusal(row.method)) continue;
    SCOPED_TRACE(row.word);
    s.numerics.method = row.method;
    const RunResult few = run(with_rows(s, 3)), many = run(with_rows(s, 101));
    const DriftRow &a = few.rows.back(), &b = many.rows.back();
    EXPECT_EQ(a.q_LB, b.q_LB);
    EXPECT_EQ(a.w_LB_B, b.w_LB_B);
    EXPECT_EQ(a.drift_axis_rad, b.drift_axis_rad);
    EXPECT_EQ(few.solution.counters.accepted, many.solution.counters.accepted);
  }
}

TEST(Looks, VerdictBoundsAndMaximaAreThoseOfAnyRows) {
  constexpr double kBounds = 2;  // bounds are those of the largest distance so far, which more rows may show
  for (const Scenario& scene : {shipped_scenario("toy-top"), shipped_scenario("cusped-top"), shipped_scenario("tippe-top"),
                                shipped_scenario("dzhanibekov"), tumbling_under_the_moon(), rubbed()}) {
    SCOPED_TRACE(scene.name);
    const RunResult many = run(with_rows(scene, 10'000));
    for (const int rows : {2, 10, 100}) {
      SCOPED_TRACE(rows);
      const RunResult few = run(with_rows(scene, rows));
      EXPECT_EQ(few.verdict.verdict, many.verdict.verdict);
      EXPECT_EQ(few.verdict.from_s.has_value(), many.verdict.from_s.has_value());
      if (few.verdict.from_s && many.verdict.from_s)
        EXPECT_NEAR(*few.verdict.from_s, *many.verdict.from_s, 1e-6 * *many.verdict.from_s);
      EXPECT_NEAR(few.drift.axis_max_rad, many.drift.axis_max_rad, kTruncation * many.drift.axis_max_rad);
      EXPECT_NEAR(few.drift.tilt_max_rad, many.drift.tilt_max_rad, kTruncation * many.drift.tilt_max_rad);
      for (const DriftRow& row : few.rows) {
        const auto same = std::ranges::lower_bound(many.rows, row.t_s * (1 - 1e-12), {}, &DriftRow::t_s);
        if (same == many.rows.end() || row.t_s == 0 || std::abs(same->t_s - row.t_s) > 1e-9 * scene.duration_s) continue;
        if (!row.drift_reliable) continue;
        EXPECT_LE(row.drift_axis_bound_rad, kBounds * same->drift_axis_bound_rad) << row.t_s;
        EXPECT_LE(same->drift_axis_bound_rad, kBounds * row.drift_axis_bound_rad) << row.t_s;
      }
    }
  }
}

/// The largest drift is held against another method: it is what that method shows at this time, and no row of a hundredth of the nutation
/// shows more.
TEST(Looks, MaximaAndSwingsAreThoseOfTheMotion) {
  for (const char* name : {"toy-top", "cusped-top", "lecture-gyro", "southern-hemisphere", "equator", "matching-inertial",
                           "turntable", "steady-precession-fast", "asymmetric-top", "sleeping-top-above-critical"}) {
    SCOPED_TRACE(name);
    Scenario s = shipped_scenario(name);
    s.duration_s = std::min(s.duration_s, 5.0);
    const RunResult result = run(with_rows(s, 2));
    const DriftSummary& drift = result.drift;

    Scenario other = s;
    other.numerics.method = Method::extrapolation;
    other.numerics.relative_tolerance = 1e-13;
    Scenario until = other;
    until.duration_s = until.output_step_s = drift.axis_max_at_s;
    const double there = run(Scene(until), {.watch = {}, .between = false}).rows.back().drift_axis_rad;
    EXPECT_NEAR(there, drift.axis_max_rad, kTruncation * drift.axis_max_rad);

    other.output_step_s = 2 * kHalfTurn / Scene(s).pace().axis_rate_rad_s / 100;
    const RunResult fine = run(Scene(other), {.watch = {}, .between = false});
    double axis = 0, least_axis = HUGE_VAL, least = HUGE_VAL, most = -HUGE_VAL;
    for (const DriftRow& row : fine.rows) {
      axis = std::max(axis, row.drift_axis_rad), least_axis = std::min(least_axis, row.drift_axis_rad);
      if (!drift.secular || !drift.secular->azimuth_rate_rad_s || row.t_s > result.verdict.reliable_until_s) continue;
      const double rest = *row.drift_azimuth_rad - *drift.secular->azimuth_rate_rad_s * row.t_s;
      least = std::min(least, rest), most = std::max(most, rest);
    }
    // Between two rows a swing is by at most 1 - cos(pi / 100) of its half below its top.
    constexpr double kBetween = kHalfTurn * kHalfTurn / 2e4;
    EXPECT_LE(axis, drift.axis_max_rad * (1 + kTruncation));
    EXPECT_GE(axis, drift.axis_max_rad - kBetween * (axis - least_axis));
    if (!(least < most)) continue;
    const double swing = (most - least) / 2;
    EXPECT_LE(swing, *drift.secular->azimuth_oscillation_rad * (1 + kTruncation));
    EXPECT_GE(swing, *drift.secular->azimuth_oscillation_rad * (1 - 2 * kBetween));
  }
}

TEST(Looks, AreEnoughToFindTheLargestValueOfManyPeriods) {
  // An hour of a fast gyroscope: its looks lie in windows. The last rows of another step see the same value.
  Scenario s = shipped_scenario("fast-gyro");
  s.duration_s = 120;
  const RunResult result = run(with_rows(s, 2));
  ASSERT_GT(result.looks_a_window, 0U);
  EXPECT_GT(result.looks_seconds, 0);
  Scenario until = s;
  until.numerics.method = Method::taylor;
  until.duration_s = until.output_step_s = result.drift.axis_max_at_s;
  const double there = run(Scene(until), {.watch = {}, .between = false}).rows.back().drift_axis_rad;
  EXPECT_NEAR(there, result.drift.axis_max_rad, kTruncation * there);
  EXPECT_GE(result.drift.axis_max_rad, result.drift.axis_final_rad);
}

/// Looks begin at the stops of those before, and by long_horizon they go on by series where they follow each other closely: none of it may
/// be seen in the motion. Rows know nothing of either.
TEST(Looks, AreTheMotionOfTheRows) {
  const auto gyro = [](double spin_rad_s, double rotation_rate_rad_s, RatesRelativeTo relative_to) {
    Scenario s = shipped_scenario("fast-gyro");
    s.release.spin_rad_s = spin_rad_s, s.release.rates_relative_to = relative_to;
    s.rotation_rate_rad_s = rotation_rate_rad_s;
    return s;
  };
  const auto by_series = [](Scenario s, double duration_s) {
    s.numerics.method = Method::taylor;
    s.duration_s = duration_s;
    return s;
  };
  // The drift of the last one goes round several times: a count of turns that is lost at a stop shows.
  Scenario many_turns = by_series(shipped_scenario("toy-top"), 30);
  many_turns.rotation_rate_rad_s = 1;
  for (const Scenario& scenario :
       {gyro(1047.2, 7.292115e-5, RatesRelativeTo::laboratory), gyro(1047.2, 1e-11, RatesRelativeTo::inertial),
        gyro(-700, 7.292115e-5, RatesRelativeTo::inertial), gyro(400, -3e-4, RatesRelativeTo::laboratory),
        by_series(gyro(1047.2, 7.292115e-5, RatesRelativeTo::laboratory), 30),
        by_series(shipped_scenario("asymmetric-top"), 10), many_turns}) {
    SCOPED_TRACE(::testing::Message() << scenario.rotation_rate_rad_s << " rad/s, spin " << scenario.release.spin_rad_s);
    DriftProblem<double> rows = Scene(scenario).problem<double>();
    IntegrationOptions options =
        scenario.numerics.method == Method::taylor ? Scene(scenario).choice().options : IntegrationOptions();
    if (options.method != Method::taylor) options.method = Method::long_horizon;
    options.relative_tolerance = 1e-12;
    options.kick_steps = integrate_drift(rows, options).kick_steps;
    const double period_s = 2 * kHalfTurn * 4e-4 / (5e-4 * std::abs(scenario.release.spin_rad_s));
    const auto windows = [&](double begin_s) {
      std::vector<double> times_s{0};
      for (double at_s = begin_s; at_s < scenario.duration_s - 1; at_s += scenario.duration_s / 6.2)
        for (int k = 0; k < 15; ++k) times_s.push_back(at_s + k * period_s / 9);
      times_s.push_back(scenario.duration_s);
      return times_s;
    };
    const auto way = std::make_shared<MotionWay>();
    for (const double begin_s : {1e-3, 0.42 * scenario.duration_s}) {
      rows.times_s = windows(begin_s);
      DriftProblem<double> looks = rows;
      looks.way = way, looks.are_looks = true;
      const auto aside = integrate_drift(rows, options), seen = integrate_drift(looks, options);
      ASSERT_EQ(seen.samples.size(), aside.samples.size());
      EXPECT_LT(seen.counters.evaluations,
                aside.counters.evaluations * (begin_s < 1 && options.method == Method::taylor ? 2 : 1));
      const double drift = aside.samples.back().measures.axis, rate = norm(aside.samples.back().state.w_LB_B);
      // Attitudes are held to the tolerance. A small drift is interpolated between rates at which it is some thousandths.
      const bool is_small = drift < 1e-6;
      const double error = testing::truncation(options.relative_tolerance);
      const double allowed = testing::truncation(options.relative_tolerance, is_small ? 1000 * drift : 1);
      for (std::size_t i = 0; i < seen.samples.size(); ++i) {
        const DriftSample<double>&a = aside.samples[i], &b = seen.samples[i];
        EXPECT_NEAR(b.measures.axis, a.measures.axis, allowed) << b.state.t_s;
        EXPECT_NEAR(b.measures.tilt, a.measures.tilt, allowed) << b.state.t_s;
        EXPECT_NEAR(b.azimuth, a.azimuth, 2 * allowed) << b.state.t_s;
        EXPECT_NEAR(norm(Vec3<double>(b.state.ref_w_LB_B - a.state.ref_w_LB_B)), 0, error * rate) << b.state.t_s;
        EXPECT_NEAR(norm(Vec3<double>(b.state.w_LB_B - a.state.w_LB_B)), 0, error * rate) << b.state.t_s;
      }
    }
  }
}

/// The sum of two swings on a slope: its largest value is known from a search in small steps.
TEST(Largest, IsFoundBetweenLooks) {
  const auto f = [](double t) { return 0.02 * t + std::sin(t) + 0.2 * std::sin(2.3 * t + 0.4); };
  for (const double step : {2 * kHalfTurn / 2.3 / 12, 2 * kHalfTurn / 2.3 / 17}) {
    std::vector<double> times, values;
    for (double t = 0; t < 40; t += step) times.push_back(t), values.push_back(f(t));
    const auto top = largest_of(times, values);
    ASSERT_TRUE(top);
    double best = 0, at = 0;
    for (double t = 0; t < times.back(); t += 1e-5)
      if (f(t) > best) best = f(t), at = t;
    EXPECT_NEAR(top->value, best, 1e-9);
    EXPECT_NEAR(top->t_s, at, 2e-5);
    EXPECT_LT(top->error, 1e-7);
  }
}

TEST(Largest, IsAtAnEndWhereTheFunctionOnlyGrows) {
  const std::vector<double> times{0, 1, 2, 3, 4}, grows{0, 1, 3, 6, 10}, falls{4, 3, 2, 1, 0};
  EXPECT_EQ(largest_of(times, grows)->t_s, 4);
  EXPECT_EQ(largest_of(times, grows)->value, 10);
  EXPECT_EQ(largest_of(times, falls)->t_s, 0);
  EXPECT_FALSE(largest_of({}, {}));
}

TEST(Largest, IsFoundBetweenAnEndAndTheNextLook) {
  std::vector<double> times, values;
  for (double t = 0; t < 4; t += 0.3) times.push_back(t), values.push_back(-(t - 0.1) * (t - 0.1));
  const auto top = largest_of(times, values);
  EXPECT_NEAR(top->t_s, 0.1, testing::rounding(5000));
  EXPECT_NEAR(top->value, 0, testing::rounding(5000));
}

TEST(Largest, IsNotSoughtAcrossAGap) {
  const double nan = std::nan("");
  const std::vector<double> times{0, 1, 2, 3, 4, 5, 6}, values{0, 1, 0.5, nan, 0.5, 2, 1};
  const auto top = largest_of(times, values);
  EXPECT_NEAR(top->t_s, 5, 0.5);
  EXPECT_GE(top->value, 2);
}

TEST(Largest, PassesALevelWhereThePolynomialDoes) {
  std::vector<double> times, values;
  for (double t = 0; t < 4; t += 0.3) times.push_back(t), values.push_back(std::exp(t));
  EXPECT_NEAR(*first_passing(times, values, 10), std::log(10), 1e-11);  // what is left of a polynomial of the looks' high order
  EXPECT_FALSE(first_passing(times, values, 100));
  // A swing that passes between its highest look, sin(75 deg) = 0.966, and the next one.
  std::vector<double> phases, swings;
  for (int k = 0; k < 40; ++k)
    phases.push_back((15 + 30 * k) * std::numbers::pi / 180), swings.push_back(std::sin(phases.back()));
  EXPECT_NEAR(first_passing(phases, swings, 0.99).value_or(0), std::asin(0.99),
              1e-5);  // a polynomial near the end of the looks
  EXPECT_FALSE(first_passing(phases, swings, 1.001));
}

}  // namespace
}  // namespace earthtop
