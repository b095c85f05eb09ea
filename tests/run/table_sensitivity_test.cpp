// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the drift of tops on tables by tangents, against differences of runs with another value of each input.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "earthtop/scenario/inputs.hpp"
#include "run/difference_sensitivities.hpp"
#include "run/sensitivities.hpp"
#include "scene/sensitivity_route.hpp"
#include "support/effect_scenes.hpp"

namespace earthtop {
namespace {

/// A toy top on a table, for a quarter of a second.
Scenario on_table(const ContactSpec& contact) {
  Scenario s = testing::toy_top();
  s.contact = contact;
  s.duration_s = s.output_step_s = 0.25;
  s.sensitivities = true;
  return s;
}
Scenario asymmetric(Scenario s) {
  testing::set_principal(s.body, 1.2e-4, 1.19e-4, 4e-5);
  return s;
}
Scenario tilted(Scenario s) {
  s.contact->table_tilt_deg = 3, s.contact->table_tilt_azimuth_deg = 70;
  return s;
}

constexpr ContactSpec kRolling{.tip_radius_m = 0.002, .law = ContactLaw::rolling, .start = ContactStart::rolling};
constexpr ContactSpec kViscous{.tip_radius_m = 0.002, .law = ContactLaw::viscous, .sliding_viscosity_N_s_m = 0.05};
constexpr ContactSpec kByLoad{.tip_radius_m = 0.002, .law = ContactLaw::viscous_load, .sliding_viscosity_s_m = 0.05};
constexpr ContactSpec kPatch{
    .tip_radius_m = 0.002, .law = ContactLaw::contensou, .friction_coefficient = 0.2, .patch_radius_m = 3e-5};
constexpr ContactSpec kRegularised{
    .tip_radius_m = 0.002, .law = ContactLaw::coulomb, .friction_coefficient = 0.2, .regularisation_m_s = 0.01};
ContactSpec with_moments(ContactSpec contact) {
  contact.spinning_friction_m = 1e-4, contact.rolling_resistance_m = 2e-4, contact.regularisation_rad_s = 1;
  return contact;
}
ContactSpec starting(ContactStart start, ContactSpec contact) {
  contact.start = start;
  if (start == ContactStart::tip_velocity) contact.tip_velocity_m_s = {0.02, -0.01}, contact.tip_position_m = {0.1, 0.2};
  return contact;
}

/// Wants all derivatives of a run to be by tangents, tightly bounded, and those of differences.
void expect_those_of_differences(const Scenario& scenario, const char* name) {
  const RunResult result = run(scenario);
  ASSERT_TRUE(result.sensitivities) << name;
  const SensitivityReport& report = *result.sensitivities;
  ASSERT_EQ(report.unavailable, "") << name;
  ASSERT_EQ(report.at_s, scenario.duration_s) << name;
  ASSERT_EQ(report.inputs.size(), inputs_of(scenario).size()) << name;
  EXPECT_EQ(plan_sensitivities(result.modelled, report.at_s).route, SensitivityRoute::variations) << name;
  const DriftRow& row = result.rows.back();
  const auto differences =
      difference_sensitivities(result.modelled, report.at_s, {row.drift_axis_bound_rad, row.drift_attitude_bound_rad}, {});
  ASSERT_TRUE(differences) << name;
  for (std::size_t i = 0; i < report.inputs.size(); ++i) {
    const InputSensitivity &a = report.inputs[i], &b = (*differences)[i];
    const double within = a.axis_bound_rad + b.axis_bound_rad;
    const auto expect_near = [&](double tangent, double difference, const char* what) {
      EXPECT_NEAR(tangent, difference, within) << name << ": " << what << " by " << a.name;
      EXPECT_NE(tangent, 0) << name << ": " << what << " by " << a.name;
    };
    ASSERT_EQ(b.unavailable, "") << name << ": " << b.name;
    expect_near(a.axis_rad, b.axis_rad, "axis"), expect_near(a.attitude_rad, b.attitude_rad, "attitude");
    expect_near(a.tilt_rad, b.tilt_rad, "tilt"), expect_near(*a.azimuth_rad, *b.azimuth_rad, "azimuth");
    EXPECT_LE(a.axis_bound_rad, 1e-8 * std::abs(a.axis_rad)) << name << ": " << a.name;  // the worst is 5e-10
    EXPECT_LE(b.axis_bound_rad, 1e-3 * std::abs(b.axis_rad)) << name << ": " << b.name;  // else it could not judge the tangents
  }
}

TEST(TableSensitivity, OfASymmetricTopIsThatOfDifferencesByEveryInput) {
  expect_those_of_differences(on_table(kRolling), "rolling");
  expect_those_of_differences(tilted(on_table(with_moments(kRolling))), "rolling with moments, down a slope");
  expect_those_of_differences(on_table(starting(ContactStart::tip_velocity, kViscous)), "viscous, thrown");
  expect_those_of_differences(on_table(kByLoad), "viscous by load");
  expect_those_of_differences(tilted(on_table(with_moments(kPatch))), "patch with moments, down a slope");
  expect_those_of_differences(on_table(starting(ContactStart::center_of_mass_at_rest, kRegularised)), "regularised");
  Scenario busy = tilted(on_table(kViscous));
  busy.release.rates_relative_to = RatesRelativeTo::inertial;
  busy.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  TideSpec& tide = busy.effects.tide.emplace();
  tide.given = true, tide.amplitude_m_s2 = {1e-3, 2e-3, -1e-3}, tide.frequency_hz = 0.3;
  expect_those_of_differences(busy, "inertial rates, the gradient and a tide");
  Scenario steady = on_table(kRolling);
  steady.release.precession = Precession::steady_slow;
  expect_those_of_differences(steady, "steady precession");
}

TEST(TableSensitivity, OfAnAsymmetricTopIsThatOfDifferencesByEveryInput) {
  expect_those_of_differences(asymmetric(on_table(kRolling)), "rolling");
  expect_those_of_differences(asymmetric(tilted(on_table(kViscous))), "viscous, down a slope");
  expect_those_of_differences(asymmetric(on_table(with_moments(kPatch))), "patch with moments");
  expect_those_of_differences(asymmetric(on_table(starting(ContactStart::center_of_mass_at_rest, kRegularised))),
                              "regularised");
}

TEST(TableSensitivity, OfExactDryFrictionHasTangentsWhereTheTipDoesNotSlip) {
  ContactSpec dry = kRegularised;
  dry.regularisation_m_s = 0, dry.friction_coefficient = 0.35;  // rolling needs 0.26
  const auto route = [](const Scenario& s) { return plan_sensitivities(Scene(s), s.duration_s).route; };
  EXPECT_EQ(route(on_table(dry)), SensitivityRoute::differences);
  const Scenario sticks = on_table(starting(ContactStart::rolling, dry));
  EXPECT_EQ(route(sticks), SensitivityRoute::variations);
  // It rolls, and has the derivatives of one that rolls under the law of it; the coefficient has no part.
  const auto dry_inputs = run(sticks).sensitivities->inputs, rolling = run(on_table(kRolling)).sensitivities->inputs;
  ASSERT_EQ(dry_inputs.size(), rolling.size() + 1);
  for (std::size_t i = 0; i < rolling.size(); ++i) {
    EXPECT_EQ(dry_inputs[i].name, rolling[i].name);
    EXPECT_NEAR(dry_inputs[i].axis_rad, rolling[i].axis_rad, dry_inputs[i].axis_bound_rad + rolling[i].axis_bound_rad)
        << rolling[i].name;
  }
  EXPECT_EQ(dry_inputs.back().axis_rad, 0);
}

}  // namespace
}  // namespace earthtop
