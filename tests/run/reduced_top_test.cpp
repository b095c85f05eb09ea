// SPDX-License-Identifier: GPL-3.0-or-later
/// The reduced model (a symmetric top without its spin): when it is used, and that it agrees with the general model.
#include "earthtop/model/reduced_top.hpp"

#include <filesystem>

#include "support/scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::toy_top;
using Q = float128;

ModelForm form_taken(Scenario scene) {
  scene.duration_s = 0.01;
  scene.output_step_s = 0.01;
  return run(scene).solution.form;
}

TEST(ReducedTop, IsFoundOutFromBodyAndEffects) {
  EXPECT_EQ(form_taken(toy_top()), ModelForm::reduced);
  Scenario s = toy_top();
  s.body.center_of_mass_m = {0, 0, -0.03};
  EXPECT_EQ(form_taken(s), ModelForm::reduced);
  s.body.center_of_mass_m = {0, 0, 0};
  EXPECT_EQ(form_taken(s), ModelForm::reduced);
  s = toy_top();
  s.body.inertia_kg_m2[1][1] = std::nextafter(1.2e-4, 1);  // equal means equal
  EXPECT_EQ(form_taken(s), ModelForm::general);
  s = toy_top();
  s.body.center_of_mass_m[0] = 1e-300;
  EXPECT_EQ(form_taken(s), ModelForm::general);
  s = toy_top();
  s.body.inertia_kg_m2[0][1] = s.body.inertia_kg_m2[1][0] = 1e-20;
  EXPECT_EQ(form_taken(s), ModelForm::general);
  s = toy_top();
  s.effects.centrifugal = false;
  EXPECT_EQ(form_taken(s), ModelForm::general);
  s = toy_top();
  s.effects.applied.viscous_N_m_s = 1e-8;
  EXPECT_EQ(form_taken(s), ModelForm::reduced);
  s.numerics.method = Method::rkf78;  // only the series have the reduced form of a scene that is not plain
  EXPECT_EQ(form_taken(s), ModelForm::general);
  s = toy_top();
  s.platform = PlatformSpec{};
  EXPECT_EQ(form_taken(s), ModelForm::reduced);
  s.effects.applied.gimbal = GimbalSpec{};  // a gimbal on a platform
  EXPECT_EQ(form_taken(s), ModelForm::general);
  s = toy_top();
  s.numerics.form = ModelForm::general;
  EXPECT_EQ(form_taken(s), ModelForm::general);
  for (const Observer observer : {Observer::body, Observer::inertial}) {  // each integrates its own state
    s = toy_top();
    s.numerics.observer = observer;
    EXPECT_EQ(form_taken(s), ModelForm::general);
  }
  EXPECT_EQ(form_taken(testing::asymmetric_top()), ModelForm::general);
}

/// The toy top with its symmetry axis moved from body axis 3 to another one, and with it everything given in body axes.
Scenario with_axis(int axis) {
  Scenario s = toy_top();
  s.duration_s = 3;
  s.output_step_s = 0.03;
  const Quaternion<double> q = release_attitude<double>(20, 90, 15);
  s.release.quaternion_LB = {q.w, q.v[0], q.v[1], q.v[2]};
  const auto at = static_cast<std::size_t>(axis);
  std::array<double, 3> I{1.2e-4, 1.2e-4, 1.2e-4}, rate{3, 3, 3}, center{};
  I[at] = 4e-5, rate[at] = 200, center[at] = 0.03;
  testing::set_principal(s.body, I[0], I[1], I[2]);
  s.body.center_of_mass_m = center;
  s.release.angular_velocity_body_rad_s = rate;
  return s;
}

