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
#include "support/travel_scenes.hpp"

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

/// A top on a journey in which the laboratory gathers speed.
Scenario aboard() {
  Scenario s = toy_top();
  s.duration_s = 1, s.output_step_s = 0.005;
  s.site.latitude_deg = 40;
  s.travel = testing::sailing(TravelPath::rhumb, 30, 10);
  s.travel->legs = {{1, 10.01, 0, 0}};
  return s;
}
Vec3<double> axis(const std::array<double, 3>& n) { return {n[0], n[1], n[2]}; }

constexpr double kTwoWays = 1e-9;       // two formulas at the release, where the states differ by no step
constexpr double kOfVariations = 1e-6;  // a thousand times the tolerance of the variations

/// The Coriolis force on the laboratory against runs in which the reference feels it, too; its acceleration against a run without it.
TEST(Budget, OfAJourneySizesItsPartsApart) {
  constexpr double kFirstOrder = 2e-3;   // what the square of a drift of 2e-4 rad, and of the lean of the plumb line, may add
  constexpr double kBetweenRows = 1e-3;  // the largest of a cosine between 200 rows, and of rates that nutate
  Scenario s = aboard();
  s.ledger = LedgerObserver::laboratory;
  const Budget budget = effect_budget(resolve(s));
  const RunResult rotating = run(s);
  const EffectEntry &eotvos = entry_of(budget, "eotvos"), &ballistic = entry_of(budget, "ballistic"),
                    &transport = entry_of(budget, "transport");

  Scenario other = s;
  other.travel->eotvos = TravelEotvos::both;
  const RunResult both = run(other);
  const auto drift = [](const DriftRow& row) { return Vec3<double>(axis(row.axis_L) - axis(row.ref_axis_L)); };
  const double of_eotvos = norm(Vec3<double>(drift(rotating.rows.back()) - drift(both.rows.back())));
  ASSERT_GT(of_eotvos, 0.5 * norm(drift(rotating.rows.back())));
  EXPECT_TRUE(eotvos.in_difference);
  EXPECT_NEAR(*eotvos.drift_final_rad, of_eotvos, kFirstOrder * of_eotvos);
  EXPECT_NEAR(budget.earth_drift_rad, rotating.drift.axis_final_rad, kOfVariations * budget.earth_drift_rad);
  EXPECT_FALSE(entry_of(effect_budget(resolve(other)), "eotvos").in_difference);

  other = s;
  other.travel->legs.clear();
  const RunResult steady = run(other);
  double of_speeding = 0;
  for (std::size_t i = 0; i < steady.rows.size(); ++i)
    of_speeding =
        std::max(of_speeding, norm(Vec3<double>(axis(rotating.rows[i].ref_axis_L) - axis(steady.rows[i].ref_axis_L))));
  const double of_way = *entry_of(effect_budget(resolve(other)), "ballistic").displacement_rad;
  ASSERT_GT(of_speeding, 100 * of_way);
  EXPECT_FALSE(ballistic.in_difference);
  EXPECT_NEAR(*ballistic.displacement_rad, of_speeding, 0.02 * of_speeding);  // of rows, and of the second order

  const EffectEntry& tide = entry_of(budget, "tide");
  EXPECT_FALSE(tide.torque_largest_N_m || tide.displacement_rad || tide.drift_rad) << "a tide is not carried along";

  EXPECT_FALSE(transport.displacement_rad || transport.drift_rad);
  double largest = 0;
  for (const auto& entry : rotating.ledger->entries) largest = std::max(largest, norm(axis(entry.tau_cor_transport_A)));
  const double first = norm(axis(rotating.ledger->entries[0].tau_cor_transport_A));
  EXPECT_NEAR(*transport.torque_release_N_m, first, kTwoWays * first);
  EXPECT_NEAR(*transport.torque_largest_N_m, largest, kBetweenRows * largest);
  // m r x 2 v x W, with W in East, North, Up
  const double phi = 40 * std::numbers::pi / 180, course = 30 * std::numbers::pi / 180, W = s.rotation_rate_rad_s;
  const Vec3<double> felt = 2 * Vec3<double>(10 * std::sin(course), 10 * std::cos(course), 0)
                                    .cross(Vec3<double>(0, W * std::cos(phi), W * std::sin(phi)));
  const Body<double> body = resolve(s).body<double>();
  const double torque = body.mass * norm(Vec3<double>((body.p_PBcm_B.norm() * axis(rotating.rows[0].axis_L)).cross(felt)));
  EXPECT_NEAR(*eotvos.torque_release_N_m, torque, kTwoWays * torque);
}

/// Against a laboratory that stays the budget has torques, and the drift of the journey.
TEST(Budget, AgainstALaboratoryAtRestHasTorquesAndTheDriftOfTheJourney) {
  Scenario s = aboard();
  s.travel->reference = TravelReference::at_rest;
  s.ledger = LedgerObserver::laboratory;
  const Budget budget = effect_budget(resolve(s));
  const RunResult result = run(s);
  EXPECT_NEAR(budget.earth_drift_rad, result.drift.axis_final_rad, kOfVariations * result.drift.axis_final_rad);
  const auto first = [&](const auto& torque) { return norm(axis(torque)); };
  const auto& entry = result.ledger->entries[0];
  const auto expect = [&](const char* name, double torque, bool in_difference) {
    const EffectEntry& made = entry_of(budget, name);
    EXPECT_NEAR(made.torque_release_N_m.value_or(0), torque, kTwoWays * torque) << name;
    EXPECT_GE(made.torque_largest_N_m.value_or(0), torque * (1 - kTwoWays)) << name;
    EXPECT_EQ(made.in_difference, in_difference) << name;
    EXPECT_FALSE(made.drift_rad) << name;
  };
  expect("coriolis", first(entry.tau_cor_A), false);
  expect("transport", first(entry.tau_cor_transport_A), true);
  expect("transverse", first(entry.tau_trans_A), true);
  expect("centrifugal", first(entry.tau_cent_A), false);
  EXPECT_GT(*entry_of(budget, "ballistic").torque_largest_N_m, 1e-5);  // 0.1 kg, 0.03 m, 0.02 m/s^2
  EXPECT_GT(*entry_of(budget, "eotvos").torque_release_N_m, 1e-6);
  EXPECT_NE(budget.inputs_unavailable.find("/report/sensitivities"), std::string::npos);
}

}  // namespace
}  // namespace earthtop
