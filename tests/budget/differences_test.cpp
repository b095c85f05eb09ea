// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the differences of whole integrations, of which a symmetric top's budget is made, with the variational equations.
#include <gtest/gtest.h>

#include "budget/effects.hpp"
#include "drift/derivatives/drift_differences.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"
#include "scene/input_derivatives.hpp"
#include "support/effect_scenes.hpp"

namespace earthtop {
namespace {

using testing::toy_top;

/// A method that differences of whole integrations may use, with a scene for it.
struct DifferenceCase {
  Scenario scenario;
  Method alone;
};
std::vector<DifferenceCase> difference_cases() {
  Scenario toy = toy_top(), driven = toy_top(), fast = toy_top();
  toy.duration_s = 2;
  toy.release.rates_relative_to = RatesRelativeTo::inertial;
  driven.name = "driven";
  driven.duration_s = 2;
  driven.start_utc = "2026-11-22T12:00:00Z";
  driven.effects.applied.viscous_N_m_s = 1e-9;
  driven.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  driven.effects.tide.emplace();
  fast.name = "fast";
  fast.body.center_of_mass_m = {0, 0, 0.002};
  testing::set_principal(fast.body, 4e-5, 4e-5, 5e-5);
  fast.release.tilt_deg = 60;
  fast.release.spin_rad_s = 300;
  fast.duration_s = 6;
  return {{toy, Method::taylor}, {driven, Method::taylor}, {fast, Method::long_horizon}};
}

TEST(Differences, AgreeWithTheVariationalEquations) {
  for (const DifferenceCase& c : difference_cases()) {
    SCOPED_TRACE(c.scenario.name);
    const Scene scene(c.scenario);
    std::vector<ProblemDerivative> inputs = input_derivatives(scene).by_scaled_input;
    for (const Candidate& candidate : effect_candidates(scene)) inputs.push_back(candidate.input);
    DifferenceMethods methods;
    methods.alone.method = c.alone;
    methods.driven.method = Method::taylor;
    ASSERT_TRUE(has_drift_differences(scene.problem<double>()));
    const auto differences = drift_differences(scene.problem<double>(), inputs, c.scenario.duration_s, methods, {}, nullptr);
    ASSERT_TRUE(differences);
    const DriftSensitivity exact =
        drift_sensitivity(scene.problem<double>(), inputs, c.scenario.duration_s, 1e-9, {}, SensitivitySought::responses);
    EXPECT_NEAR(differences->axis.value, exact.axis.value, 1e-7 * exact.axis.value);
    ASSERT_EQ(differences->responses.size(), inputs.size());
    // Differences are good to some 1e-4. The largest values are seen at other times, up to half a nutation apart, in which a
    // response grows by 1.4e-3 of itself here; rows and steps miss another 1e-3 each.
    constexpr double kShare = 4e-3;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      SCOPED_TRACE(i);
      const Responses &a = differences->responses[i], &b = exact.responses[i];
      const double moved = kShare * b.displacement_largest + 1e-9, drifted = kShare * b.drift_largest + 1e-12;
      EXPECT_NEAR(a.displacement_final, b.displacement_final, moved);
      EXPECT_NEAR(a.displacement_largest, b.displacement_largest, moved);
      EXPECT_NEAR(a.drift_final, b.drift_final, drifted);
      // The largest drift by the scene's own inputs is in no budget: it may lie between two rows within a nutation.
      if (i >= inputs_of(c.scenario).size()) {
        EXPECT_NEAR(a.drift_largest, b.drift_largest, drifted);
      }
    }
  }
}

TEST(Differences, AreOfSymmetricTopsOnAPivotAtRest) {
  const auto exist = [](const Scenario& s) { return has_drift_differences(Scene(s).problem<double>()); };
  EXPECT_TRUE(exist(toy_top()));
  EXPECT_FALSE(exist(testing::asymmetric_top()));
  EXPECT_FALSE(exist(testing::gyrocompass(30, 10, 1e-5)));
  EXPECT_FALSE(exist(testing::non_rotating(toy_top())));
  Scenario s = toy_top();
  s.effects.coriolis = false;
  EXPECT_FALSE(exist(s));
  s = toy_top();
  PlatformSpec& platform = s.platform.emplace();
  platform.motion = PlatformMotion::ramp, platform.axis = {0, 0, 1}, platform.rate_rad_s = 0.1;
  EXPECT_FALSE(exist(s));
}

}  // namespace
}  // namespace earthtop