// Attitudes, rates and drifts of the two models agree within their bounds, on every shipped scenario of a symmetric top and on
// tops with another symmetry axis. The reduced model's bounds are not wider.
TEST(ReducedTop, AgreesWithTheGeneralModel) {
  std::vector<Scenario> scenes{with_axis(0), with_axis(1), with_axis(2)};
  for (const auto& file : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS)) {
    if (file.path().extension() != ".json") continue;
    Scenario s = testing::shipped(file.path().stem());
    s.duration_s = std::min(s.duration_s, 10.0);
    s.output_step_s = std::min(s.output_step_s, s.duration_s);
    if (s.platform || s.contact || s.gimbals || symmetry_axis(make_body<double>(s.body)) < 0) continue;
    scenes.push_back(s);
  }
  EXPECT_GE(scenes.size(), 16U);
  for (Scenario& scene : scenes) {
    SCOPED_TRACE(scene.name);
    scene.numerics.method = Method::taylor;  // and not a closed form
    const RunResult reduced = run(scene);
    ASSERT_EQ(reduced.solution.form, ModelForm::reduced);
    EXPECT_TRUE(reduced.certificate.form == ModelForm::reduced || reduced.certificate.method == Method::fourier);
    scene.numerics.observer = Observer::body;
    const RunResult general = run(scene);
    ASSERT_EQ(general.solution.form, ModelForm::general);
    ASSERT_EQ(reduced.rows.size(), general.rows.size());
    // Wide bounds would agree with anything; where the motion itself is unstable the general model's are wide too.
    const double narrow = std::max(1e-14, 1e-7 * reduced.drift.axis_max_rad);
    EXPECT_LE(reduced.drift.axis_bound_rad, std::max(narrow, 3 * general.drift.axis_bound_rad));
    double fastest = 0;
    for (const DriftRow& row : reduced.rows)
      for (const double rate : row.w_LB_B) fastest = std::max(fastest, std::abs(rate));
    for (std::size_t i = 0; i < reduced.rows.size(); ++i) {
      const DriftRow &x = reduced.rows[i], &y = general.rows[i];
      ASSERT_LE(std::abs(x.drift_axis_rad - y.drift_axis_rad), x.drift_axis_bound_rad + y.drift_axis_bound_rad) << i;
      ASSERT_LE(std::abs(x.drift_attitude_rad - y.drift_attitude_rad), x.drift_attitude_bound_rad + y.drift_attitude_bound_rad);
      ASSERT_NEAR(x.drift_spin_rad, y.drift_spin_rad, 1e-9 + x.drift_attitude_bound_rad + y.drift_attitude_bound_rad);
      ASSERT_NEAR(x.drift_tilt_rad, y.drift_tilt_rad,
                  x.drift_axis_bound_rad + y.drift_axis_bound_rad + 1e-8 * std::abs(y.drift_tilt_rad));
      const double attitude_slack = reduced.attitude_bound_rad + general.attitude_bound_rad + 4e-16;
      for (std::size_t k = 0; k < 4; ++k) {  // the sign of the quaternion too: both are continuous
        ASSERT_NEAR(x.q_LB[k], y.q_LB[k], attitude_slack);
        ASSERT_NEAR(x.ref_q_LB[k], y.ref_q_LB[k], attitude_slack);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(x.w_LB_B[k], y.w_LB_B[k], 10 * fastest * attitude_slack);
        ASSERT_NEAR(x.ref_w_LB_B[k], y.ref_w_LB_B[k], 10 * fastest * attitude_slack);
      }
    }
  }
}

