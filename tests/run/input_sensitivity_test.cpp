// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the drift by the numbers of effects, platforms, gimbals and contacts, by either route, compared with differences
// of runs in 113 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "earthtop/drift/drift_integration.hpp"
#include "run/difference_sensitivities.hpp"
#include "run/sensitivities.hpp"
#include "scene/moved_input.hpp"
#include "scene/sensitivity_route.hpp"
#include "support/effect_scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

/// The axis drift at the end, in 113 bits.
float128 exact_axis_drift(Scenario scenario) {
  scenario.precision = Precision::bits113;
  scenario.numerics = {};
  scenario.numerics.relative_tolerance = 1e-18;
  const Scene scene(scenario);
  auto problem = scene.problem<float128>();
  problem.times_s = {0, scenario.duration_s};
  return integrate_drift(problem, scene.choice().options).samples.back().measures.axis;
}

/// The axis drift's derivative by a number of the scenario; the truncation error is 1e-11 of it and less.
double exact_derivative(const Scenario& scenario, std::size_t input) {
  Scenario high = scenario, low = scenario;
  double &up = *kInputs[input].number(high), &down = *kInputs[input].number(low);
  const double step = 0x1p-22 * std::max(1e-3, std::abs(up));
  up += step, down -= step;
  return static_cast<double>((exact_axis_drift(high) - exact_axis_drift(low)) / float128(up - down));
}

std::size_t place_of(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kInputNames, name) - kInputNames.begin());
}

/// Compares some of a report's derivatives with those in 113 bits.
/// @param relative  error allowed of a derivative, and of the stated bound on it
void expect_exact(const Scenario& scenario, const std::vector<InputSensitivity>& inputs, const std::vector<std::string>& names,
                  double relative) {
  for (const std::string& name : names) {
    const auto entry = std::ranges::find(inputs, name, &InputSensitivity::name);
    ASSERT_NE(entry, inputs.end()) << name;
    EXPECT_EQ(entry->unavailable, "") << name;
    const double exact = exact_derivative(scenario, place_of(name)), error = std::abs(entry->axis_rad - exact);
    EXPECT_NE(exact, 0) << name;
    // Central differences in 113 bits are good to 1e-11.
    EXPECT_LE(error, entry->axis_bound_rad + 1e-10 * std::abs(exact)) << name << ": " << entry->axis_rad;
    EXPECT_LE(entry->axis_bound_rad, relative * std::abs(exact)) << name;
  }
}

std::vector<InputSensitivity> by_run(Scenario scenario) {
  scenario.sensitivities = true;
  const auto report = run(scenario).sensitivities;
  EXPECT_EQ(report->unavailable, "");
  EXPECT_EQ(report->at_s, scenario.duration_s);
  EXPECT_EQ(report->inputs.size(), inputs_of(scenario).size());
  return report->inputs;
}

TEST(InputSensitivity, OfFrictionAirAndAHarmonicPlatform) {
  Scenario s = testing::busy_scene();
  s.duration_s = s.output_step_s = 0.1;
  expect_exact(s, by_run(s),
               {"spin_rad_s", "viscous_torque_N_m_s", "quadratic_torque_N_m_s2", "disc_radius_m", "platform_amplitude_rad",
                "platform_frequency_hz", "platform_phase_deg"},
               1e-6);
}

TEST(InputSensitivity, OfARampAndOfTheLatitudeInTheWholeGradient) {
  Scenario s = testing::toy_top();
  s.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  PlatformSpec& platform = s.platform.emplace();
  platform.motion = PlatformMotion::ramp, platform.axis = {0.2, 0.1, 1};
  platform.rate_rad_s = 1.5, platform.acceleration_rad_s2 = -2, platform.pivot_offset_m = {0.1, -0.2, 0.05};
  s.duration_s = s.output_step_s = 0.1;
  const auto inputs = by_run(s);
  expect_exact(s, inputs, {"latitude_deg", "platform_rate_rad_s", "platform_acceleration_rad_s2"}, 1e-6);
  // The length of the offset; a step of 2^-22 of it is good to 1e-9.
  Scenario longer = s, shorter = s;
  for (std::size_t i = 0; i < 3; ++i)
    longer.platform->pivot_offset_m[i] *= 1 + 0x1p-22, shorter.platform->pivot_offset_m[i] *= 1 - 0x1p-22;
  const double moved = 0x1p-21 * std::sqrt(0.1 * 0.1 + 0.2 * 0.2 + 0.05 * 0.05);
  const auto exact = static_cast<double>((exact_axis_drift(longer) - exact_axis_drift(shorter)) / float128(moved));
  const auto offset = std::ranges::find(inputs, "pivot_offset_m", &InputSensitivity::name);
  EXPECT_NEAR(offset->axis_rad, exact, 1e-8 * std::abs(exact));
}

TEST(InputSensitivity, OfAGimbalWhichHasNoTilt) {
  Scenario s = testing::held_rotor();
  s.duration_s = s.output_step_s = 0.1;
  const auto inputs = by_run(s);
  expect_exact(s, inputs, {"spin_rad_s", "viscous_torque_N_m_s", "gimbal_damping_N_m_s"}, 1e-6);
  EXPECT_EQ(std::ranges::find(inputs, "tilt_deg", &InputSensitivity::name), inputs.end());
}

