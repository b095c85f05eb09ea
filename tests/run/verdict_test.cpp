// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict on a run's drift, for motions of known stability.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/results/headline.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {
namespace {

constexpr double kHeavyRotorMgl = 5 * 9.80665 * 0.004;  // N m

Scenario scene(const std::array<double, 3>& moments, const std::array<double, 3>& center_of_mass_m, double duration_s) {
  Scenario scenario;
  scenario.site.latitude_deg = 45;
  scenario.site.gravity_m_s2 = 9.80665;
  scenario.body.mass_kg = 5;
  scenario.body.center_of_mass_m = center_of_mass_m;
  for (std::size_t i = 0; i < 3; ++i) scenario.body.inertia_kg_m2[i][i] = moments[i];
  scenario.duration_s = duration_s;
  scenario.output_step_s = duration_s / 200;
  return scenario;
}

/// An asymmetric top that leans by half a radian: chaotic when it spins slowly, regular when it spins fast.
Scenario unsymmetric_top(double spin_rad_s, double duration_s) {
  Scenario scenario = scene({5e-4, 6e-4, 8e-4}, {0.001, 0, 0.004}, duration_s);
  scenario.release.quaternion_LB = {std::cos(0.25), std::sin(0.25), 0, 0};
  scenario.release.rates_relative_to = RatesRelativeTo::inertial;
  scenario.release.angular_velocity_body_rad_s = {1, 2, spin_rad_s};
  return scenario;
}

Scenario sleeping_top(double share_of_critical_spin, double duration_s) {
  Scenario scenario = scene({5e-4, 5e-4, 8e-4}, {0, 0, 0.004}, duration_s);
  scenario.release.spin_rad_s = share_of_critical_spin * 2 * std::sqrt(5e-4 * kHeavyRotorMgl) / 8e-4;
  return scenario;
}

/// A body that spins about its middle axis; the two other rates are `seed` times as large.
Scenario tumbling_body(double seed, double duration_s) {
  Scenario scenario = scene({1, 2, 3}, {0, 0, 0}, duration_s);
  scenario.release.angular_velocity_body_rad_s = {seed, 1, seed};
  scenario.release.rates_relative_to = RatesRelativeTo::laboratory;
  return scenario;
}

TEST(Growth, IsThatOfANearbyMotion) {
  // Two motions of a chaotic top, a millionth of a radian apart in the direction of the first disturbance.
  const Scenario scenario = unsymmetric_top(20, 6);
  auto problem = Scene(scenario).problem<double>();
  IntegrationOptions options;
  options.method = Method::rkf78;
  options.observer = Observer::inertial;
  options.relative_tolerance = 1e-14;
  const auto motion = integrate_motion(problem, options);
  constexpr double kSmall = 1e-6;
  const double w0 = Scene(scenario).fastest_rate_rad_s(), share = kSmall / std::sqrt(6.0);
  const Vec3<double> ones(1, 1, 1);
  problem.release.q_LB = problem.release.q_LB * Quaternion<double>{1, Vec3<double>(share / 2 * ones)};
  problem.release.w_XB_B += share * w0 * ones;
  const auto other = integrate_motion(problem, options);
  double log_growth = 0;
  for (std::size_t i = 0; i < motion.samples.size(); ++i) {
    const auto& a = motion.samples[i];
    const auto& b = other.samples[i];
    const double turn = 2 * norm((a.q_LB.conjugate() * b.q_LB).v);
    log_growth = std::max(log_growth, std::log(std::hypot(turn, norm(Vec3<double>(b.w_LB_B - a.w_LB_B)) / w0) / kSmall));
  }
  ASSERT_GT(log_growth, 4);
  const GrowthReport growth =
      disturbance_growth(Scene(scenario).problem<double>(), MotionKind::rotating, scenario.duration_s, 1e-9);
  ASSERT_TRUE(growth.completed);
  // The growth follows three disturbances, of which this is one.
  EXPECT_GT(growth.rises.back().log_growth, log_growth - 0.1);
  EXPECT_LT(growth.rises.back().log_growth, log_growth + 1.5);
}

TEST(Growth, OfAFallingTopIsThatOfTheLinearTheory) {
  for (const double f : {0.5, 0.9, 0.99}) {
    const Scenario scenario = sleeping_top(f, 20);
    const GrowthReport growth = disturbance_growth(Scene(scenario).problem<double>(), MotionKind::reference, 20, 1e-12);
    const double expected = std::sqrt(kHeavyRotorMgl / 5e-4) * std::sqrt(1 - f * f);
    const auto from = growth.passes_s(10), to = growth.passes_s(40);
    ASSERT_TRUE(from && to) << f;
    EXPECT_NEAR(30 / (*to - *from), expected, 1e-5 * expected) << f;  // the times are found between steps
  }
}

TEST(Verdict, AChaoticTopIsFoundOutAndAFastOneIsNot) {
  const RunResult chaotic = run(unsymmetric_top(20, 30));
  EXPECT_EQ(chaotic.verdict.verdict, Verdict::chaotic);
  ASSERT_TRUE(chaotic.verdict.from_s);
  EXPECT_LT(*chaotic.verdict.from_s, 15);
  EXPECT_GT(*chaotic.verdict.from_s, 2);
  EXPECT_NEAR(*chaotic.verdict.lyapunov_exponent_1_s, 1.233, 0.3);  // of this span; 1.233 is the limit
  for (const DriftRow& row : chaotic.rows) EXPECT_EQ(row.drift_reliable, row.t_s < *chaotic.verdict.from_s);
  ASSERT_NE(last_reliable_row(chaotic), nullptr);
  EXPECT_LT(last_reliable_row(chaotic)->drift_attitude_bound_rad, 1e-6);

  const RunResult regular = run(unsymmetric_top(200, 60));
  EXPECT_EQ(regular.verdict.verdict, Verdict::reliable);
  EXPECT_FALSE(regular.verdict.from_s);
  EXPECT_EQ(regular.verdict.reliable_until_s, 60);
  EXPECT_LT(*regular.verdict.lyapunov_exponent_1_s, 0.2);
}

TEST(Verdict, SaysUntilWhenAnUnstableMotionIsKnown) {
  // Rates of 1e-16 make the body flip at 66.8 s; by then the effect of rounding cannot be told from that of such a seed.
  const double rate = std::sqrt(1.0 / 3);
  for (const double seed : {0.0, 1e-16}) {
    Scenario scenario = tumbling_body(seed, 100);
    scenario.rotation_rate_rad_s = 0;
    const RunResult result = run(scenario);
    EXPECT_EQ(result.verdict.verdict, Verdict::unstable) << seed;
    ASSERT_TRUE(result.verdict.from_s) << seed;
    EXPECT_LT(*result.verdict.from_s, std::log(1 / 2.2e-16) / rate) << seed;
    EXPECT_GT(*result.verdict.from_s, std::log(1e8) / rate) << seed;
    EXPECT_EQ(result.drift.axis_max_rad, 0);
  }
  // On the Earth its own disturbance makes the body flip, long before rounding counts.
  const RunResult seeded = run(tumbling_body(0, 30));
  EXPECT_EQ(seeded.verdict.verdict, Verdict::unstable);
  EXPECT_FALSE(seeded.verdict.from_s);
  ASSERT_TRUE(seeded.verdict.earth_grown_s);
  EXPECT_NEAR(*seeded.verdict.earth_grown_s, std::log(0.1 / 7.3e-5) / rate, 3);
  EXPECT_GT(seeded.drift.attitude_final_rad, 0.1);
}

/// A scene in the units of a scenario file: moments about the centre of mass, which lies on axis 3.
Scenario given_top(double mass_kg, double lever_m, const std::array<double, 3>& moments, double gravity_m_s2,
                   double latitude_deg) {
  Scenario scenario;
  scenario.site.latitude_deg = latitude_deg;
  scenario.site.gravity_m_s2 = gravity_m_s2;
  scenario.body.mass_kg = mass_kg;
  scenario.body.center_of_mass_m = {0, 0, lever_m};
  scenario.body.inertia_about = InertiaAbout::center_of_mass;
  for (std::size_t i = 0; i < 3; ++i) scenario.body.inertia_kg_m2[i][i] = moments[i];
  return scenario;
}
void turn_out(Scenario& scenario, double tilt_deg, double azimuth_deg, double spin_angle_deg, double spin_rad_s) {
  scenario.release.tilt_deg = tilt_deg;
  scenario.release.azimuth_deg = azimuth_deg;
  scenario.release.spin_angle_deg = spin_angle_deg;
  scenario.release.spin_rad_s = spin_rad_s;
}

// The drift itself is what the Earth has done, not what the growth of some other disturbance would make of it.
TEST(Verdict, TheEarthsDisturbanceHasGrownWhenTheDriftHas) {
  Scenario passes = given_top(4.07761, 0.012117, {0.00770267, 0.0187794, 0.0184162}, 4.13408, 1.0288);
  turn_out(passes, 42.772, 157.27, 265.09, -2.24801);
  passes.duration_s = 30, passes.output_step_s = 0.05;
  const RunResult result = run(passes);
  EXPECT_EQ(result.verdict.verdict, Verdict::chaotic) << result.verdict.reason;
  ASSERT_TRUE(result.verdict.earth_grown_s);
  // In 113 bits, with rows every 0.01 s; between rows 0.05 s apart the drift is not quite exponential.
  constexpr double kKnown_s = 20.74794, kInterpolation_s = 2e-3;
  EXPECT_NEAR(*result.verdict.earth_grown_s, kKnown_s, kInterpolation_s);
  EXPECT_EQ(result.verdict.from_s, result.verdict.earth_grown_s);
  const auto after = std::ranges::find_if(result.rows, [](const DriftRow& row) { return row.drift_attitude_rad > 0.1; });
  EXPECT_LE(*result.verdict.earth_grown_s, after->t_s);
  EXPECT_GE(*result.verdict.earth_grown_s, std::prev(after)->t_s);

  // Two in which it never has: the drift is 1.1e-4 and 0.032 rad at most.
  Scenario top = given_top(0.522685, 0.0304504, {0.000713749, 0.000713749, 0.00117999}, 16.9607, 31.025);
  turn_out(top, 0.017538, 88.441, 4.1621, -16.7964);
  top.release.precession = Precession::given;
  top.release.precession_rate_rad_s = 7.08734;
  top.effects.coriolis = false;
  top.rotation_rate_rad_s = 0.0002076289;
  top.duration_s = 8.241, top.output_step_s = 0.8241;
  Scenario body = given_top(0.0802226, 0.00415929, {6.77359e-06, 6.59761e-06, 3.0507e-06}, 1.18901, 90);
  turn_out(body, 13.117, 148.75, 167.88, 11.5646);
  body.release.rates_relative_to = RatesRelativeTo::inertial;
  body.effects.applied.viscous_N_m_s = 2.96574e-09;
  body.duration_s = 27.49, body.output_step_s = 2.749;
  // The symmetric top comes back to upright three times, and its neighbours with it: they are 3e4 times as far apart at most. (With
  // variational equations that leave out how the torque left out changes, they would seem to be 1e17 times as far apart.)
  for (const auto& [scenario, verdict] : {std::pair{top, Verdict::unstable}, {body, Verdict::chaotic}}) {
    const RunResult never = run(scenario);
    EXPECT_EQ(never.verdict.verdict, verdict) << never.verdict.reason;
    EXPECT_FALSE(never.verdict.earth_grown_s);
    EXPECT_EQ(never.verdict.reason.find("Earth"), std::string::npos) << never.verdict.reason;
  }
  EXPECT_TRUE(run(body).rows.back().drift_reliable);
}

TEST(Verdict, TheHomoclinicTopIsKnownUntilRoundingLeavesIt) {
  const double g = std::sqrt(kHeavyRotorMgl / 5e-4);
  for (const double rate : {0.0, kEarthRateWgs84}) {
    Scenario scenario = scene({5e-4, 5e-4, 8e-4}, {0, 0, 0.004}, 60 / g);
    scenario.rotation_rate_rad_s = rate;
    scenario.release.tilt_deg = 60;
    scenario.release.rates_relative_to = RatesRelativeTo::inertial;
    scenario.release.precession = Precession::given;
    scenario.release.precession_rate_rad_s = 2 * g / std::sqrt(3.0);
    scenario.release.spin_rad_s = std::sqrt(3.0) * g * 5e-4 / 8e-4;
    const RunResult result = run(scenario);
    EXPECT_EQ(result.verdict.verdict, Verdict::unstable) << rate;
    ASSERT_TRUE(result.verdict.from_s) << rate;
    EXPECT_GT(g * *result.verdict.from_s, 20) << rate;
    EXPECT_LT(g * *result.verdict.from_s, 41) << rate;
  }
}

TEST(Verdict, SleepingTopsBelowAtAndAboveTheCriticalSpin) {
  for (const double f : {0.5, 0.9, 0.99}) EXPECT_EQ(run(sleeping_top(f, 10)).verdict.verdict, Verdict::unstable) << f;
  for (const double f : {0.9998, 1.0, 1.0002}) {
    const RunResult result = run(sleeping_top(f, 10));
    EXPECT_EQ(result.verdict.verdict, Verdict::marginal) << f;
    EXPECT_EQ(result.verdict.from_s, 0.0) << f;
    EXPECT_EQ(last_reliable_row(result), nullptr) << f;
  }
  for (const double f : {1.01, 1.2, 2.0}) EXPECT_EQ(run(sleeping_top(f, 10)).verdict.verdict, Verdict::reliable) << f;
}

TEST(Verdict, ADriftWithinItsBoundIsNoise) {
  Scenario scenario = scene({5e-4, 5e-4, 8e-4}, {0, 0, 0.004}, 2);
  scenario.release.tilt_deg = 20;
  scenario.release.spin_rad_s = 200;
  scenario.numerics.method = Method::dopri5;
  scenario.numerics.form = ModelForm::general;
  scenario.numerics.relative_tolerance = 0.1;  // nothing is left of a drift of a tenth of a milliradian
  const RunResult result = run(scenario);
  EXPECT_EQ(result.verdict.verdict, Verdict::noise_floor);
  scenario.numerics.relative_tolerance = 1e-10;
  EXPECT_EQ(run(scenario).verdict.verdict, Verdict::reliable);
}

TEST(Verdict, NoHeadlinePastItsTime) {
  Scenario scenario = unsymmetric_top(20, 15);
  scenario.headline = HeadlineSpec{"drift_attitude_rad", 3.0, 0, 10, "anything"};
  EXPECT_TRUE(check_headline(run(scenario))->met);
  scenario.headline->at_s = 12.0;
  const auto check = check_headline(run(scenario));
  EXPECT_FALSE(check->met);
  EXPECT_FALSE(check->computed);
}

}  // namespace
}  // namespace earthtop
