// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the effect budget with runs with and without each effect, and tests which effects "auto" chooses.
#include "earthtop/budget/budget.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

#include "budget/effects.hpp"
#include "drift/derivatives/drift_differences.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/frames/earth_orientation.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "scene/input_derivatives.hpp"
#include "scene/sensitivity_route.hpp"
#include "support/contact_references.hpp"
#include "support/contact_scenario.hpp"
#include "support/effect_scenes.hpp"
#include "support/rotor_scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::toy_top;

const EffectEntry& entry_of(const Budget& budget, std::string_view name) {
  const auto found = std::find_if(budget.effects.begin(), budget.effects.end(), [&](const auto& e) { return e.name == name; });
  if (found == budget.effects.end()) throw std::runtime_error("the budget has no " + std::string(name));
  return *found;
}

/// Symmetric, asymmetric and hanging tops with one matching rule, each over a few hundred radians.
std::vector<Scenario> plain_scenes(RatesRelativeTo matching) {
  Scenario toy = toy_top(), asymmetric = testing::asymmetric_top(), hanging = toy_top();
  toy.duration_s = 3;
  asymmetric.duration_s = 3;
  hanging.name = "hanging";
  hanging.release.tilt_deg = 150;
  hanging.release.azimuth_deg = 10;
  hanging.release.spin_rad_s = 50;
  hanging.duration_s = 4;
  hanging.site.latitude_deg = -30;
  std::vector<Scenario> scenes{toy, asymmetric, hanging};
  for (Scenario& s : scenes) s.release.rates_relative_to = matching, s.output_step_s = 0.5;
  return scenes;
}

TEST(Budget, TheEarthsTorquesMakeTheDrift) {
  for (const auto matching : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial})
    for (const Scenario& s : plain_scenes(matching)) {
      SCOPED_TRACE(s.name);
      const double drift = run(s).drift.axis_final_rad;
      ASSERT_LT(drift, 1e-3);
      ASSERT_GT(drift, 1e-5);
      const Budget budget = effect_budget(s);
      EXPECT_NEAR(budget.earth_drift_rad, drift, testing::truncation(s.numerics.relative_tolerance) * drift);
      EXPECT_EQ(budget.followed_s, s.duration_s);
      const double coriolis = *entry_of(budget, "coriolis").drift_final_rad;
      const double centrifugal = *entry_of(budget, "centrifugal").drift_final_rad;
      EXPECT_GT(centrifugal, 0);
      EXPECT_LT(centrifugal, 1e-4 * coriolis);  // of second order
      if (matching == RatesRelativeTo::laboratory) {
        EXPECT_NEAR(coriolis, drift, 1e-3 * drift);
      } else {  // of two vectors only the lengths are known
        const double release = *entry_of(budget, "release_matching").drift_final_rad;
        EXPECT_LE(std::abs(coriolis - release), 1.001 * drift);
        EXPECT_GE(coriolis + release, 0.999 * drift);
      }
    }
}

TEST(Budget, AGimbalAnswersTheEarthsTorques) {
  Scenario s = testing::gyrocompass(30, 10, 1e-5);
  s.release.spin_rad_s = 60;
  s.duration_s = 1;
  s.output_step_s = 0.5;
  const double drift = run(s).drift.axis_final_rad;
  const Budget budget = effect_budget(s);
  EXPECT_NEAR(budget.earth_drift_rad, drift, testing::truncation(s.numerics.relative_tolerance, 10) * drift);
  EXPECT_NEAR(*entry_of(budget, "coriolis").drift_final_rad, drift, 1e-3 * drift);
}