TEST(InputSensitivity, OfDryFrictionInTheMotionAndAtRest) {
  Scenario s = testing::toy_top();
  s.body.center_of_mass_m = {0, 0, 0.002};
  s.effects.applied.coulomb_N_m = 5e-3;  // stops the top, and holds it: m g l is 2e-3 N m
  s.duration_s = s.output_step_s = 0.1;
  EXPECT_EQ(plan_sensitivities(Scene(s), s.duration_s).route, SensitivityRoute::differences);
  expect_exact(s, by_run(s), {"spin_rad_s", "coulomb_torque_N_m"}, 1e-2);
  s.duration_s = s.output_step_s = 2.5;
  Scenario asked = s;
  asked.sensitivities = true;
  const RunResult result = run(asked);
  ASSERT_EQ(result.stops.size(), 2U);
  EXPECT_EQ(result.sensitivities->at_s, 2.5);
  expect_exact(s, result.sensitivities->inputs, {"coulomb_torque_N_m"}, 1e-3);
}

TEST(InputSensitivity, OfATopOnATable) {
  Scenario s = testing::toy_top();
  ContactSpec& contact = s.contact.emplace();
  contact.tip_radius_m = 0.002, contact.law = ContactLaw::viscous, contact.sliding_viscosity_N_s_m = 0.05;
  s.duration_s = s.output_step_s = 0.1;
  expect_exact(s, by_run(s), {"tip_radius_m", "sliding_viscosity_N_s_m"}, 1e-9);
}

// Both routes exist for a toy top; its drift depends little on the fast nutation.
TEST(InputSensitivity, BothRoutesAgreeWithinTheirBounds) {
  Scenario s = testing::toy_top();
  s.duration_s = s.output_step_s = 3;
  s.sensitivities = true;
  const RunResult result = run(s);
  const auto differences = difference_sensitivities(
      result.modelled, 3, {result.rows.back().drift_axis_bound_rad, result.rows.back().drift_attitude_bound_rad}, {});
  ASSERT_TRUE(differences);
  for (std::size_t i = 0; i < kCommonInputs; ++i) {
    const InputSensitivity &a = result.sensitivities->inputs[i], &b = (*differences)[i];
    EXPECT_LE(std::abs(a.axis_rad - b.axis_rad), a.axis_bound_rad + b.axis_bound_rad) << a.name;
    EXPECT_LE(b.axis_bound_rad, 1e-4 * std::abs(a.axis_rad)) << a.name;
    EXPECT_NEAR(b.attitude_rad, a.attitude_rad,
                testing::truncation(s.numerics.relative_tolerance, 100) * std::abs(a.attitude_rad))
        << a.name;
    EXPECT_NEAR(*b.azimuth_rad, *a.azimuth_rad,
                testing::truncation(s.numerics.relative_tolerance, 1000) * std::abs(*a.azimuth_rad))
        << a.name;
  }
}

// A fast gyroscope's hour, 5e6 rad: by the closed form of its mean motion the azimuth drifts by -Omega sin(latitude) t, so that
// the derivative of the axis drift by the Earth's rate is that drift over the rate, to a share Omega / Omega_p.
TEST(InputSensitivity, OfAFastGyroscopesHour) {
  Scenario s = testing::toy_top();
  s.body.mass_kg = 0.5, s.body.center_of_mass_m = {0, 0, 0.005};
  testing::set_principal(s.body, 4e-4, 4e-4, 5e-4);
  s.release.tilt_deg = 60, s.release.spin_rad_s = 1047.2;
  s.duration_s = s.output_step_s = 3600;
  s.sensitivities = true;
  const RunResult result = run(s);
  ASSERT_EQ(result.sensitivities->unavailable, "");
  const InputSensitivity& rate = result.sensitivities->inputs[4];
  const double in_proportion = result.rows.back().drift_axis_rad / s.rotation_rate_rad_s;
  EXPECT_NEAR(rate.axis_rad, in_proportion, 5e-3 * in_proportion);
  EXPECT_LT(rate.axis_bound_rad, 5e-3 * in_proportion);
}

TEST(InputSensitivity, StandardErrorsAreThoseOfTheScenesOwnNumbers) {
  const auto examined = [](const std::string& rest) {
    return examine_scenario(
        {"scene.json",
         R"({"site": {"latitude_deg": 45}, "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia":
             {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}}, "release": {"tilt_deg": 20, "spin_rad_s": 200},
             "motion": {"duration_s": 0.1, "output_step_s": 0.1}, "uncertainty": {"viscous_torque_N_m_s": 1e-8})" +
             rest + "}"});
  };
  const ScenarioReport without = examined("");
  ASSERT_EQ(without.error_count, 1U);
  EXPECT_EQ(without.errors[0].pointer, "/uncertainty/viscous_torque_N_m_s");
  const ScenarioReport with = examined(R"(, "effects": {"viscous_torque_N_m_s": 1e-6})");
  ASSERT_TRUE(with.scenario) << with.errors[0].message;
  const std::string canonical = canonical_json(*with.scenario);
  EXPECT_EQ(parse_scenario({"scene.json", canonical}), *with.scenario);
  const SensitivityReport report = *run(*with.scenario).sensitivities;
  const auto viscous = std::ranges::find(report.inputs, "viscous_torque_N_m_s", &InputSensitivity::name);
  ASSERT_NE(viscous, report.inputs.end());
  EXPECT_DOUBLE_EQ(report.axis_error_rad, 1e-8 * std::abs(viscous->axis_rad));
}

}  // namespace
}  // namespace earthtop
