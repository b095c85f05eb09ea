// SPDX-License-Identifier: GPL-3.0-or-later
// Verdicts on motions with friction or a constraint, where neighbouring motions converge, or a brake makes them diverge.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "run/verdict.hpp"
#include "support/effect_scenes.hpp"

namespace earthtop {
namespace {

using testing::kPi;

/// A gyrocompass with the rotor of an instrument; its period is 2 pi sqrt(I1 / (I3 w Omega cos(latitude))).
Scenario compass(double latitude_deg, double azimuth_deg, double spin_rad_s, double damping_N_m_s) {
  Scenario s = testing::gyrocompass(latitude_deg, azimuth_deg, damping_N_m_s);
  testing::set_principal(s.body, 9.1e-5, 9.1e-5, 1.42e-4);
  s.body.mass_kg = 0.35;
  s.release.spin_rad_s = spin_rad_s;
  return s;
}
double period_s(const Scenario& s) {
  const double I1 = s.body.inertia_kg_m2[0][0], I3 = s.body.inertia_kg_m2[2][2];
  return 2 * kPi *
         std::sqrt(I1 / (I3 * s.release.spin_rad_s * s.rotation_rate_rad_s * std::cos(s.site.latitude_deg * kPi / 180)));
}
void last(Scenario& s, double duration_s) {
  s.duration_s = duration_s;
  s.output_step_s = duration_s / 50;
}

void expect_reliable(const Scenario& s, const std::string& scene) {
  SCOPED_TRACE(scene);
  const RunResult result = run(s);
  EXPECT_EQ(result.status, RunStatus::completed);
  EXPECT_EQ(result.verdict.verdict, Verdict::reliable) << result.verdict.reason;
  EXPECT_FALSE(result.verdict.from_s);
  EXPECT_FALSE(result.verdict.earth_grown_s);
  EXPECT_LE(result.verdict.lyapunov_exponent_1_s.value_or(0), 0);
}

// On an Earth that turns 137 times as fast, two periods take two seconds.
TEST(DissipativeVerdict, SettledAndLibratingCompassesAreReliable) {
  for (const auto& [latitude_deg, azimuth_deg] : {std::pair{52.0, 20.0}, {-30.0, -150.0}})
    for (const double damping : {0.0, 1e-3}) {
      Scenario s = compass(latitude_deg, azimuth_deg, 400, damping);
      s.rotation_rate_rad_s = 0.01;
      last(s, 2 * period_s(s));
      expect_reliable(s, "azimuth " + std::to_string(azimuth_deg) + " damping " + std::to_string(damping));
    }
}

// A fast spin braked for three seconds. Disturbances that the gimbal forbids, which a coarse integration produces, must not
// show in the growth. The finer integration has the same equations and a thousandth of the error.
TEST(DissipativeVerdict, DisturbancesStayOnTheConstraint) {
  const Scenario s = compass(52, 20, 2513.27, 1e-5);
  const auto problem = Scene(s).problem<double>();
  for (const MotionKind kind : {MotionKind::reference, MotionKind::rotating}) {
    const GrowthReport coarse = disturbance_growth(problem, kind, 3, 1e-7), fine = disturbance_growth(problem, kind, 3, 1e-10);
    ASSERT_TRUE(coarse.completed && fine.completed);
    EXPECT_NEAR(coarse.rises.back().log_growth, fine.rises.back().log_growth, 0.1);
    EXPECT_LT(coarse.rises.back().log_growth, std::log(1 + problem.units.rate_to_rad_s(problem.fastest_rate) * 3));
    EXPECT_EQ(coarse.late_exponent_1_s, 0.0);
  }
}

// Released at rest toward the South, the compass is in unstable equilibrium: the Earth's rotation drives it away, and
// neighbouring motions diverge.
TEST(DissipativeVerdict, ACompassThatPointsSouthIsUnstable) {
  Scenario s = compass(45, 180, 600, 0);
  s.rotation_rate_rad_s = 0.01;
  const double rate = 2 * kPi / period_s(s);
  last(s, 22 / rate);
  const RunResult result = run(s);
  EXPECT_EQ(result.verdict.verdict, Verdict::unstable) << result.verdict.reason;
  EXPECT_NEAR(result.verdict.lyapunov_exponent_1_s.value_or(0), rate, 0.1 * rate);
}

constexpr double kMgl = 5 * 9.80665 * 0.004, kI1 = 5e-4, kI3 = 8e-4;
const double kCriticalSpin = 2 * std::sqrt(kI1 * kMgl) / kI3;  // rad/s

/// A heavy top with a given multiple of its critical spin.
Scenario heavy_top(double share_of_critical_spin, double tilt_deg) {
  Scenario s = testing::toy_top();
  s.body.mass_kg = 5;
  s.body.center_of_mass_m = {0, 0, 0.004};
  testing::set_principal(s.body, kI1, kI1, kI3);
  s.release.tilt_deg = tilt_deg;
  s.release.spin_rad_s = share_of_critical_spin * kCriticalSpin;
  return s;
}

void expect_unstable_from(const Scenario& s, double critical_s, const std::string& scene) {
  SCOPED_TRACE(scene);
  const RunResult result = run(s);
  EXPECT_EQ(result.verdict.verdict, Verdict::unstable) << result.verdict.reason;
  ASSERT_TRUE(result.verdict.from_s);
  // Upright, the spin decays as it would alone; leaning, the precession takes a share of the square of the tilt from it.
  const double lean = s.release.tilt_deg * kPi / 180;
  EXPECT_NEAR(*result.verdict.from_s, critical_s, (1e-4 + 4 * lean * lean) * critical_s);
  for (const DriftRow& row : result.rows) EXPECT_EQ(row.drift_reliable, row.t_s < *result.verdict.from_s) << row.t_s;
}

TEST(DissipativeVerdict, ATopBrakedPastItsCriticalSpinIsUnstableFromThereOn) {
  constexpr double kFactor = 1.5;
  for (const double tilt_deg : {0.0, 0.01, 1.0, 2.0}) {
    Scenario s = heavy_top(kFactor, tilt_deg);
    s.effects.applied.viscous_N_m_s = 2e-4;
    last(s, 4);
    expect_unstable_from(s, kI3 / 2e-4 * std::log(kFactor), "viscous, tilt " + std::to_string(tilt_deg));
  }
  Scenario s = heavy_top(kFactor, 0);
  s.effects.applied.quadratic_N_m_s2 = 1e-5;
  last(s, 4);
  const double w0 = kFactor * kCriticalSpin;
  expect_unstable_from(s, kI3 / (1e-5 * w0) * (kFactor - 1), "quadratic");
  s.effects.applied.quadratic_N_m_s2 = 0;
  s.effects.applied.coulomb_N_m = 5e-3;
  expect_unstable_from(s, kI3 * (w0 - kCriticalSpin) / 5e-3, "dry");
}

TEST(DissipativeVerdict, ATopThatStaysAboveItsCriticalSpinIsReliable) {
  for (const double tilt_deg : {0.0, 1.0, 28.6}) {
    Scenario s = heavy_top(3, tilt_deg);
    s.effects.applied.viscous_N_m_s = 2e-4;
    last(s, 0.9 * kI3 / 2e-4 * std::log(3));
    expect_reliable(s, "viscous, tilt " + std::to_string(tilt_deg));
    s.effects.applied.viscous_N_m_s = 0;
    s.effects.applied.air_drag.emplace().disc_radius_m = 0.05;
    expect_reliable(s, "air, tilt " + std::to_string(tilt_deg));
  }
}

// A top that leans by ten degrees when its spin falls below the critical one of an upright top only comes to lean more.
TEST(DissipativeVerdict, ABrakedTopThatLeansIsNotUpright) {
  Scenario s = testing::toy_top();
  s.site.latitude_deg = 7.5521;
  s.site.gravity_m_s2 = 9.80665;
  s.body.mass_kg = 0.180726;
  s.body.center_of_mass_m = {0, 0, 0.00198623};
  s.body.inertia_about = InertiaAbout::center_of_mass;
  testing::set_principal(s.body, 1.31693e-05, 1.31693e-05, 2.32796e-05);
  s.release.tilt_deg = 9.6359, s.release.azimuth_deg = -10.716, s.release.spin_angle_deg = 263.24;
  s.release.spin_rad_s = -73.3119;
  s.release.precession = Precession::given;
  s.release.precession_rate_rad_s = 1.44528;
  s.effects.applied.coulomb_N_m = 0.000918374;
  s.duration_s = 2.087, s.output_step_s = 0.2087;
  const RunResult result = run(s);
  EXPECT_EQ(result.verdict.verdict, Verdict::reliable) << result.verdict.reason;
  EXPECT_TRUE(is_all_reliable(result));
  for (const double tilt_deg : {5.0, 10.0, 20.0}) {
    Scenario leaning = heavy_top(1.5, tilt_deg);
    leaning.effects.applied.viscous_N_m_s = 2e-4;
    last(leaning, 4);
    expect_reliable(leaning, "tilt " + std::to_string(tilt_deg));
  }
}

TEST(DissipativeVerdict, LibratingPendulumsAreReliable) {
  for (const double tilt_deg : {95.0, 150.0, 179.0})
    for (const double viscous : {0.0, 1e-6, 1e-5}) {
      Scenario s = testing::toy_top();
      s.release.tilt_deg = tilt_deg;
      s.release.spin_rad_s = 1;
      s.effects.applied.viscous_N_m_s = viscous;
      if (viscous == 0) s.effects.applied.gravity_gradient = GravityGradientSpec{};
      last(s, 6);
      expect_reliable(s, "tilt " + std::to_string(tilt_deg) + " viscous " + std::to_string(viscous));
    }
}

TEST(DissipativeVerdict, PlatformsAwayFromResonanceAreReliable) {
  for (const double frequency_hz : {0.1, 1.0, 20.0})
    for (const int across : {0, 1}) {
      Scenario s = testing::toy_top();
      PlatformSpec& platform = s.platform.emplace();
      platform.motion = PlatformMotion::harmonic;
      platform.axis = across ? std::array<double, 3>{1, 0, 0} : std::array<double, 3>{0, 0, 1};
      platform.amplitude_rad = 0.05;
      platform.frequency_hz = frequency_hz;
      platform.pivot_offset_m = {0.1, 0, 0.05};
      last(s, 6);
      expect_reliable(s, "frequency " + std::to_string(frequency_hz) + (across ? " level axis" : " vertical axis"));
    }
}

// In a scene made for a large effect of the Earth, a turn of 0.1 rad by that effect does not mean that the motion is lost.
TEST(DissipativeVerdict, TheEarthsOwnDisturbanceIsNoSignWhereItsEffectIsMeantToBeLarge) {
  Scenario s = testing::asymmetric_top();
  s.body.mass_kg = 5;
  s.body.center_of_mass_m = {0.001, 0, 0.004};
  testing::set_principal(s.body, 5e-4, 6e-4, 8e-4);
  s.release = {};
  s.release.quaternion_LB = {std::cos(0.25), std::sin(0.25), 0, 0};
  s.release.rates_relative_to = RatesRelativeTo::inertial;
  s.release.angular_velocity_body_rad_s = {1, 2, 20};
  last(s, 12);
  const RunResult small = run(s);
  EXPECT_EQ(small.verdict.verdict, Verdict::chaotic) << small.verdict.reason;
  EXPECT_TRUE(small.verdict.earth_grown_s);
  s.rotation_rate_rad_s = 0.5;
  const RunResult large = run(s);
  EXPECT_FALSE(large.verdict.earth_grown_s) << large.verdict.reason;
}

// A run that fails at its release has only that row, whose zero drift means nothing.
TEST(Verdict, NoneWithoutARowBeyondTheRelease) {
  RunResult result;
  result.scene = result.modelled = testing::toy_top();
  result.status = RunStatus::step_underflow;
  for (const std::size_t rows : {0, 1}) {
    result.rows.resize(rows);
    const VerdictReport verdict = assess_verdict(result, {}, growth_of(result, {}));
    EXPECT_EQ(verdict.verdict, Verdict::unassessed) << rows;
    EXPECT_FALSE(verdict.lyapunov_exponent_1_s);
    EXPECT_FALSE(verdict.from_s);
  }
}

/// A top that leans, with weak friction, a slow tide and the gravity gradient, each in some of the scenes.
Scenario weakly_driven_top(std::mt19937_64& random) {
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  Scenario s = testing::toy_top();
  const double I1 = 1.2e-4 * std::exp(uniform(-1, 1)), I3 = I1 * uniform(0.2, 1.8);
  testing::set_principal(s.body, I1, I1, I3);
  s.release.tilt_deg = uniform(5, 160);
  s.release.spin_rad_s = uniform(40, 400);
  last(s, uniform(3, 20));
  AppliedTorquesSpec& applied = s.effects.applied;
  const double viscous = I3 / s.duration_s * std::exp(uniform(-6, 0));
  if (uniform(0, 1) < 0.6) applied.viscous_N_m_s = viscous;
  if (uniform(0, 1) < 0.3) applied.quadratic_N_m_s2 = viscous / s.release.spin_rad_s;
  if (uniform(0, 1) < 0.3) applied.air_drag.emplace().disc_radius_m = 0.02;
  if (uniform(0, 1) < 0.4) applied.gravity_gradient = GravityGradientSpec{};
  if (uniform(0, 1) < 0.4) {
    TideSpec& tide = s.effects.tide.emplace();
    tide.given = true, tide.amplitude_m_s2 = {1e-5, 1e-5, -1e-5}, tide.frequency_hz = std::exp(uniform(-4, 4));
  }
  return s;
}

// A verdict that no growth need be followed is held to the growth that is followed, on both sides of its limits.
TEST(DissipativeVerdict, NextToAClosedFormNothingGrows) {
  std::mt19937_64 random(20);
  int next_to_it = 0;
  for (int i = 0; i < 30; ++i) {
    const Scenario s = weakly_driven_top(random);
    const Scene scene(s);
    const auto& problem = scene.problem<double>();
    if (growth_tolerance(problem, s.duration_s)) continue;
    ++next_to_it;
    for (const MotionKind kind : {MotionKind::reference, MotionKind::rotating}) {
      const GrowthReport growth = disturbance_growth(problem, kind, s.duration_s, kCoarseGrowthTolerance);
      EXPECT_TRUE(growth.completed);
      EXPECT_FALSE(growth.exponential_s) << i;
      EXPECT_LE(growth.late_exponent_1_s.value_or(0), 0) << i;
    }
  }
  EXPECT_GT(next_to_it, 8);
  EXPECT_LT(next_to_it, 30);
}

TEST(DissipativeVerdict, GrowthIsFollowedWhereItMightBe) {
  const auto followed = [](const Scenario& s) {
    return growth_tolerance(Scene(s).problem<double>(), s.duration_s).has_value();
  };
  Scenario damped = testing::toy_top();
  damped.effects.applied.viscous_N_m_s = 1e-8;
  EXPECT_FALSE(followed(damped));
  damped.effects.applied.viscous_N_m_s = 2e-7;  // takes a third of the spin in a minute
  EXPECT_TRUE(followed(damped));

  // Upright at 1.15 times the critical spin, and at 1.2 times with friction that takes it to 1.05 times.
  Scenario upright = testing::toy_top();
  upright.release.tilt_deg = 0.5;
  const double critical = 2 * std::sqrt(0.1 * 9.80665 * 0.03 * 1.2e-4) / 4e-5;
  upright.effects.applied.viscous_N_m_s = 1e-9;
  upright.release.spin_rad_s = 1.2 * critical;
  EXPECT_FALSE(followed(upright));
  upright.effects.applied.viscous_N_m_s = 4e-5 * 0.13 / 60;
  EXPECT_TRUE(followed(upright));
  upright.effects.applied.viscous_N_m_s = 1e-9;
  upright.release.spin_rad_s = 1.05 * critical;
  EXPECT_TRUE(followed(upright));

  Scenario driven = testing::toy_top();
  TideSpec& tide = driven.effects.tide.emplace();
  tide.given = true, tide.amplitude_m_s2 = {1e-6, 0, 0}, tide.frequency_hz = 0.1;
  EXPECT_FALSE(followed(driven));
  driven.duration_s = 3600;
  EXPECT_TRUE(followed(driven));
  driven.duration_s = 60;
  driven.effects.tide->amplitude_m_s2 = {1e-3, 0, 0};
  EXPECT_TRUE(followed(driven));

  Scenario carried = testing::toy_top();
  carried.platform = PlatformSpec{PlatformMotion::harmonic, {1, 0, 0}, 0, 0, 0.001, 0.2, 0, {0, 0, 0}};
  EXPECT_TRUE(followed(carried));
}

}  // namespace
}  // namespace earthtop
