// SPDX-License-Identifier: GPL-3.0-or-later
/// Driven symmetric tops and compasses without their spin, against the equations of any body in body axes. The two derivations
/// share nothing but the friction coefficients: vectors beside the axis here, tensors in body axes there.

#include <gtest/gtest.h>

#include <functional>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "support/effect_cases.hpp"
#include "support/tolerances.hpp"

namespace earthtop::driven_top {
namespace {

using testing::fast_earth_top;

struct Case {
  std::string name;
  std::function<void(Scenario&)> add;
};

/// Each effect that drives a top or brakes it, and most of them together.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const testing::EffectCase& one : testing::driving_cases()) all.push_back({one.name, one.add});
  all.push_back({"all", [all](Scenario& s) {
                   for (const Case& one : all)
                     if (one.name != "ramp" && one.name != "turbulent" && one.name != "dry") one.add(s);
                 }});
  return all;
}

DriftTrajectory<double> drift(const Scenario& s, Method method, Observer observer, ModelForm form) {
  IntegrationOptions options;
  options.method = method, options.observer = observer, options.form = form, options.relative_tolerance = 1e-13;
  return integrate_drift(Scene(s).problem<double>(), options);
}

/// The largest differences of the drift (axis, tilt, attitude vector) and of the motions between two trajectories.
struct Distance {
  double drift = 0, motion = 0, size = 0;
};
Distance distance(const DriftTrajectory<double>& a, const DriftTrajectory<double>& b) {
  Distance d;
  EXPECT_EQ(a.status, RunStatus::completed);
  EXPECT_EQ(b.status, RunStatus::completed);
  EXPECT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i) {
    const DriftSample<double>&x = a.samples[i], &y = b.samples[i];
    d.size = std::max(d.size, y.measures.axis);
    const double epsilon = x.state.epsilon;
    d.drift =
        std::max({d.drift, std::abs(x.measures.axis - y.measures.axis), std::abs(x.measures.tilt - y.measures.tilt),
                  epsilon * norm(Vec3<double>(x.measures.attitude_vector_L_scaled - y.measures.attitude_vector_L_scaled))});
    const auto apart = [](const Quaternion<double>& p, const Quaternion<double>& q) { return norm((p.conjugate() * q).v); };
    const double rates = norm(Vec3<double>(x.state.w_LB_B - y.state.w_LB_B)) / norm(y.state.w_LB_B);
    const double ref_rates = norm(Vec3<double>(x.state.ref_w_LB_B - y.state.ref_w_LB_B)) / norm(y.state.ref_w_LB_B);
    d.motion =
        std::max({d.motion, apart(x.state.q_LB, y.state.q_LB), apart(x.state.ref_q_LB, y.state.ref_q_LB), rates, ref_rates});
  }
  return d;
}

// 400 rad of spin by the extrapolation in body axes lose some 1e-10 of the attitude, and less of the drift. In a gimbal the pull
// that keeps the constraint adds some 1e-10 to the drift.
constexpr double kDriftAgrees = 1e-11, kHeldDriftAgrees = 1e-9, kMotionAgrees = 1e-9;

void expect_the_same(const Scenario& s, const Scenario& without, double drift_agrees = kDriftAgrees) {
  const auto general = drift(s, Method::extrapolation, Observer::body, ModelForm::general);
  for (const Observer observer : {Observer::laboratory, Observer::inertial}) {
    const Distance d = distance(drift(s, Method::taylor, observer, ModelForm::reduced), general);
    EXPECT_LT(d.drift, drift_agrees) << to_string(observer);
    EXPECT_LT(d.motion, kMotionAgrees) << to_string(observer);
  }
  const Distance effect = distance(general, drift(without, Method::extrapolation, Observer::body, ModelForm::general));
  EXPECT_GT(effect.drift, 1e3 * drift_agrees);  // the effect is seen
}

TEST(DrivenTop, WithoutItsSpinMovesAsInBodyAxes) {
  for (const RatesRelativeTo X : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial})
    for (const Case& effect : cases()) {
      SCOPED_TRACE(effect.name + (X == RatesRelativeTo::inertial ? ", inertial rates" : ""));
      Scenario s = fast_earth_top();
      s.release.rates_relative_to = X;
      Scenario driven = s;
      effect.add(driven);
      expect_the_same(driven, s);
    }
}

TEST(DrivenTop, SeriesInBodyAndInertialAxesAgreeForAnyBody) {
  for (const Case& effect : cases()) {
    if (effect.name == "dry" || effect.name == "quadratic" || effect.name == "laminar" || effect.name == "turbulent" ||
        effect.name == "all")
      continue;  // friction with a corner has no series there
    SCOPED_TRACE(effect.name);
    Scenario s = fast_earth_top();
    testing::set_principal(s.body, 1.2e-4, 1.05e-4, 4e-5);
    s.effects.coriolis = effect.name != "viscous";  // a left-out torque has its series, too
    effect.add(s);
    const auto body = drift(s, Method::taylor, Observer::body, ModelForm::general);
    const auto inertial = drift(s, Method::taylor, Observer::inertial, ModelForm::general);
    const auto checked = drift(s, Method::extrapolation, Observer::laboratory, ModelForm::general);
    EXPECT_LT(distance(body, checked).drift, kDriftAgrees);
    EXPECT_LT(distance(inertial, checked).drift, kDriftAgrees);
    EXPECT_LT(distance(body, checked).motion, kMotionAgrees);
  }
}

