// SPDX-License-Identifier: GPL-3.0-or-later
/// One motion integrated by itself is the rotating motion of a run.
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/integrate/motion_integration.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

TEST(Motion, IsTheRotatingMotionOfARun) {
  Scenario on_a_ship = testing::asymmetric_top();
  on_a_ship.platform = PlatformSpec{PlatformMotion::harmonic, {1, 1, 0.2}, 0, 0, 0.1, 0.7, 20, {0.1, -0.2, 0.3}};
  for (Scenario scene : {testing::toy_top(), testing::heavy_rotor_top(), testing::asymmetric_top(), on_a_ship})
    for (const RatesRelativeTo rule : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial}) {
      scene.duration_s = 2;
      scene.rotation_rate_rad_s = 0.5;
      scene.release.rates_relative_to = rule;
      const RunResult result = run(scene);
      const auto problem = Scene(scene).problem<double>();
      for (const testing::Equations& equations : testing::kEquations) {
        SCOPED_TRACE(equations);
        IntegrationOptions options;
        options.observer = equations.observer;
        options.form = equations.form;
        options.method = Method::rkf78;
        options.relative_tolerance = 1e-14;
        const auto motion = integrate_motion(problem, options);
        ASSERT_EQ(motion.status, RunStatus::completed);
        ASSERT_EQ(motion.samples.size(), result.rows.size());
        const double slack = 1e-11;  // 400 rad of spin, 5e-14 of rounding and method each; the Earth turns the top by 1 rad
        for (std::size_t i = 0; i < result.rows.size(); ++i) {
          const DriftRow& row = result.rows[i];
          const MotionSample<double>& sample = motion.samples[i];
          const Quaternion<double> q = sample.q_LB.normalized();
          ASSERT_EQ(sample.t_s, row.t_s);
          for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(q.v[k], row.q_LB[static_cast<std::size_t>(k + 1)], slack) << i;
            ASSERT_NEAR(sample.w_LB_B[k], row.w_LB_B[static_cast<std::size_t>(k)], 200 * slack) << i;
          }
          ASSERT_NEAR(q.w, row.q_LB[0], slack);
        }
      }
    }
}

TEST(Motion, TheAxisAloneTakesFewerVariablesAndIsTheSame) {
  Scenario scene = testing::toy_top();
  scene.duration_s = 5;
  const auto problem = Scene(scene).problem<double>();
  for (const Observer observer : {Observer::laboratory, Observer::inertial}) {
    IntegrationOptions options;
    options.observer = observer;
    options.form = ModelForm::reduced;
    options.method = Method::rkf78;
    const auto whole = integrate_motion(problem, options),
               axis = integrate_motion(problem, options, MotionSought::symmetry_axis);
    EXPECT_LT(axis.counters.evaluations, 1.01 * static_cast<double>(whole.counters.evaluations));
    for (std::size_t i = 0; i < whole.samples.size(); ++i) {
      const Vec3<double> n = rotation_matrix(whole.samples[i].q_LB).col(2), m = rotation_matrix(axis.samples[i].q_LB).col(2);
      ASSERT_LT(norm(Vec3<double>(n - m)), testing::rounding(100));
    }
  }
}

}  // namespace
}  // namespace earthtop
