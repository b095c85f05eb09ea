// SPDX-License-Identifier: GPL-3.0-or-later
// These tests check that the support of a scene is the one that its scenario asks for, what is said where something is not available on
// it, and that contact and start of a table are made once.
#include "earthtop/scenario/support.hpp"

#include <gtest/gtest.h>

#include "scene/touchdown.hpp"
#include "support/changed_scene.hpp"
#include "support/contact_runs.hpp"
#include "support/scenes.hpp"

namespace earthtop {
namespace {

using testing::changed;

void ask_for_table(Scenario& s) {
  s.contact = ContactSpec{.tip_radius_m = 0.002, .law = ContactLaw::rolling, .start = ContactStart::rolling};
}
void ask_for_gimbals(Scenario& s) {
  BodySpec& ring = s.gimbals.emplace().ring.emplace();
  ring.mass_kg = 0.1;
  testing::set_principal(ring, 1e-4, 1e-4, 1e-4);
  s.release.gimbals = GimbalReleaseSpec{20, 60, 0, 0};
}
void ask_for_masses(Scenario& s) {
  MovingMassSpec& mass = s.moving_masses.emplace_back();
  mass.mass_kg = 0.001, mass.motion = MassMotion::circle, mass.start_m = {0.01, 0, 0}, mass.frequency_hz = 1;
}
void ask_for_rotor(Scenario& s) {
  RotorSpec& rotor = s.rotor.emplace();
  rotor.mass_kg = 0.01, rotor.axial_kg_m2 = 1e-6, rotor.transverse_kg_m2 = 1e-6, rotor.axis = {0, 1, 1};
}
void ask_for_platform(Scenario& s) { s.platform.emplace().rate_rad_s = 0.1; }
void ask_for_journey(Scenario& s) { s.travel.emplace().speed_m_s = 10; }
void ask_for_gimbal(Scenario& s) { s.effects.applied.gimbal.emplace(), s.release.tilt_deg = 90; }

struct Asked {
  SupportKind kind;
  std::string_view pointer;
  void (*ask)(Scenario&);
};
constexpr Asked kAsked[] = {
    {SupportKind::table, "/contact", ask_for_table},          {SupportKind::suspension, "/gimbals", ask_for_gimbals},
    {SupportKind::masses, "/moving_masses", ask_for_masses},  {SupportKind::rotor, "/rotor", ask_for_rotor},
    {SupportKind::platform, "/platform", ask_for_platform},   {SupportKind::journey, "/travel", ask_for_journey},
    {SupportKind::gimbal, "/effects/gimbal", ask_for_gimbal}, {SupportKind::pivot, "", [](Scenario&) {}}};
static_assert(std::size(kAsked) == kSupportCount);

TEST(Support, IsTheFirstThatAScenarioAsksFor) {
  for (std::size_t first = 0; first < std::size(kAsked); ++first)
    for (std::size_t second = first; second < std::size(kAsked); ++second) {
      Scenario scenario = testing::toy_top();
      kAsked[second].ask(scenario);
      kAsked[first].ask(scenario);
      EXPECT_EQ(support_of(scenario).kind, kAsked[first].kind) << kAsked[first].pointer << " " << kAsked[second].pointer;
      EXPECT_EQ(support_of(scenario).pointer, kAsked[first].pointer);
      EXPECT_EQ(&resolve(scenario).support(), &support_of(scenario));
    }
}

// Which scenes are plain is a fact of its own: an exact method would give a motion that none of the other supports has.
TEST(Support, OnlyAFixedPivotHasExactMotions) {
  for (const Asked& asked : kAsked) {
    const Scene scene = changed(testing::toy_top(), asked.ask);
    const auto& refusal = scene.method_refusal(Method::long_horizon);
    const std::string said = refusal.value_or("");
    EXPECT_EQ(scene.is_plain(), asked.kind == SupportKind::pivot) << asked.pointer;
    switch (asked.kind) {
      case SupportKind::table:
        EXPECT_EQ(said, "\"long_horizon\" is not available for a top on a table; take \"auto\", or leave the contact out");
        break;
      case SupportKind::suspension:
        EXPECT_EQ(said, "\"long_horizon\" is not available for a body in gimbals; take \"auto\", or leave the gimbals out");
        break;
      case SupportKind::masses:
        EXPECT_EQ(
            said,
            "\"long_horizon\" is not available with masses that move in the body; take \"auto\", or leave the masses out");
        break;
      case SupportKind::rotor:
        EXPECT_EQ(said, "\"long_horizon\" is not available with a rotor in the body; take \"auto\", or leave the rotor out");
        break;
      case SupportKind::platform:
        EXPECT_EQ(said, "\"long_horizon\" is not available on a platform; take \"auto\", or leave the platform out");
        break;
      case SupportKind::journey:
        EXPECT_EQ(said, "\"long_horizon\" is not available on a journey; take \"auto\", or leave the journey out");
        break;
      case SupportKind::gimbal:
        EXPECT_EQ(
            said,
            "\"long_horizon\" works only with gravity and the Earth's rotation; take \"auto\", or leave the other effects "
            "out");
        break;
      case SupportKind::pivot: EXPECT_EQ(said, "");
    }
  }
}

// Dry friction of the pivot stops a motion: neither a platform nor a gimbal has the equations for that, and a table has no pivot.
TEST(Support, ItsChecksAreItsOwn) {
  constexpr std::string_view kSaid[] = {
      "is not available with /contact: it is friction of a fixed pivot, a torque without a force; a tip's friction is "
      "/contact/law, "
      "spinning_friction_m and rolling_resistance_m; leave one of the two out",
      "is not available with /gimbals: it is friction of a pivot, and gimbals have bearings with friction of their own; leave "
      "one "
      "of the two out",
      "is not available with /moving_masses: dry friction at the pivot of a gyrostat is not modelled; leave one of the two out",
      "is not available with /rotor: dry friction at the pivot of a gyrostat is not modelled; leave one of the two out",
      "is not available on a platform; leave one of the two out",
      "is not available with /travel: dry friction that brings a motion to rest is not modelled aboard; take "
      "viscous_torque_N_m_s; leave one of the two out",
      "is not available with a gimbal; give the gimbal a damping instead",
      ""};
  for (const Asked& asked : kAsked) {
    Scenario scenario = testing::toy_top();
    asked.ask(scenario);
    scenario.effects.applied.coulomb_N_m = 1e-6;
    const ScenarioReport report = examine_scenario({"top.json", canonical_json(scenario)});
    const std::string_view said = kSaid[static_cast<std::size_t>(asked.kind)];
    ASSERT_EQ(report.error_count, said.empty() ? 0 : 1) << asked.pointer;
    if (said.empty()) continue;
    EXPECT_EQ(report.errors.front().pointer, "/effects/coulomb_torque_N_m") << asked.pointer;
    EXPECT_EQ(report.errors.front().message, said);
  }
}

TEST(Support, WhatARotorHasNotIsSaid) {
  const Support& rotor = changed(testing::toy_top(), ask_for_rotor).support();
  EXPECT_EQ(rotor.no_trend, "a rotor turns in the body");
  EXPECT_EQ(
      rotor.no_effect_sizes,
      "effects are sized only for a rigid body; to see what an effect does with a rotor, run the scenario with and without it");
}

TEST(Support, WhatMovingMassesHaveNotIsSaid) {
  const Support& masses = changed(testing::toy_top(), ask_for_masses).support();
  EXPECT_EQ(masses.no_trend, "masses move in the body");
  EXPECT_EQ(masses.no_effect_sizes,
            "effects are sized only for a rigid body; to see what an effect does with moving masses, run the scenario with and "
            "without it");
}

TEST(Support, WhatATableHasNotIsSaid) {
  const Support& table = changed(testing::toy_top(), ask_for_table).support();
  EXPECT_EQ(table.no_trend, "the top stands on a table");
  EXPECT_TRUE(table.has_contact);
  EXPECT_EQ(table.no_motion_alone, "of a top on a table both motions are integrated together; take the drift");
}

// A part that is made anew would have another address.
TEST(Support, ATableIsMadeOnce) {
  const Scene scene = changed(testing::toy_top(), ask_for_table), copy = scene;
  EXPECT_EQ(&scene.table<double>(), &copy.table<double>());
  EXPECT_EQ(&scene.table<float128>(), &copy.table<float128>());
  EXPECT_EQ(&scene.touchdown(), &copy.touchdown());
  EXPECT_NE(&scene.table<double>(), &changed(scene, [](Scenario&) {}).table<double>());
}

/// Whether two lists of numbers are the same, digit by digit.
template <class T>
bool same(const Mat3<T>& a, const Mat3<T>& b) {
  return (a.array() == b.array()).all();
}

template <class T>
void expect_natural_units_of(const Scene& scene) {
  const TableProblem<T>& given = scene.table<T>();
  const DriftProblem<T>& problem = scene.problem<T>();
  ASSERT_TRUE(problem.table);
  const Contact<T>& contact = problem.table->contact;
  const int mass = problem.units.mass_exponent, time = problem.units.time_exponent;
  EXPECT_TRUE(mass != 0 && time != 0);
  const auto times_power = [](const Mat3<T>& m, int exponent) {
    return Mat3<T>(m.unaryExpr([&](const T& x) { return real::scale(x, exponent); }));
  };
  // Momentum/length is mass/time: friction over slip.
  EXPECT_TRUE(contact.mass == real::scale(given.contact.mass, -mass));
  EXPECT_TRUE(contact.viscosity == real::scale(given.contact.viscosity, time - mass));
  EXPECT_TRUE(contact.slip_floor == real::scale(given.contact.slip_floor, time));
  EXPECT_TRUE(contact.rate_floor == real::scale(given.contact.rate_floor, time));
  EXPECT_TRUE(contact.tip_radius == given.contact.tip_radius && contact.spinning_length == given.contact.spinning_length);
  EXPECT_TRUE(same(contact.I_BC_B, times_power(given.contact.I_BC_B, -mass)));
  EXPECT_TRUE(same(contact.I_BC_B_inverse, times_power(given.contact.I_BC_B_inverse, mass)));
  EXPECT_TRUE(same(contact.S_BC_B, times_power(given.contact.S_BC_B, -mass)));
  EXPECT_TRUE(same(contact.gradient_H, times_power(given.contact.gradient_H, 2 * time)));
  EXPECT_TRUE(!same(contact.gradient_H, Mat3<T>(Mat3<T>::Zero())));
  EXPECT_TRUE(contact.I1 == contact.I_BC_B(0, 0) && contact.I3 == contact.I_BC_B(2, 2));
  EXPECT_TRUE(problem.table->start.v_O[0] == real::scale(T(0.1), time) && problem.table->start.p_O[0] == T(3));
}

TEST(Support, AProblemHasTheTableInNaturalUnits) {
  const Scene scene = changed(testing::toy_top(), [](Scenario& s) {
    s.contact = ContactSpec{.tip_radius_m = 0.002, .law = ContactLaw::viscous, .sliding_viscosity_N_s_m = 0.05};
    s.contact->regularisation_m_s = 0.01, s.contact->regularisation_rad_s = 0.3, s.contact->spinning_friction_m = 1e-5;
    s.contact->start = ContactStart::tip_velocity, s.contact->tip_velocity_m_s = {0.1, 0}, s.contact->tip_position_m = {3, 4};
    s.effects.applied.gravity_gradient.emplace();
  });
  expect_natural_units_of<double>(scene);
  expect_natural_units_of<float80>(scene);
  expect_natural_units_of<float128>(scene);
}

// A viscosity per load is a time over a length, not a mass over a time.
TEST(Support, AViscosityPerLoadHasItsOwnUnit) {
  const Scene scene = changed(testing::toy_top(), [](Scenario& s) {
    s.contact = ContactSpec{.tip_radius_m = 0.002, .law = ContactLaw::viscous_load, .sliding_viscosity_s_m = 0.3};
  });
  const DriftProblem<double>& problem = scene.problem<double>();
  EXPECT_EQ(problem.table->contact.viscosity, real::scale(0.3, -problem.units.time_exponent));
}

// The third power of such moments is 0 in a double.
TEST(Support, TheContactOfTinyMomentsIsFinite) {
  Body<double> body = make_body<double>(Scenario(testing::toy_top()).body);
  const ContactSpec spec{.tip_radius_m = 0.002, .law = ContactLaw::rolling};
  const Site site{45, 0, 0, 9.8};
  const Contact<double> everyday = make_contact<double>(spec, body, site, {}, nullptr);
  const NaturalUnits tiny{.mass_exponent = 400};
  body.mass = real::scale(body.mass, -tiny.mass_exponent);
  for (double& moment : body.I_BP_B.reshaped()) moment = real::scale(moment, -tiny.mass_exponent);
  EXPECT_TRUE(
      same(make_contact<double>(spec, body, site, {}, nullptr).I_BC_B_inverse, in_units(everyday, tiny).I_BC_B_inverse));
}

}  // namespace
}  // namespace earthtop
