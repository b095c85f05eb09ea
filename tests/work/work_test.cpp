// SPDX-License-Identifier: GPL-3.0-or-later
// The estimated work of a run, and where a run is stopped that takes far more.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/scene/scene.hpp"
#include "run/assemble.hpp"
#include "work/estimated_work.hpp"

namespace earthtop {
namespace {

using testing::ratio;
using testing::toy_top;

TEST(WorkEstimate, HoldsForRandomScenes) { testing::expect_work_as_estimated(2); }

// Scenes with little motion: a pendulum that dry friction does not hold, a wheel at a pole, whose drift is rounding alone, and
// a disc whose drag stops the spin at once.
TEST(WorkEstimate, CoversWhatHardlyMoves) {
  Scenario pendulum = toy_top(), wheel = toy_top(), disc = toy_top();
  pendulum.release.tilt_deg = 120;
  pendulum.release.spin_rad_s = 0;
  pendulum.effects.applied.coulomb_N_m = 1e-4;
  wheel.site.latitude_deg = 90;
  wheel.release.tilt_deg = 90;
  wheel.release.spin_rad_s = 300;
  wheel.body.center_of_mass_m = {0, 0, 0};
  wheel.effects.applied.gimbal = GimbalSpec{};
  wheel.duration_s = 0.5;
  disc.effects.applied.air_drag = AirDragSpec{10};
  disc.duration_s = 10;
  for (const Scenario& s : {pendulum, wheel, disc}) {
    const testing::WorkDone done = testing::work_done(s);
    EXPECT_EQ(done.status[0], RunStatus::completed);
    EXPECT_EQ(done.status[1], RunStatus::completed);
    EXPECT_LT(ratio(done), 5);
    EXPECT_GT(ratio(done), 0.02);
  }
}

/// A top with friction; `understated` sets its pace far too low, so that it stops at the least work that is always granted.
Scenario long_enough() {
  Scenario s = toy_top();
  s.duration_s = 200;
  s.output_step_s = 1;
  s.effects.applied.viscous_N_m_s = 1e-8;
  return s;
}
DriftProblem<double> understated() {
  const Scenario s = long_enough();
  DriftProblem<double> problem = Scene(s).problem<double>();
  problem.pace.turning_rad = 1;
  problem.pace.watched_angle_rad = 0;
  problem.pace.undamped_rest_rad = problem.pace.damping = 0;
  problem.pace.rows = 1;
  return problem;
}
IntegrationOptions options_of(Method method) {
  IntegrationOptions options;
  options.method = method;
  options.relative_tolerance = 1e-13;
  return options;
}

// Up to the stop, the rows are those of an unlimited run, to the last bit; a second run gives the same.
TEST(WorkLimit, AnIntegrationStopsWithItsRowsAtTenTimesTheEstimate) {
  DriftProblem<double> problem = understated();
  for (const Method method : {Method::dop853, Method::rkf78}) {
    IntegrationOptions options = options_of(method);
    const auto stopped = integrate_drift(problem, options), again = integrate_drift(problem, options);
    EXPECT_EQ(stopped.status, RunStatus::step_limit) << to_string(method);
    EXPECT_EQ(stopped.samples.size(), again.samples.size());
    const auto steps = static_cast<double>(stopped.counters.accepted + stopped.counters.rejected);
    const WorkLimit limit = work_limit_for(estimated_work(problem.pace, options, false));
    // A step that has begun is not broken off.
    EXPECT_TRUE(steps >= static_cast<double>(limit.steps) ||
                (stopped.counters.evaluations >= limit.evaluations && stopped.counters.evaluations < limit.evaluations + 1000));
    options.stops_beyond_estimate = false;
    const auto whole = integrate_drift(problem, options);
    EXPECT_EQ(whole.status, RunStatus::completed) << to_string(method);
    ASSERT_GT(whole.samples.size(), stopped.samples.size());
    ASSERT_GT(stopped.samples.size(), 1U);
    for (std::size_t i = 0; i < stopped.samples.size(); ++i)
      EXPECT_EQ(stopped.samples[i].measures.axis, whole.samples[i].measures.axis) << to_string(method) << ' ' << i;
  }
}

// Friction so stiff that steps make no progress, without an estimate made beforehand.
TEST(WorkLimit, AnIntegrationThatStandsStillStops) {
  Scenario s = toy_top();
  s.duration_s = 6;
  const Pace gentle = Scene(s).pace();
  s.effects.applied.viscous_N_m_s = 1e6;
  DriftProblem<double> problem = Scene(s).problem<double>();
  problem.pace = gentle;
  for (const Method method : {Method::dop853, Method::extrapolation, Method::bulirsch_stoer}) {
    const IntegrationOptions options = options_of(method);
    const auto stopped = integrate_drift(problem, options);
    EXPECT_EQ(stopped.status, RunStatus::step_limit) << to_string(method);
    EXPECT_LT(stopped.counters.evaluations, work_limit_for(estimated_work(gentle, options, false)).evaluations + 1000);
  }
  const GrowthReport growth = disturbance_growth(problem, MotionKind::reference, s.duration_s, 1e-7);
  EXPECT_FALSE(growth.completed);
  const WorkLimit limit = work_limit_for(variational_work(gentle, s.duration_s, 1e-7));
  EXPECT_LE(growth.counters.accepted + growth.counters.rejected, limit.steps);
}

// Near the round-off of 113 bits, ten times as many steps are needed as the order of the method suggests. The estimate is right
// within a factor of four; a run stops at ten.
TEST(WorkEstimate, KnowsTheStepsOfTheFinestTolerance) {
  Scenario s = toy_top();
  s.precision = Precision::bits113;
  s.duration_s = s.output_step_s = 0.1;
  DriftProblem<float128> problem = Scene(s).problem<float128>();
  for (const double tolerance : {1e-30, 1e-31, 1e-32}) {
    IntegrationOptions options = options_of(Method::extrapolation);
    options.relative_tolerance = tolerance;
    const auto done = integrate_drift(problem, options);
    ASSERT_EQ(done.status, RunStatus::completed) << tolerance;
    const double taken = static_cast<double>(done.counters.accepted + done.counters.rejected);
    const double promised = estimated_work(problem.pace, options, false).steps;
    EXPECT_LT(taken, 4 * promised) << tolerance;
    EXPECT_GT(taken, promised / 4) << tolerance;
  }
}

// Only rows with a bound are kept, and the outcome names the reason.
TEST(WorkLimit, WhereOnlyTheBoundsIntegrationStopsItsRowsAreKept) {
  const Scenario s = long_enough();
  TwoIntegrations<double> made;
  DriftProblem<double> problem = Scene(s).problem<double>();
  made.options = options_of(Method::dop853);
  plan_first(Scene(s), false, made, problem);
  made.first = integrate_drift(problem, made.options);
  describe(problem, made.options, made.first, s.precision, made.solution);
  make_second(problem, made.looks, made.looks.size(), made.options);
  problem.pace = understated().pace;
  made.other_options = options_of(Method::rkf78);
  made.second = integrate_drift(problem, made.other_options);
  describe(problem, made.other_options, made.second, s.precision, made.certificate);
  ASSERT_EQ(made.second.status, RunStatus::step_limit);
  const RunResult result = assemble_result(s, made, {}, Parts({}, 0));
  EXPECT_EQ(result.status, RunStatus::step_limit);
  EXPECT_EQ(result.solution.status, RunStatus::completed);
  EXPECT_EQ(result.certificate.status, RunStatus::step_limit);
  EXPECT_LE(result.rows.back().t_s, made.second.samples.back().state.t_s);
  EXPECT_GT(result.rows.back().t_s, made.second.samples.back().state.t_s - 2 * s.output_step_s);
  EXPECT_LT(result.rows.size(), static_cast<std::size_t>(Scene(s).rows()));
  EXPECT_NE(why_limited(result).find(
                fmt::format("the second integration, from which the bounds come, (rkf78) was stopped after {} "
                            "steps, {} of them rejected: at least ten times the work estimated",
                            made.second.counters.accepted + made.second.counters.rejected, made.second.counters.rejected)),
            std::string::npos)
      << why_limited(result);
  Scenario few = s;
  few.numerics.step_limit = made.second.counters.accepted;
  const std::string limited = why_limited(assemble_result(few, made, {}, Parts({}, 0)));
  EXPECT_NE(limited.find("rejected: as many as are allowed; later rows would have no bound"), std::string::npos) << limited;
}

std::string refusal(const Scenario& scenario) {
  try {
    Scene(scenario).require_affordable();
  } catch (const ScenarioError& error) {
    return error.diagnostics().front().pointer + ": " + error.diagnostics().front().message;
  }
  return "";
}

// For each kind of friction, a gradient and a precession: scenes that would take longer than anyone waits are refused with the
// reason; slow but feasible ones are not.
TEST(Affordable, StiffFrictionIsRefusedWithTheReason) {
  Scenario s = toy_top();
  s.effects.applied.viscous_N_m_s = 1;  // 25,000 1/s for 60 s: 1.5e6 time constants
  EXPECT_EQ(refusal(s), "");
  s.effects.applied.viscous_N_m_s = 2e8;
  EXPECT_NE(refusal(s).find("/effects/viscous_torque_N_m_s: this friction is too stiff"), std::string::npos) << refusal(s);
  Scenario gimbal = toy_top();
  gimbal.release.tilt_deg = 90;
  gimbal.body.center_of_mass_m = {0, 0, 0};
  gimbal.effects.applied.gimbal = GimbalSpec{1e8};
  EXPECT_NE(refusal(gimbal).find("/effects/gimbal: this friction is too stiff"), std::string::npos) << refusal(gimbal);
}
TEST(Affordable, FastMotionsAreRefusedByTheirSteps) {
  Scenario s = toy_top();
  s.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::given, 1e20};
  EXPECT_NE(refusal(s).find("this scenario needs about"), std::string::npos) << refusal(s);
  Scenario shaken = toy_top();
  shaken.platform = PlatformSpec{};
  shaken.platform->motion = PlatformMotion::harmonic;
  shaken.platform->amplitude_rad = 0.1;
  shaken.platform->frequency_hz = 1e9;
  shaken.platform->pivot_offset_m = {0.1, 0, 0};
  EXPECT_NE(refusal(shaken).find("this scenario needs about"), std::string::npos) << refusal(shaken);
}

TEST(Affordable, SecondsAreToldAsWhatTheyAre) {
  EXPECT_EQ(about_seconds(0), "less than 0.1 s");
  EXPECT_EQ(about_seconds(0.0999), "less than 0.1 s");
  EXPECT_EQ(about_seconds(21.3), "about 21 s");
  EXPECT_EQ(about_seconds(600), "about 10 minutes");
  EXPECT_EQ(about_seconds(1e4), "about 2.8 hours");
  EXPECT_EQ(about_seconds(1e6), "about 12 days");
}

}  // namespace
}  // namespace earthtop
