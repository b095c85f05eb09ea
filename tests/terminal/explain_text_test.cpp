// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests of what `earthtop explain` tells of a top on a table: its numbers against closed forms and a run, and that nothing
/// is said of what a scene does not have.
#include "explain_text.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "earthtop/results/results.hpp"
#include "support/contact_references.hpp"
#include "support/contact_scenario.hpp"

namespace earthtop {
namespace {

constexpr std::size_t kWidth = 1000;  // columns: no sentence is broken

Scenario toy(ContactSpec contact) {
  contact.tip_radius_m = 0.002;
  Scenario s = testing::scenario_of(testing::toy_on_table(contact));
  s.duration_s = 2, s.output_step_s = 0.5;
  return s;
}
const ContactForceSize* size_of(const ContactExplanation& explained, std::string_view name) {
  for (const ContactForceSize& size : explained.forces)
    if (size.name == name) return &size;
  return nullptr;
}
bool says(const std::string& text, std::string_view words) { return text.find(words) != std::string::npos; }

TEST(ExplainContact, SizesAreThoseOfClosedForms) {
  Scenario s = toy({.law = ContactLaw::contensou, .friction_coefficient = 0.2, .patch_radius_m = 1e-4});
  s.contact->start = ContactStart::tip_velocity, s.contact->tip_velocity_m_s = {0.5, 0};
  const Scene scene(s);
  const ContactExplanation explained = explain_contact(scene);
  EXPECT_EQ(explained.followed_s, 2);
  EXPECT_TRUE(explained.ended_by.empty());
  ASSERT_EQ(explained.forces.size(), 5U);
  const double Omega = s.rotation_rate_rad_s, half = std::sqrt(0.5);
  EXPECT_NEAR(size_of(explained, "weight")->force_release_N, 0.1 * 9.80665, 1e-12);
  // Only the axis is spun: C moves with O, to the East, across the celestial axis.
  const ContactForceSize& coriolis = *size_of(explained, "coriolis");
  EXPECT_NEAR(coriolis.force_release_N / (2 * 0.1 * Omega * 0.5), 1, 1e-12);
  // The torque 2 w x (S W) with w = 200 n: S W has across n the part I3/2 W_across.
  const double n_E = std::sin(20 * std::numbers::pi / 180), n_Up = std::cos(20 * std::numbers::pi / 180);
  const double along = half * n_Up, across = std::sqrt(1 - along * along);
  EXPECT_NEAR(coriolis.torque_release_N_m / (4e-5 * 200 * Omega * across), 1, 1e-12) << n_E;
  const ContactForceSize &normal = *size_of(explained, "normal_force"), &friction = *size_of(explained, "friction");
  EXPECT_NEAR(normal.torque_release_N_m / (normal.force_release_N * 0.03 * n_E), 1, 1e-12);
  EXPECT_LT(friction.force_release_N / normal.force_release_N, 0.2);
  EXPECT_GT(*explained.largest_friction_ratio, 0.99 * friction.force_release_N / normal.force_release_N);
  EXPECT_GT(explained.slip_relaxation_1_s.value(), 100);
}

TEST(ExplainContact, DriftAndNeedsAreThoseOfARun) {
  const Scene scene(toy({.law = ContactLaw::contensou, .friction_coefficient = 0.2, .patch_radius_m = 1e-4}));
  const ContactExplanation explained = explain_contact(scene);
  const RunResult result = run(scene);
  EXPECT_NEAR(explained.drift_axis_rad / result.drift.axis_final_rad, 1, 1e-6);
  EXPECT_NEAR(explained.drift_tip_m / *result.drift.tip_final_m, 1, 1e-6);
  ASSERT_EQ(explained.inputs.size(), result.contact->changes.size());
  for (std::size_t i = 0; i < explained.inputs.size(); ++i) {
    const PredictionChange& change = result.contact->changes[i];
    EXPECT_EQ(explained.inputs[i].input, change.input);
    EXPECT_NEAR(explained.inputs[i].hides_axis.value() / (result.drift.axis_final_rad / change.axis_rad), 1, 1e-6);
    EXPECT_NEAR(explained.inputs[i].hides_tip.value() / (*result.drift.tip_final_m / change.tip_m), 1, 1e-6);
  }
  const std::string text = tool::contact_explanation_text(explained, scene, kWidth);
  EXPECT_TRUE(says(text, "nobody knows a coefficient of friction to 1 %")) << text;
  EXPECT_TRUE(says(text, "A small slip dies out at")) << text;
  EXPECT_FALSE(says(text, "left out")) << text;
  const auto document = nlohmann::json::parse(contact_explanation_json(explained, scene));
  EXPECT_EQ(document.at("forces").size(), 5U);
  EXPECT_EQ(document.at("inputs").at(0).at("name"), "friction_coefficient");
}

TEST(ExplainContact, WhatASceneDoesNotHaveIsNotSaid) {
  Scenario s = toy({.law = ContactLaw::frictionless});
  s.effects.coriolis = false;
  const ContactExplanation frictionless = explain_contact(Scene(s));
  const std::string smooth = tool::contact_explanation_text(frictionless, Scene(s), kWidth);
  EXPECT_EQ(size_of(frictionless, "friction"), nullptr);
  EXPECT_FALSE(says(smooth, "riction")) << smooth;
  EXPECT_FALSE(says(smooth, "slip dies out")) << smooth;
  EXPECT_TRUE(says(smooth, "left out")) << smooth;
  EXPECT_TRUE(says(smooth, "does not move the axis")) << smooth;

  ContactSpec contact{.law = ContactLaw::rolling, .start = ContactStart::rolling};
  s = toy(contact);
  s.effects.applied.gravity_gradient.emplace();
  const Scene rolling(s);
  const ContactExplanation rolls = explain_contact(rolling);
  const std::string text = tool::contact_explanation_text(rolls, rolling, kWidth);
  EXPECT_TRUE(says(text, "with less friction the tip would slip")) << text;
  EXPECT_FALSE(says(text, "slip dies out")) << text;
  EXPECT_FALSE(says(text, "coefficient")) << text;
  ASSERT_NE(size_of(rolls, "gravity_gradient"), nullptr);
  EXPECT_GT(size_of(rolls, "gravity_gradient")->force_largest_N, 0);
}

TEST(ExplainContact, TheEndOfTheMotionIsNamed) {
  ContactSpec contact{.law = ContactLaw::frictionless, .start = ContactStart::center_of_mass_at_rest};
  Scenario s = toy(contact);
  s.release.tilt_deg = 60, s.release.angular_velocity_body_rad_s = {-3, -15, 50};
  s.duration_s = 0.02, s.output_step_s = 0.001;
  const ContactExplanation explained = explain_contact(Scene(s));
  EXPECT_LT(explained.followed_s, 0.0071);
  EXPECT_TRUE(says(tool::contact_explanation_text(explained, Scene(s), kWidth), "the tip lifts off")) << explained.ended_by;
}

}  // namespace
}  // namespace earthtop