/// The consequences of an effect: the largest distance of the reference's axis from its place without the effect, and the
/// change of the final drift.
struct Difference {
  double displacement_rad = 0, drift_final_rad = 0;
};
Difference difference(const Scenario& with, const Scenario& without) {
  IntegrationOptions options;
  options.observer = Observer::body, options.method = Method::dop853, options.relative_tolerance = 1e-14;
  const auto a = integrate_drift(Scene(with).problem<double>(), options),
             b = integrate_drift(Scene(without).problem<double>(), options);
  EXPECT_EQ(a.status, RunStatus::completed);
  EXPECT_EQ(b.status, RunStatus::completed);
  Difference d;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const auto axis = [i](const auto& run) { return Vec3<double>(rotation_matrix(run.samples[i].state.ref_q_LB).col(2)); };
    d.displacement_rad = std::max(d.displacement_rad, norm(Vec3<double>(axis(a) - axis(b))));
  }
  const auto drift = [](const auto& run) {
    const auto& last = run.samples.back();
    return Vec3<double>(last.state.epsilon * last.measures.axis_difference_L_scaled);
  };
  d.drift_final_rad = norm(Vec3<double>(drift(a) - drift(b)));
  return d;
}

void expect_sized(const EffectEntry& entry, const Difference& truth) {
  ASSERT_GT(truth.displacement_rad, 0);
  EXPECT_NEAR(entry.displacement_rad.value_or(0) / truth.displacement_rad, 1, 0.02) << entry.name;
  EXPECT_NEAR(entry.drift_final_rad.value_or(0) / truth.drift_final_rad, 1, 0.02) << entry.name;
}

TEST(Budget, WhatIsLeftOutIsSizedAsARunWithItShows) {
  for (Scenario s : plain_scenes(RatesRelativeTo::inertial)) {
    SCOPED_TRACE(s.name);
    s.output_step_s = 0.02;
    s.start_utc = "2026-11-22T12:00:00Z";
    const Budget budget = effect_budget(s);
    Scenario with = s;
    with.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
    expect_sized(entry_of(budget, "gravity_gradient"), difference(with, s));
    with = s;
    with.effects.tide.emplace();
    expect_sized(entry_of(budget, "tide"), difference(with, s));
    for (const auto name : {"gravity_gradient", "tide", "polar_motion"}) EXPECT_FALSE(entry_of(budget, name).modelled);
    with = s;
    with.site.pole = secular_pole(julian_epoch_year(*parse_utc(*s.start_utc)));
    const Difference pole = difference(with, s);
    EXPECT_LT(pole.displacement_rad, 1e-12);  // the reference knows of no pole
    EXPECT_NEAR(*entry_of(budget, "polar_motion").drift_final_rad / pole.drift_final_rad, 1,
                1e-6);  // of first order in the pole
  }
}

TEST(Budget, FrictionIsSizedAsARunWithoutItShows) {
  for (Scenario s : plain_scenes(RatesRelativeTo::laboratory)) {
    if (s.name == "asymmetric-top") continue;  // two will do
    SCOPED_TRACE(s.name);
    s.output_step_s = 0.02;
    AppliedTorquesSpec& applied = s.effects.applied;
    applied.viscous_N_m_s = 1e-9;
    applied.quadratic_N_m_s2 = 1e-11;
    applied.coulomb_N_m = 1e-8;
    applied.air_drag.emplace().disc_radius_m = 0.005;
    const Budget budget = effect_budget(s);
    const auto expect_that_of = [&](const char* name, const std::function<void(AppliedTorquesSpec&)>& leave_out) {
      Scenario without = s;
      leave_out(without.effects.applied);
      expect_sized(entry_of(budget, name), difference(s, without));
      EXPECT_TRUE(entry_of(budget, name).modelled);
    };
    expect_that_of("viscous_torque", [](auto& a) { a.viscous_N_m_s = 0; });
    expect_that_of("quadratic_torque", [](auto& a) { a.quadratic_N_m_s2 = 0; });
    expect_that_of("coulomb_torque", [](auto& a) { a.coulomb_N_m = 0; });
    expect_that_of("air_drag", [](auto& a) { a.air_drag.reset(); });
  }
}

TEST(Budget, ASymmetricTopsTakesLessTimeThanTheVariationalEquations) {
  const Scene toy(toy_top());  // a minute: some 15,000 rad
  const double variations = variations_seconds(toy, toy.scenario().duration_s, 1e-7, 19);
  EXPECT_LT(budget_seconds(toy), 1.5 * variations);  // which is less than a half of what the torques of the effects make of it
  EXPECT_GT(budget_seconds(toy), 10 * toy.costs()[0].seconds);
}