// Without the Earth's rotation the two motions are the same to the last bit.
TEST(DrivenTop, WithoutTheEarthBothMotionsAreOne) {
  std::vector<Case> all = cases();
  all.push_back({"compass", [](Scenario& s) { s = testing::gyrocompass(40, 25, 1e-4); }});
  for (const Case& effect : all) {
    SCOPED_TRACE(effect.name);
    Scenario s = fast_earth_top();
    effect.add(s);
    s.rotation_rate_rad_s = 0;
    s.duration_s = 0.5, s.output_step_s = 0.1;
    for (const Observer observer : {Observer::laboratory, Observer::inertial}) {
      const auto motions = drift(s, Method::taylor, observer, ModelForm::reduced);
      ASSERT_EQ(motions.status, RunStatus::completed);
      for (const DriftSample<double>& sample : motions.samples) {
        EXPECT_EQ(sample.state.q_LB.w, sample.state.ref_q_LB.w);
        EXPECT_EQ(sample.state.q_LB.v, sample.state.ref_q_LB.v);
        EXPECT_EQ(sample.state.w_LB_B, sample.state.ref_w_LB_B);
        EXPECT_EQ(sample.measures.attitude, 0);
      }
    }
  }
}

TEST(Compass, WithOneAngleMovesAsAConstrainedBody) {
  Scenario plain = testing::gyrocompass(40, 25, 0);
  plain.rotation_rate_rad_s = 0.02;
  plain.release.spin_rad_s = 150;
  plain.duration_s = 2;
  plain.output_step_s = 0.25;
  for (const Case& effect : cases()) {
    if (effect.name == "platform" || effect.name == "ramp" || effect.name == "dry" || effect.name == "all") continue;
    if (effect.name == "support") continue;  // refused: in a gimbal it has no place
    SCOPED_TRACE(effect.name);
    Scenario s = plain;
    s.body.center_of_mass_m = {0, 0, 0.02};
    effect.add(s);
    if (s.travel) continue;  // a level gimbal is none for a journey
    s.effects.applied.gimbal->damping_N_m_s = 2e-4;
    expect_the_same(s, plain, kHeldDriftAgrees);
  }
}

// The growth of disturbances without the spin against that in body axes: a body whose moments differ in the tenth digit moves
// alike, and has no reduced form.
void expect_the_same_growth(const Scenario& s, const Scenario& general) {
  constexpr double kTolerance = 1e-9;
  for (const MotionKind kind : {MotionKind::reference, MotionKind::rotating}) {
    const GrowthReport a = disturbance_growth(Scene(s).problem<double>(), kind, 2, kTolerance);
    const GrowthReport b = disturbance_growth(Scene(general).problem<double>(), kind, 2, kTolerance);
    ASSERT_TRUE(a.completed && b.completed);
    EXPECT_NE(a.counters.evaluations, b.counters.evaluations);
    EXPECT_NEAR(a.mean_exponent_1_s, b.mean_exponent_1_s, testing::truncation(kTolerance, 40));
  }
}

TEST(DrivenTop, DisturbancesGrowAsInBodyAxes) {
  for (const Case& effect : cases()) {
    if (effect.name == "dry") continue;
    SCOPED_TRACE(effect.name);
    Scenario s = fast_earth_top(), general = s;
    effect.add(s);
    EXPECT_FALSE(Scene(s).method_refusal(Method::taylor));  // without friction's corner, the growth has its series
    general = s;
    testing::set_principal(general.body, 1.2e-4, 1.2e-4 * (1 + 1e-10), 4e-5);
    expect_the_same_growth(s, general);
  }
}

// The spin that drag brakes is that about the axis of symmetry, whichever body axis that is.
TEST(DrivenTop, DisturbancesOfATopThatLiesGrowAsInBodyAxes) {
  Scenario s = fast_earth_top();
  testing::set_principal(s.body, 4e-5, 1.2e-4, 1.2e-4);
  s.body.center_of_mass_m = {0.03, 0, 0};
  s.release.tilt_deg = 70;
  s.release.angular_velocity_body_rad_s = {200, 0, 0};
  s.effects.applied.quadratic_N_m_s2 = 1e-7;
  Scenario general = s;
  testing::set_principal(general.body, 4e-5, 1.2e-4, 1.2e-4 * (1 + 1e-10));
  expect_the_same_growth(s, general);
}

}  // namespace
}  // namespace earthtop::driven_top