// In 113 bits the two models differ only by the error of the method.
TEST(ReducedTop, AgreesWithTheGeneralModelTo113Bits) {
  constexpr double kTolerance = 1e-25;
  for (const int axis : {0, 2})
    for (const RatesRelativeTo rule : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial}) {
      Scenario s = with_axis(axis);
      s.rotation_rate_rad_s = 0.1;
      s.release.rates_relative_to = rule;
      s.duration_s = s.output_step_s = 0.02;
      const auto problem = Scene(s).problem<Q>();
      std::vector<DriftSample<Q>> ends;
      for (const auto& [observer, form] :
           {std::pair(Observer::laboratory, ModelForm::reduced), std::pair(Observer::inertial, ModelForm::reduced),
            std::pair(Observer::body, ModelForm::general)}) {
        IntegrationOptions options;
        options.observer = observer;
        options.form = form;
        options.method = Method::rkf78;
        options.relative_tolerance = kTolerance;
        ends.push_back(integrate_drift(problem, options).samples.back());
      }
      const auto& exact = ends.back();
      for (const auto& end : {ends[0], ends[1]}) {
        const Quaternion<Q> p = end.state.q_LB.normalized(), q = exact.state.q_LB.normalized();
        EXPECT_LT(static_cast<double>(norm((p.conjugate() * q).v)), testing::truncation(kTolerance));
        EXPECT_LT(static_cast<double>(norm(Vec3<Q>(end.state.w_LB_B - exact.state.w_LB_B))),
                  testing::truncation(kTolerance, 200));
        const auto relative = [](Q x, Q y) { return static_cast<double>(real::abs(Q(x / y - 1))); };
        EXPECT_LT(relative(end.measures.axis, exact.measures.axis), testing::truncation(kTolerance, 50));
        EXPECT_LT(relative(end.measures.attitude, exact.measures.attitude), testing::truncation(kTolerance, 5));
        EXPECT_LT(relative(end.spin, exact.spin), testing::truncation(kTolerance, 50));
      }
    }
}

// The cost does not depend on the spin: the same wobble under a thousand times faster spin takes the same number of steps.
TEST(ReducedTop, CostDoesNotKnowTheSpin) {
  const auto evaluations = [](double I3, double spin) {
    Scenario s = toy_top();
    testing::set_principal(s.body, 1.2e-4, 1.2e-4, I3);
    s.release.spin_rad_s = spin;
    s.duration_s = 5;
    return static_cast<double>(run(s).solution.counters.evaluations);
  };
  const double slow = evaluations(4e-5, 200), fast = evaluations(4e-8, 200'000);  // the same I3 w3
  EXPECT_NEAR(fast, slow, 0.1 * slow);
}

// The estimate of the cost takes the form into account: it is right within a factor of four, and a fast spin is not refused.
TEST(ReducedTop, TheEstimateOfStepsDoesNotKnowTheSpinEither) {
  Scenario s = toy_top();
  testing::set_principal(s.body, 1.2e-4, 1.2e-4, 4e-8);
  s.release.spin_rad_s = 200'000;
  s.duration_s = 5;
  const double taken = static_cast<double>(run(s).solution.counters.accepted);
  EXPECT_LT(Scene(s).estimate().solution.steps, 4 * taken);
  EXPECT_GT(Scene(s).estimate().solution.steps, taken / 4);
  s.numerics.form = ModelForm::general;
  EXPECT_GT(Scene(s).estimate().solution.steps, 100 * taken);
}

// The quaternion of the turn after up to 1e10 rad is as exact as rate and time.
TEST(SteadyTurn, LosesNothingToManyTurns) {
  testing::Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const double rate = random.log_uniform(1e-3, 1e6) * random.sign(), t = random.log_uniform(1e-3, 1e4);
    const Quaternion<double> q = steady_turn(i % 3, rate, t);
    const Q half = Q(rate) * Q(t) / 2;
    EXPECT_NEAR(q.w, static_cast<double>(real::cos(half)), 4e-16);
    EXPECT_NEAR(q.v[i % 3], static_cast<double>(real::sin(half)), 4e-16);
  }
}

TEST(QuaternionOf, IsTheInverseOfTheRotationMatrix) {
  testing::Random random(8);
  for (int i = 0; i < 1000; ++i) {
    Quaternion<double> q{random.uniform(-1, 1), {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}};
    if (i % 4 == 0) q.w *= 1e-9;  // half a turn, about an axis that may be a coordinate axis
    if (i % 5 == 0) q.v[i % 3] *= 1e-12;
    q = q.normalized();
    Quaternion<double> p = quaternion_of(rotation_matrix(q));
    if (p.w * q.w + p.v.dot(q.v) < 0) p = {-p.w, -p.v};
    EXPECT_NEAR(p.w, q.w, 1e-15);
    EXPECT_LT(norm(Vec3<double>(p.v - q.v)), 2e-15);
  }
}

}  // namespace
}  // namespace earthtop