TEST(Selection, AccuracyDecidesWhatActs) {
  Scenario s = toy_top();
  s.duration_s = 3;
  s.output_step_s = 0.5;
  s.start_utc = "2026-11-22T12:00:00Z";
  Scenario all = s;
  all.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  all.effects.tide.emplace();
  all.site.pole = secular_pole(julian_epoch_year(*parse_utc(*s.start_utc)));
  const double everything = run(all).drift.axis_final_rad;
  s.effects.automatic = true;
  for (const double accuracy : {1e-3, 1e-9, 1e-12}) {
    s.accuracy_rad = accuracy;
    const RunResult result = run(s);
    ASSERT_TRUE(result.selection);
    ASSERT_TRUE(result.accuracy);
    EXPECT_TRUE(result.accuracy->reached()) << accuracy;
    const bool has_gradient = result.modelled.scenario().effects.applied.gravity_gradient.has_value();
    const auto& on = result.selection->switched_on;
    EXPECT_EQ(std::count(on.begin(), on.end(), "gravity_gradient"), has_gradient ? 1 : 0);
    EXPECT_FALSE(result.scene.scenario().effects.applied.gravity_gradient);  // as given
    if (accuracy != 1e-9) {
      EXPECT_EQ(has_gradient, accuracy == 1e-12) << accuracy;
    }
    EXPECT_NEAR(result.drift.axis_final_rad, everything, accuracy);
    Scene scene(s);
    const std::optional<Budget> budget = explain_effects(scene);  // of what the run models
    ASSERT_TRUE(budget);
    EXPECT_EQ(scene.scenario().effects, result.modelled.scenario().effects);
    EXPECT_EQ(entry_of(*budget, "gravity_gradient").modelled, has_gradient);
  }
  const std::atomic<bool> stop = true;
  Scene scene(s);
  EXPECT_FALSE(explain_effects(scene, Watch(&stop)));
}

// The rigid top that moves as the axis of a symmetric cage does has its torques, too: there the Coriolis torque on the rotor is one on the
// spin.
TEST(Budget, TorquesOnARotorAreThoseOnTheRigidTopThatMovesAsItDoes) {
  Scenario caged = testing::caged_gyroscope();
  caged.rotor->viscous_torque_N_m_s = 1e-6;
  Scenario general = caged;
  general.numerics.form = ModelForm::general;
  const Budget rigid = effect_budget(caged), budget = effect_budget(general);
  for (const char* effect : {"coriolis", "centrifugal"}) {
    const EffectEntry &torque = entry_of(budget, effect), &expected = entry_of(rigid, effect);
    EXPECT_NEAR(*torque.torque_release_N_m, *expected.torque_release_N_m, 1e-12 * *expected.torque_release_N_m);  // roundings
    // Both are largest at times looked at; in between they rise by no more.
    EXPECT_NEAR(*torque.torque_largest_N_m, *expected.torque_largest_N_m, 1e-3 * *expected.torque_largest_N_m);
    EXPECT_FALSE(torque.drift_rad);
  }
  EXPECT_EQ(*entry_of(budget, "rotor_bearing").torque_release_N_m, 1e-6 * 300);
  EXPECT_FALSE(entry_of(rigid, "rotor_bearing").torque_release_N_m);
  EXPECT_NEAR(budget.earth_drift_rad, rigid.earth_drift_rad,
              1e-5 * rigid.earth_drift_rad);  // the total of a budget is that exact
}

TEST(Budget, IsForAFixedPivot) {
  const Scene scene(testing::scenario_of(testing::toy_on_table({.law = ContactLaw::rolling})));
  for (const auto& budget : {+[](const Scene& s) { effect_budget(s); }, +[](const Scene& s) { budget_seconds(s); }}) try {
      budget(scene);
      FAIL();
    } catch (const ScenarioError& error) {
      EXPECT_EQ(error.diagnostics().front().pointer, "/contact");
      EXPECT_EQ(
          error.diagnostics().front().message,
          "effects are sized only for a top on a fixed pivot; to see what an effect does on a table, run the scenario with "
          "and without it");
    }
}

}  // namespace
}  // namespace earthtop
