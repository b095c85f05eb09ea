// SPDX-License-Identifier: GPL-3.0-or-later
/// Cardan suspensions against references of 20 digits, in the equations of both observers, and against other formulations where these
/// hold exactly.
#include <gtest/gtest.h>

#include "earthtop/drift/growth.hpp"
#include "support/gimbal_references.hpp"
#include "support/gimbal_scenes.hpp"

namespace earthtop {
namespace {

using testing::foucault_gyroscope;

class Suspension : public ::testing::TestWithParam<Observer> {};

TEST_P(Suspension, MeetsItsReferences) {
  for (const nlohmann::json& reference : testing::gimbal_references().at("cases")) {
    const testing::GimbalErrors errors = testing::gimbal_errors<double>(reference, GetParam(), 1e-14);
    // A run in double promises 1e-11 of a motion, 1e-9 of the drift, which is 1e-12 of a thousandth of it.
    EXPECT_LT(errors.motion, 1e-11) << reference.at("name");
    EXPECT_LT(errors.relative_drift, 1e-9) << reference.at("name");  // see above
  }
}

INSTANTIATE_TEST_SUITE_P(Observers, Suspension, ::testing::Values(Observer::laboratory, Observer::inertial),
                         [](const auto& chosen) { return std::string(to_string(chosen.param)); });

DriftSample<double> last_of(const Scenario& scenario, Observer observer = Observer::inertial, double tolerance = 1e-14) {
  IntegrationOptions options;
  options.method = Method::taylor, options.observer = observer, options.form = ModelForm::general;
  options.relative_tolerance = tolerance;
  return integrate_drift(Scene(scenario).problem<double>(), options).samples.back();
}

/// Massless gimbals around a thin rod along the rotor's axis: this moves as the Lagrange top with the rod's moment and the rotor's
/// transverse one, and the spin momentum h.
TEST(SuspensionEquivalence, MasslessGimbalsAreALagrangeTop) {
  Scenario s = foucault_gyroscope();
  s.rotation_rate_rad_s = 0.5;
  s.gimbals = GimbalsSpec{};
  s.body.mass_kg = 0.1, s.body.center_of_mass_m = {0, 0, 0.02};
  testing::set_principal(s.body, 3e-4, 3e-4, 0);
  s.rotor->spin_rad_s = 400;
  s.release.gimbals = GimbalReleaseSpec{0, 60, 0, 0};
  s.duration_s = 0.3;
  const DriftSample<double> made = last_of(s);

  Scenario top = s;
  top.gimbals.reset(), top.release.gimbals.reset(), top.rotor.reset();
  const double I1 = 3e-4 + 1.1e-4, I3 = 2e-4;
  top.body.mass_kg = 0.1;
  testing::set_principal(top.body, I1, I1, I3);
  // An outer angle of 0 turns the inner gimbal toward North.
  top.release.tilt_deg = 60, top.release.azimuth_deg = 0, top.release.spin_rad_s = 400;
  IntegrationOptions options;
  options.method = Method::taylor, options.observer = Observer::inertial, options.form = ModelForm::general;
  options.relative_tolerance = 1e-14;
  const DriftSample<double> rigid = integrate_drift(Scene(top).problem<double>(), options).samples.back();
  const Vec3<double> n = rotation_matrix(made.state.q_LB.normalized()).col(2),
                     m = rotation_matrix(rigid.state.q_LB.normalized()).col(2);
  EXPECT_LT(norm(Vec3<double>(n - m)), 2000 * 0x1p-52);                  // some 100 steps that round a few numbers each
  EXPECT_NEAR(made.measures.axis, rigid.measures.axis, 4000 * 0x1p-52);  // a drift of 0.1 rad
}

/// The level gimbal of `effects` is the limit of a massless outer gimbal whose inner axis is locked at 90 degrees.
TEST(SuspensionEquivalence, LevelGimbalIsItsLimit) {
  Scenario s = foucault_gyroscope();
  s.gimbals = GimbalsSpec{};
  s.gimbals->inner.locked = true;
  s.gimbals->outer.viscous_torque_N_m_s = 1e-4;
  testing::set_principal(s.body, 1e-4, 1e-4, 0);
  s.rotor->spin_rad_s = 500;
  s.release.gimbals = GimbalReleaseSpec{-40, 90, 0.2, 0};
  s.duration_s = 3;
  const DriftSample<double> made = last_of(s);

  Scenario level = s;
  level.gimbals.reset(), level.rotor.reset(), level.release.gimbals.reset();
  testing::set_principal(level.body, 1e-4 + 1.1e-4, 1e-4 + 1.1e-4, 2e-4);
  level.effects.applied.gimbal.emplace().damping_N_m_s = 1e-4;
  level.release.tilt_deg = 90, level.release.azimuth_deg = 40;
  // The wheel of the level gimbal has the whole spin about axis 3; the rotor's rate is relative to the body, which has none.
  level.release.angular_velocity_body_rad_s = {-0.2, 0, 500};
  IntegrationOptions options;
  options.method = Method::taylor, options.relative_tolerance = 1e-14;
  const DriftSample<double> limit = integrate_drift(Scene(level).problem<double>(), options).samples.back();
  const Vec3<double> n = rotation_matrix(made.state.q_LB.normalized()).col(2),
                     m = rotation_matrix(limit.state.q_LB.normalized()).col(2);
  EXPECT_LT(norm(Vec3<double>(n - m)), 1e-12);                  // of a swing of a radian, 1000 steps of rounding at most
  EXPECT_NEAR(made.measures.axis, limit.measures.axis, 1e-12);  // the same
}

/// About a polar axis, balanced and matched in inertial rates: the rotating motion is the other one, turned back with the Earth.
TEST(SuspensionEquivalence, PolarAxisOnlyTurnsWithTheEarth) {
  for (const double latitude : {40.0, -75.0}) {
    Scenario s = foucault_gyroscope();
    s.rotation_rate_rad_s = 0.5;
    s.site.latitude_deg = latitude;
    s.gimbals->axis_tilt_deg = 90 - latitude, s.gimbals->axis_azimuth_deg = 0;
    s.gimbals->inner.viscous_torque_N_m_s = 1e-4;
    s.rotor->axis = {0.2, 0.1, 1};
    s.gimbals->axis_skew_deg = 5;
    s.release.gimbals = GimbalReleaseSpec{20, 60, 1, 2};
    s.release.rates_relative_to = RatesRelativeTo::inertial;
    s.duration_s = 0.4;
    const DriftSample<double> made = last_of(s);
    const GimbalState<double>& g = *made.gimbals;
    EXPECT_NEAR(made.state.epsilon * g.outer.diff, -0.5 * s.duration_s, 2000 * 0x1p-52);  // rounding of some 200 steps
    EXPECT_NEAR(made.state.epsilon * g.inner.diff, 0, 2000 * 0x1p-52);                    // the same
    EXPECT_NEAR(made.state.epsilon * made.rotor->angle_difference_scaled, 0, 1e-11);      // of 400 rad
  }
}

/// The drift is found to the same share at any rate of the Earth, and is proportional to it where it is small.
TEST(SuspensionDrift, IsThereAtAnyRateOfTheEarth) {
  Scenario s = foucault_gyroscope();
  s.release.gimbals->inner_rate_rad_s = 2;
  s.rotation_rate_rad_s = 1e-9;
  const DriftSample<double> slow = last_of(s);
  s.rotation_rate_rad_s = 1e-300;
  const DriftSample<double> slowest = last_of(s);
  const double ratio = slowest.measures.axis / slow.measures.axis;
  EXPECT_NEAR(ratio / 1e-291, 1, 1e-8);  // the drift's second order at 1e-9 rad/s, amplified by the swing, is 1e-9 of it
  EXPECT_GT(slowest.measures.axis, 1e-301);
}

/// The nutation makes the outer gimbal drift after Magnus, with an error that falls as the square of its amplitude; a quadrature of the
/// exact motion gives the same to all digits that it has.
TEST(SuspensionTheory, MagnusDriftIsThatOfTheQuadrature) {
  // Means over many whole nutations, from a quadrature of the exact motion (34 digits), at 20, 2 and 0.2 rad/s of the inner gimbal.
  const struct {
    double inner_rate, quadrature, formula;
  } cases[] = {
      {20, -0.1342135697, -0.1340882508}, {2, -1.339737089e-3, -1.339724591e-3}, {0.2, -1.33971316e-5, -1.339713035e-5}};
  for (const auto& [inner_rate, quadrature, formula] : cases) {
    Scenario s = foucault_gyroscope();
    s.rotation_rate_rad_s = 0;
    s.release.gimbals->inner_rate_rad_s = inner_rate;
    s.duration_s = 2, s.output_step_s = 1;
    s.criteria.clear();
    const RunResult result = run(s);
    const auto report = std::ranges::find(result.theory, "magnus_drift", &TheoryReport::name);
    ASSERT_NE(report, result.theory.end()) << inner_rate;
    EXPECT_NEAR(report->predicted, formula, 2e-3 * std::abs(formula))
        << inner_rate;                // its amplitude is that of the run, not of the limit
    constexpr double kDigits = 1e-5;  // of the quadrature's last one
    EXPECT_NEAR(*report->computed, quadrature, kDigits * std::abs(quadrature) + *report->computed_error) << inner_rate;
    EXPECT_LE(*report->computed_error, 1e-2 * std::abs(quadrature)) << inner_rate;  // so that the line above can fail
  }
}

/// A vertical disturbance of an unstable place of rest grows: a suspension with its centre of mass above the axes falls as a pendulum.
TEST(SuspensionGrowth, IsThatOfAnInvertedPendulum) {
  Scenario s = foucault_gyroscope();
  s.rotor.reset();
  s.rotation_rate_rad_s = 1e-6;
  s.gimbals->outer.locked = true;
  s.body.center_of_mass_m = {0, 0, 0.02};
  testing::set_principal(s.body, 1.2e-4, 1.0e-4, 2.0e-4);
  s.release.gimbals = GimbalReleaseSpec{0, 0, 0, 0};
  const double rate = std::sqrt(0.1 * 9.80665 * 0.02 / 1.0e-4);
  s.release.gimbals->inner_angle_deg = 1e-6;  // so that it stays upright for ten e-foldings
  s.duration_s = 10 / rate;
  const GrowthReport report =
      disturbance_growth(Scene(s).problem_without_rows<double>(), MotionKind::reference, s.duration_s, 1e-10);
  EXPECT_TRUE(report.completed);
  // The slope is taken between two points of the growth, far enough from the start for the falling part to be gone.
  const auto settled = std::ranges::find_if(report.rises, [](const GrowthPoint& point) { return point.log_growth > 5; });
  ASSERT_NE(settled, report.rises.end());
  const GrowthPoint& last = report.rises.back();
  EXPECT_NEAR((last.log_growth - settled->log_growth) / (last.t_s - settled->t_s), rate, 1e-3 * rate);  // of the falling part
}

/// The rotor's axis passes the outer one, the gimbals swing round fast, and the motion goes on.
TEST(SuspensionEvents, GimbalLockIsPassed) {
  Scenario s = foucault_gyroscope();
  s.rotor->spin_rad_s = 100;
  s.release.gimbals = GimbalReleaseSpec{20, 8, 0, -14};
  s.duration_s = 1, s.output_step_s = 1;
  const RunResult result = run(s);
  ASSERT_EQ(result.status, RunStatus::completed);
  ASSERT_FALSE(result.gimbal_events.empty());
  for (const GimbalEvent& event : result.gimbal_events) {
    EXPECT_EQ(event.kind, GimbalEventKind::gimbal_lock_passed);
    EXPECT_LT(event.axis_angle_rad, 1e-12);  // with an inner axis that is normal to both the angle is that of the inner gimbal
    ASSERT_TRUE(event.bound_s);
    EXPECT_LT(*event.bound_s, 1e-12);  // passed at 10 rad/s, by angles of 1e-14 rad
  }
  // The same whatever rows were asked for.
  s.output_step_s = 0.01;
  const RunResult finer = run(s);
  ASSERT_EQ(finer.gimbal_events.size(), result.gimbal_events.size());
  for (std::size_t i = 0; i < result.gimbal_events.size(); ++i)
    EXPECT_NEAR(finer.gimbal_events[i].t_s, result.gimbal_events[i].t_s, *result.gimbal_events[i].bound_s);
}

}  // namespace
}  // namespace earthtop
