// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs on a platform whose angle is given by a table, compared with the same turns by formula and with 113-bit arithmetic.

#include <gtest/gtest.h>

#include "support/scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

/// A platform with a table that samples the angle of a formula.
template <class Angle>
PlatformSpec sampled(PlatformSpec formula, double until_s, int intervals, const Angle& angle) {
  AngleTable table;
  for (int i = 0; i <= intervals; ++i) {
    table.t_s.push_back(until_s * i / intervals);
    table.value.push_back(angle(table.t_s.back()));
  }
  PlatformSpec spec;
  spec.motion = PlatformMotion::table;
  spec.axis = formula.axis;
  spec.pivot_offset_m = formula.pivot_offset_m;
  spec.table.rows = std::make_shared<const AngleTable>(std::move(table));
  return spec;
}

Scenario short_scene() {
  Scenario s = testing::toy_top();
  s.duration_s = 2;
  s.output_step_s = 0.125;
  s.rotation_rate_rad_s = 0.01;  // so that the drift depends on where the platform carries the pivot
  return s;
}

/// The largest difference of two runs' axis drifts divided by the largest drift.
double difference(const Scenario& a, const Scenario& b) {
  const RunResult x = run(a), y = run(b);
  EXPECT_EQ(x.status, RunStatus::completed);
  EXPECT_EQ(y.status, RunStatus::completed);
  double worst = 0;
  for (std::size_t i = 0; i < x.rows.size(); ++i)
    worst = std::max(worst, std::abs(x.rows[i].drift_axis_rad - y.rows[i].drift_axis_rad));
  return worst / y.drift.axis_max_rad;
}

// A not-a-knot spline reproduces the ramp's quadratic, so only rounding remains. Angles with 1/64 s and 1/4 rad/s^2 are exact
// doubles.
TEST(TablePlatform, OfARampDriftsLikeTheRamp) {
  Scenario ramp = short_scene(), table = ramp, none = ramp;
  ramp.platform = PlatformSpec{PlatformMotion::ramp, {0, 0.6, 0.8}, 0.5, 0.75, 0, 0, 0, {0.3, 0.1, 0}};
  table.platform = sampled(*ramp.platform, 2, 32, [](double t) { return 0.5 * t + 0.375 * t * t; });
  EXPECT_LT(difference(table, ramp), testing::rounding(500));
  EXPECT_GT(difference(none, ramp), 1e-3);  // the platform counts
}

TEST(TablePlatform, OfAHarmonicTurnConvergesToIt) {
  Scenario swing = short_scene(), table = swing;
  swing.platform = PlatformSpec{PlatformMotion::harmonic, {0, 0.6, 0.8}, 0, 0, 0.5, 0.75, 30, {0.3, 0.1, 0}};
  const auto angle = [](double t) { return 0.5 * std::sin(2 * real::pi<double>() * 0.75 * t + real::pi<double>() / 6); };
  const auto error = [&](int intervals) {
    table.platform = sampled(*swing.platform, 2, intervals, angle);
    return difference(table, swing);
  };
  const double coarse = error(32), fine = error(64);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(coarse / fine, 3);  // at least like the acceleration's h^2
}

TEST(TablePlatform, DriftAndBoundAgainstExtendedPrecision) {
  Scenario scene = short_scene();
  scene.duration_s = 0.5, scene.output_step_s = 0.03125;
  PlatformSpec tilted;
  tilted.axis = {1, 1, 0.2}, tilted.pivot_offset_m = {0.1, -0.2, 0.3};
  // A turn without a simple formula, with a jump of its third derivative at each of 13 rows.
  scene.platform = sampled(tilted, 0.5, 13, [](double t) { return 0.3 * std::abs(std::sin(9 * t)) + 0.02 * std::cos(40 * t); });
  testing::expect_sound(scene, Observer::inertial);
}

TEST(TablePlatform, ItsLedgerCloses) {
  Scenario scene = short_scene();
  scene.platform = sampled(PlatformSpec{PlatformMotion::table, {0.3, -0.2, 1}, 0, 0, 0, 0, 0, {0.25, -0.125, 0.0625}}, 2, 50,
                           [](double t) { return 0.5 * std::sin(5 * t); });
  for (const LedgerObserver observer :
       {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::platform, LedgerObserver::body}) {
    scene.ledger = observer;
    const RunResult result = run(scene);
    ASSERT_TRUE(result.ledger);
    EXPECT_LT(result.ledger->largest.relative_residual(), 2e-15) << to_string(observer);  // as of other scenes
    // Nothing but the table's acceleration makes a transverse torque to the platform's observer.
    EXPECT_TRUE(observer != LedgerObserver::platform || result.ledger->largest.tau_trans > 0);
  }
}

TEST(TablePlatform, NaturalUnitsHoldItsRateAndAcceleration) {
  BodySpec balanced;
  balanced.mass_kg = 1;
  testing::set_principal(balanced, 1, 1, 1);
  const auto units_of = [&](const PlatformSpec& spec) {
    const Platform<double> platform = make_platform<double>(spec);
    return natural_units(make_body<double>(balanced), Release<double>(), 0, 0, &platform);
  };
  PlatformSpec ramp;
  ramp.motion = PlatformMotion::ramp, ramp.rate_rad_s = 1000;
  EXPECT_EQ(units_of(sampled({}, 2, 8, [](double t) { return 1000 * t; })).time_exponent, units_of(ramp).time_exponent);
  ramp.rate_rad_s = 0, ramp.acceleration_rad_s2 = 4e6;
  EXPECT_EQ(units_of(sampled({}, 0x1p-20, 8, [](double t) { return 2e6 * t * t; })).time_exponent,
            units_of(ramp).time_exponent);
}

TEST(TablePlatform, WithoutATableIsRefused) {
  PlatformSpec spec;
  spec.motion = PlatformMotion::table;
  EXPECT_THROW(make_platform<double>(spec), std::invalid_argument);
}

}  // namespace
}  // namespace earthtop
