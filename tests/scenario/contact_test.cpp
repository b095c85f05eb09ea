// SPDX-License-Identifier: GPL-3.0-or-later
// The block `contact`: what it says, and that wrong ones are refused at their place with a remedy.
#include <gtest/gtest.h>

#include <cmath>

#include "earthtop/model/release.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/reference.hpp"
#include "scene/touchdown.hpp"
#include "support.hpp"
#include "support/tolerances.hpp"

namespace earthtop::scenario_test {
namespace {

/// A toy top whose moments are given about its centre of mass, with the contact on the last line.
const std::string kToy =
    "{\"name\": \"toy\", \"site\": {\"latitude_deg\": 45, \"gravity_m_s2\": 9.80665},\n"
    " \"body\": {\"mass_kg\": 0.1, \"center_of_mass_m\": [0, 0, 0.03], \"inertia\": {\"about\": \"center_of_mass\", "
    "\"principal_kg_m2\": [3e-5, 3e-5, 4e-5]}},\n"
    " \"release\": {\"tilt_deg\": 20, \"azimuth_deg\": 90, \"spin_rad_s\": 200},\n"
    " \"motion\": {\"duration_s\": 1},\n";
std::string on_table(const std::string& contact) { return kToy + " \"contact\": " + contact + "}\n"; }

const std::string kFree = R"({"tip_radius_m": 0.002, "law": "frictionless"})";
const std::string kViscous = R"({"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 0.05})";
const std::string kLoad = R"({"tip_radius_m": 0.002, "law": "viscous_load", "sliding_viscosity_s_m": 0.3})";
const std::string kCoulomb =
    R"({"tip_radius_m": 0.002, "law": "coulomb", "friction_coefficient": 0.2, "regularisation_m_s": 0.02})";
const std::string kExact = R"({"tip_radius_m": 0.002, "law": "coulomb", "friction_coefficient": 0.2})";
const std::string kContensou =
    R"({"tip_radius_m": 0.002, "law": "contensou", "friction_coefficient": 0.2, "patch_radius_m": 3e-5})";
const std::string kRolling = R"({"tip_radius_m": 0.002, "law": "rolling"})";

std::string with(std::string contact, const std::string& more) {
  contact.pop_back();
  return contact + ", " + more + "}";
}

ScenarioReport report_of(const std::string& contact, const Overrides& overrides = {}) {
  return examine_scenario({"toy.json", on_table(contact)}, overrides);
}

TEST(ContactKeys, EveryLawIsRead) {
  const std::pair<std::string, ContactLaw> laws[] = {{kFree, ContactLaw::frictionless},   {kViscous, ContactLaw::viscous},
                                                     {kLoad, ContactLaw::viscous_load},   {kCoulomb, ContactLaw::coulomb},
                                                     {kContensou, ContactLaw::contensou}, {kRolling, ContactLaw::rolling}};
  for (const auto& [text, law] : laws) {
    const ScenarioReport report = report_of(text);
    for (const Diagnostic& error : report.errors) ADD_FAILURE() << text << error.pointer << " " << error.message;
    for (const Diagnostic& warning : report.warnings) ADD_FAILURE() << text << warning.pointer << " " << warning.message;
    ASSERT_TRUE(report.scenario && report.scenario->contact) << text;
    const ContactSpec& spec = *report.scenario->contact;
    EXPECT_EQ(spec.law, law);
    EXPECT_EQ(spec.tip_radius_m, 0.002);
    EXPECT_EQ(spec.start, law == ContactLaw::rolling ? ContactStart::rolling : ContactStart::tip_at_rest);
    const std::string canonical = canonical_json(*report.scenario);
    const Scenario again = parse(canonical);
    EXPECT_TRUE(again == *report.scenario) << canonical;
    EXPECT_EQ(canonical_json(again), canonical);
  }
}

TEST(ContactKeys, ValuesAndDefaultsAreRead) {
  const auto spec_of = [](const std::string& contact) { return *parse(on_table(contact)).contact; };
  const ContactSpec viscous = spec_of(kViscous);
  EXPECT_EQ(viscous.sliding_viscosity_N_s_m, 0.05);
  EXPECT_EQ(viscous.tip_position_m, (std::array<double, 2>{0, 0}));
  EXPECT_EQ(viscous.spinning_friction_m, 0);
  EXPECT_EQ(viscous.rolling_resistance_m, 0);
  EXPECT_EQ(viscous.table_tilt_deg, 0);
  EXPECT_FALSE(viscous.max_tilt_deg);
  EXPECT_EQ(spec_of(kLoad).sliding_viscosity_s_m, 0.3);
  EXPECT_EQ(spec_of(kCoulomb).friction_coefficient, 0.2);
  EXPECT_EQ(spec_of(kCoulomb).regularisation_m_s, 0.02);
  EXPECT_EQ(spec_of(kExact).regularisation_m_s, 0);
  EXPECT_EQ(spec_of(kContensou).patch_radius_m, 3e-5);
  EXPECT_EQ(spec_of(with(kRolling, R"("static_coefficient": 0.4)")).static_coefficient, 0.4);
  EXPECT_FALSE(spec_of(kRolling).static_coefficient);
  const ContactSpec moments = spec_of(
      with(kViscous,
           R"("spinning_friction_m": 1e-5, "rolling_resistance_m": 2e-5, "regularisation_rad_s": 0.5, "max_tilt_deg": 75)"));
  EXPECT_EQ(moments.spinning_friction_m, 1e-5);
  EXPECT_EQ(moments.rolling_resistance_m, 2e-5);
  EXPECT_EQ(moments.regularisation_rad_s, 0.5);
  EXPECT_EQ(moments.max_tilt_deg, 75);
  const ContactSpec moving = spec_of(with(kViscous, R"("tip_velocity_m_s": [1, -2], "tip_position_m": [3, 4])"));
  EXPECT_EQ(moving.start, ContactStart::tip_velocity);
  EXPECT_EQ(moving.tip_velocity_m_s, (std::array<double, 2>{1, -2}));
  EXPECT_EQ(moving.tip_position_m, (std::array<double, 2>{3, 4}));
  EXPECT_EQ(spec_of(with(kFree, R"("start": "center_of_mass_at_rest")")).start, ContactStart::center_of_mass_at_rest);
  EXPECT_EQ(spec_of(R"({"tip_radius_m": 0, "law": "frictionless"})").tip_radius_m, 0) << "a point";
  EXPECT_EQ(spec_of(with(kViscous, R"("_note": "a comment", "spinning_friction_m": 0)")), viscous);
}

/// A rate without the moments that it belongs to means nothing: the canonical text is that without either.
TEST(ContactKeys, SwitchedOffMomentsLeaveNothing) {
  const Scenario off = parse(on_table(with(kViscous, R"("spinning_friction_m": 0, "regularisation_rad_s": 0.5)")));
  EXPECT_EQ(canonical_json(off), canonical_json(parse(on_table(kViscous))));
}

TEST(ContactKeys, ASceneWithoutContactKeepsItsText) {
  EXPECT_FALSE(parse(kMinimal).contact);
  EXPECT_EQ(canonical_json(parse(kMinimal)).find("contact"), std::string::npos);
  EXPECT_EQ(identity_json(parse(kMinimal)).find("table"), std::string::npos);
}

TEST(ContactKeys, NestedPointersCanBeSet) {
  const std::string text = on_table(kContensou);
  const Scenario tilted = parse(text, {{"/contact/table/tilt_deg", "5"}, {"/contact/table/tilt_azimuth_deg", "-30"}});
  EXPECT_EQ(tilted.contact->table_tilt_deg, 5);
  EXPECT_EQ(tilted.contact->table_tilt_azimuth_deg, -30);
  EXPECT_TRUE(parse(canonical_json(tilted)) == tilted);
  EXPECT_NE(identity_json(tilted), identity_json(parse(text)));
  EXPECT_EQ(parse(text, {{"/contact/friction_coefficient", "0.3"}}).contact->friction_coefficient, 0.3);
  EXPECT_EQ(parse(on_table(with(kFree, R"("tip_velocity_m_s": [1, 2])")), {{"/contact/tip_velocity_m_s/1", "3"}})
                .contact->tip_velocity_m_s,
            (std::array<double, 2>{1, 3}));
  expect_one(text, "0:0 /contact/table/tilt_deg", "is out of range; must be a number from 0 to 80 (deg)",
             {{"/contact/table/tilt_deg", "81"}});
  expect_one(text, "0:0 /contact/table/azimuth_deg", "did you mean \"tilt_azimuth_deg\"",
             {{"/contact/table/azimuth_deg", "1"}});
}

TEST(ContactKeys, AnExampleExplainsWhatTheLawTakes) {
  const std::string annotated = annotated_scenario({"toy.json", on_table(kContensou)});
  EXPECT_NE(annotated.find("\"_patch_radius_m\""), std::string::npos);
  EXPECT_EQ(annotated.find("regularisation_m_s\""), std::string::npos) << "belongs to coulomb";
  EXPECT_EQ(identity_json(parse(annotated)), identity_json(parse(on_table(kContensou))));
  EXPECT_EQ(identity_json(parse(annotated_scenario({"toy.json", on_table(kExact)}))), identity_json(parse(on_table(kExact))));
}

struct Fault {
  std::string contact;    ///< the block
  std::string place;      ///< line:column and pointer
  std::string says;       ///< part of the message
  Overrides others = {};  ///< what stands beside it
};

void expect_fault(const Fault& fault) {
  SCOPED_TRACE(fault.contact + " " + fault.place + (fault.others.empty() ? "" : " " + fault.others[0].first));
  expect_one(on_table(fault.contact), fault.place, fault.says, fault.others);
}

TEST(ContactKeys, WrongValuesAreRefusedAtTheirPlace) {
  const Fault faults[] = {
      {"true", "5:13 /contact", "is true; must be an object"},
      {"\"contensou\"", "5:13 /contact", "must be an object"},
      {"[]", "5:13 /contact", "must be an object"},
      {"null", "5:13 /contact", "must be an object"},
      {R"({"law": "frictionless"})", "5:13 /contact/tip_radius_m", "is missing; must be a number from 0 to 1000 (m)"},
      {R"({"tip_radius_m": 0.002})", "5:13 /contact/law", "is missing; must be \"frictionless\", \"viscous\""},
      {R"({"tip_radius_m": 0.002, "law": "colomb"})", "5:44 /contact/law", "did you mean \"coulomb\""},
      {R"({"tip_radius_m": 0.002, "law": "Rolling"})", "5:44 /contact/law", "did you mean \"rolling\""},
      {R"({"tip_radius_m": 0.002, "law": 3})", "5:44 /contact/law", "is 3; must be"},
      {R"({"tip_radius_m": 0.002, "law": null})", "5:44 /contact/law", "is null; must be"},
      {R"({"tip_radius_m": -0.002, "law": "frictionless"})", "5:30 /contact/tip_radius_m", "-0.002 is out of range"},
      {R"({"tip_radius_m": "2 mm", "law": "frictionless"})", "5:30 /contact/tip_radius_m", "is \"2 mm\"; must be a number"},
      {R"({"tip_radius_m": 1e4, "law": "frictionless"})", "5:30 /contact/tip_radius_m", "is out of range"},
      {R"({"tip_radius_mm": 2, "law": "frictionless"})", "5:14 /contact/tip_radius_mm", "give tip_radius_m; 1 mm = 0.001 m"},
      {R"({"tip_radius_m": 0.002, "law": "frictionless", "mu": 0.2})", "5:60 /contact/mu", "unknown key"},
      {with(kFree, R"("friction_coefficient": 0.2)"), "5:60 /contact/friction_coefficient",
       "belongs to the law \"coulomb\" or \"contensou\", not to \"frictionless\", which takes no coefficient"},
      {with(kRolling, R"("friction_coefficient": 0.2)"), "5:55 /contact/friction_coefficient",
       "not to \"rolling\", which takes static_coefficient"},
      {with(kViscous, R"("sliding_viscosity_s_m": 0.2)"), "5:88 /contact/sliding_viscosity_s_m",
       "belongs to the law \"viscous_load\", not to \"viscous\", which takes sliding_viscosity_N_s_m; leave it out"},
      {with(kExact, R"("patch_radius_m": 1e-5)"), "5:84 /contact/patch_radius_m", "belongs to the law \"contensou\""},
      {with(kContensou, R"("regularisation_m_s": 0.01)"), "5:110 /contact/regularisation_m_s",
       "belongs to the law \"coulomb\""},
      {with(kCoulomb, R"("static_coefficient": 0.01)"), "5:112 /contact/static_coefficient", "belongs to the law \"rolling\""},
      {R"({"tip_radius_m": 0.002, "law": "viscous"})", "5:13 /contact/sliding_viscosity_N_s_m", "is missing"},
      {R"({"tip_radius_m": 0.002, "law": "viscous_load"})", "5:13 /contact/sliding_viscosity_s_m", "is missing"},
      {R"({"tip_radius_m": 0.002, "law": "coulomb"})", "5:13 /contact/friction_coefficient", "is missing"},
      {R"({"tip_radius_m": 0.002, "law": "contensou", "friction_coefficient": 0.2})", "5:13 /contact/patch_radius_m",
       "is missing; must be a number above 0"},
      {R"({"tip_radius_m": 0.002, "law": "contensou", "patch_radius_m": 1e-5})", "5:13 /contact/friction_coefficient",
       "is missing"},
      {with(kFree, R"("start": "rest")"), "5:69 /contact/start", "must be \"tip_at_rest\", \"rolling\""},
      {with(kFree, R"("start": [0, 0])"), "5:69 /contact/start", "is an array of 2"},
      {with(kFree, R"("start": "tip_at_rest", "tip_velocity_m_s": [0, 0])"), "5:84 /contact/tip_velocity_m_s",
       "both given; give at most one"},
      {with(kRolling, R"("start": "tip_at_rest")"), "5:64 /contact/start", "the law \"rolling\" starts without slip"},
      {with(kRolling, R"("tip_velocity_m_s": [0, 0])"), "5:55 /contact/tip_velocity_m_s", "starts without slip"},
      {with(kFree, R"("tip_velocity_m_s": 1)"), "5:80 /contact/tip_velocity_m_s", "is 1; must be an array of 2 numbers"},
      {with(kFree, R"("tip_velocity_m_s": [1])"), "5:80 /contact/tip_velocity_m_s", "is an array of 1"},
      {with(kFree, R"("tip_velocity_m_s": [1, 0, 0])"), "5:80 /contact/tip_velocity_m_s", "is an array of 3"},
      {with(kFree, R"("tip_velocity_m_s": [1, "0"])"), "5:84 /contact/tip_velocity_m_s/1", "is \"0\"; must be a number"},
      {with(kFree, R"("tip_velocity_m_s": [1e7, 0])"), "5:81 /contact/tip_velocity_m_s/0", "is out of range"},
      {with(kFree, R"("tip_position_m": [0, 0, 0.002])"), "5:78 /contact/tip_position_m", "is an array of 3"},
      {with(kFree, R"("tip_position_m": {})"), "5:78 /contact/tip_position_m", "must be an array of 2 numbers"},
      {with(kViscous, R"("spinning_friction_m": 1e-5)"), "5:13 /contact/regularisation_rad_s", "is missing"},
      {with(kRolling, R"("rolling_resistance_m": 1e-5)"), "5:13 /contact/regularisation_rad_s", "is missing"},
      {with(kViscous, R"("regularisation_rad_s": 1)"), "5:88 /contact/regularisation_rad_s", "neither is given; leave it out"},
      {with(kViscous, R"("spinning_friction_m": 1e-5, "regularisation_rad_s": 0)"), "5:141 /contact/regularisation_rad_s",
       "0 is out of range; must be a number above 0"},
      {with(kViscous, R"("spinning_friction_m": -1e-5, "regularisation_rad_s": 1)"), "5:111 /contact/spinning_friction_m",
       "is out of range"},
      {with(kFree, R"("table": 5)"), "5:69 /contact/table", "is 5; must be an object"},
      {with(kFree, R"("table": {"tilt_deg": -1})"), "5:82 /contact/table/tilt_deg", "from 0 to 80"},
      {with(kFree, R"("table": {"tilt_deg": 90})"), "5:82 /contact/table/tilt_deg", "from 0 to 80"},
      {with(kFree, R"("table": {"tilt_azimuth_deg": 400})"), "5:90 /contact/table/tilt_azimuth_deg", "from -360 to 360"},
      {with(kFree, R"("table": {"slope_deg": 1})"), "5:70 /contact/table/slope_deg", "unknown key"},
      {with(kFree, R"("tilt_deg": 1)"), "5:60 /contact/tilt_deg", "unknown key"},
      {with(kFree, R"("max_tilt_deg": 181)"), "5:76 /contact/max_tilt_deg", "from 0 to 180"},
      {with(kFree, R"("max_tilt_deg": true)"), "5:76 /contact/max_tilt_deg", "is true"},
  };
  EXPECT_GT(std::size(faults), 45U);
  for (const Fault& fault : faults) expect_fault(fault);
}

/// Infinities and NaN are no JSON numbers: the text's reader refuses them before.
TEST(ContactKeys, NumbersThatAreNoneAreRefused) {
  for (const char* number : {"NaN", "Infinity", "-Infinity", "1e999", "0x1", ".2", "1e-400"}) {
    const Found found = found_in(on_table(replaced(kExact, "0.2", number)));
    ASSERT_EQ(found.places.size(), 1U) << number;
    EXPECT_TRUE(found.places[0].starts_with("5:")) << found.places[0];
  }
  for (const char* number : {"-0.1", "\"0.2\"", "true", "null", "[0.2]", "{}"})
    expect_fault({replaced(kExact, "0.2", number), "5:79 /contact/friction_coefficient", "must be a number from 0 to 1e+06"});
  for (const char* number : {"0", "-1e-5", "\"3e-5\""})
    expect_fault({replaced(kContensou, "3e-5", number), "5:104 /contact/patch_radius_m", "must be a number above 0"});
  expect_fault({replaced(kViscous, "0.05", "-0.05"), "5:82 /contact/sliding_viscosity_N_s_m", "is out of range"});
  expect_fault({replaced(kLoad, "0.3", "-0.3"), "5:85 /contact/sliding_viscosity_s_m", "is out of range"});
  expect_fault({replaced(kCoulomb, "0.02}", "-0.02}"), "5:106 /contact/regularisation_m_s", "is out of range"});
  const Found twice = found_in(on_table(with(kExact, R"("law": "rolling")")));
  ASSERT_EQ(twice.places.size(), 1U);
  EXPECT_TRUE(twice.says(0, "duplicate key"));
}

TEST(ContactKeys, WhatNoTableCanHaveIsRefusedWithTheReason) {
  const std::string platform = R"({"motion": "constant", "rate_rad_s": 1})";
  const Fault faults[] = {
      {kContensou, "0:0 /effects/gimbal", "a tip on a table is free; leave one of the two out", {{"/effects/gimbal", "true"}}},
      {kContensou,
       "0:0 /effects/viscous_torque_N_m_s",
       "a torque without a force",
       {{"/effects/viscous_torque_N_m_s", "1e-7"}}},
      {kFree,
       "0:0 /effects/quadratic_torque_N_m_s2",
       "is not available with /contact",
       {{"/effects/quadratic_torque_N_m_s2", "1e-9"}}},
      {kExact, "0:0 /effects/coulomb_torque_N_m", "is not available with /contact", {{"/effects/coulomb_torque_N_m", "1e-5"}}},
      {kContensou, "0:0 /effects/air_drag", "not its force", {{"/effects/air_drag", R"({"disc_radius_m": 0.03})"}}},
      {kContensou, "0:0 /platform", "a table that turns or swings is not modelled", {{"/platform", platform}}},
      {kContensou, "0:0 /numerics/observer", "must be \"laboratory\" or \"inertial\"", {{"/numerics/observer", "body"}}},
      {kFree, "0:0 /numerics/method", "is not available for a top on a table", {{"/numerics/method", "splitting"}}},
      {kRolling, "0:0 /numerics/method", "is not available for a top on a table", {{"/numerics/method", "long_horizon"}}},
      {kFree,
       "0:0 /numerics/method",
       "is not available for a top on a table",
       {{"/numerics/method", "closed_form"}, {"/earth/rotation_rate_rad_s", "0"}}},
      {kContensou,
       "0:0 /release/precession",
       "with /contact/law \"contensou\" give {\"rate_rad_s\": ...}",
       {{"/release/precession", "steady_slow"}}},
      {kViscous, "0:0 /release/precession", "take \"frictionless\" or \"rolling\"", {{"/release/precession", "steady_fast"}}},
      {with(kRolling, R"("table": {"tilt_deg": 1})"),
       "0:0 /release/precession",
       "on a tilted table no precession is steady",
       {{"/release/precession", "steady_slow"}}},
      {kRolling,
       "0:0 /release/precession",
       "give a faster spin",
       {{"/release/precession", "steady_slow"}, {"/release/spin_rad_s", "20"}}},
      {kFree,
       "0:0 /release/precession",
       "the axis is vertical",
       {{"/release/precession", "steady_slow"}, {"/release/tilt_deg", "0"}}},
      {kFree,
       "0:0 /release/precession",
       "no fast steady precession",
       {{"/release/precession", "steady_fast"}, {"/release/tilt_deg", "90"}}},
      {with(kFree, R"("max_tilt_deg": 20)"), "5:76 /contact/max_tilt_deg",
       "is not above the tilt of the release, 20.000000000000004 deg"},
      {with(kFree, R"("max_tilt_deg": 10)"), "5:76 /contact/max_tilt_deg", "give a larger angle, or leave it out"},
      {kFree,
       "2:72 /body/inertia",
       "all three moments must be above 0",
       {{"/body/inertia/principal_kg_m2", "[0, 3e-5, 3e-5]"}}},
      {kCoulomb, "0:0 /contact/regularisation_m_s", "at 1e+300 per second", {{"/contact/regularisation_m_s", "5e-324"}}},
      {kFree, "5:13 /contact", "the normal force at the release would be 0 N", {{"/site/gravity_m_s2", "0"}}},
  };
  for (const Fault& fault : faults) expect_fault(fault);
  expect_one(replaced(on_table(with(kFree, R"("table": {"tilt_deg": 1})")), "\"tilt_deg\": 20, \"azimuth_deg\": 90",
                      R"("quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0})"),
             "3:14 /release/quaternion_LB", "is an attitude relative to the laboratory");
  // An effect that is off may stand there.
  for (const auto& [pointer, value] : {std::pair{"/effects/gimbal", "false"}, {"/effects/viscous_torque_N_m_s", "0"}})
    EXPECT_TRUE(report_of(kContensou, {{pointer, value}}).scenario) << pointer;
  // Every fault at once.
  EXPECT_EQ(
      report_of(R"({"tip_radius_m": -1, "law": "colomb"})", {{"/effects/gimbal", "true"}, {"/platform", platform}}).error_count,
      4U);
}

TEST(ContactKeys, WhatATableCanHaveIsTaken) {
  const Overrides taken[] = {
      {{"/effects/gravity_gradient", "\"normal\""}},
      {{"/effects/tide", R"({"amplitude_m_s2": [1e-6, 0, 1e-6], "frequency_hz": 2e-5})"}},
      {{"/effects/polar_motion", R"({"x_arcsec": 0.1, "y_arcsec": 0.3})"}},
      {{"/effects/deflection_of_vertical", R"({"north_arcsec": 5})"}},
      {{"/effects/coriolis", "false"}},
      {{"/numerics/observer", "inertial"}},
      {{"/numerics/method", "extrapolation"}, {"/numerics/precision", "float128"}},
      {{"/numerics/model", "general"}},
      {{"/release/precession", R"({"rate_rad_s": 1})"}},
      {{"/release/rates_relative_to", "inertial"}},
      {{"/body/inertia/principal_kg_m2", "[3e-5, 2.5e-5, 4e-5]"}},
      {{"/contact/table/tilt_deg", "1"}},
      {{"/contact/max_tilt_deg", "20.001"}},
      {{"/numerics/ledger", "laboratory"}},
  };
  for (const std::string& contact : {kContensou, kExact})
    for (const Overrides& overrides : taken) {
      SCOPED_TRACE(overrides[0].first);
      // The exact law is for symmetric bodies only.
      if (contact == kExact && overrides[0].first == "/body/inertia/principal_kg_m2") continue;
      for (const Diagnostic& error : report_of(contact, overrides).errors)
        ADD_FAILURE() << error.pointer << " " << error.message;
    }
}

/// A uniform rod of a kilogram and a metre, tilted so that friction presses its end into the table most: 1 + 3 sin^2 =
/// 3 mu sin cos has a solution from mu = 4/3 on, at tan = 1/2.
TEST(ContactKeys, PainleveIsRefusedAtTheStart) {
  const std::string rod =
      "{\"site\": {\"latitude_deg\": 45, \"gravity_m_s2\": 9.81},\n"
      " \"body\": {\"mass_kg\": 1, \"center_of_mass_m\": [0, 0, 0.5], \"inertia\": {\"about\": \"center_of_mass\", "
      "\"principal_kg_m2\": [0.08333333333333333, 0.08333333333333333, 1e-4]}},\n"
      " \"release\": {\"tilt_deg\": 26.565051177077990, \"azimuth_deg\": 90, \"spin_rad_s\": 0},\n"
      " \"motion\": {\"duration_s\": 1}, \"contact\": {\"tip_radius_m\": 0, \"law\": \"coulomb\", \"tip_velocity_m_s\": [1, "
      "0],\n"
      " \"friction_coefficient\": 1.33}}\n";
  const Overrides backwards = {{"/contact/tip_velocity_m_s", "[-1, 0]"}};
  // The rod leans East; it jams when its end is dragged the one way, and not the other.
  EXPECT_NO_THROW(parse(rod));
  EXPECT_NO_THROW(parse(rod, backwards));
  const std::string rough = replaced(rod, "1.33}", "1.34}");
  const bool forwards_jams = !found_in(rough).places.empty(), backwards_jams = !found_in(rough, backwards).places.empty();
  EXPECT_NE(forwards_jams, backwards_jams);
  expect_one(rough, "5:26 /contact/friction_coefficient", "friction_coefficient must be below 1.333 in this release",
             forwards_jams ? Overrides{} : backwards);
}

/// A frictionless pendulum upside down that turns fast: the table would have to hold it. m l w^2 cos = m g.
TEST(ContactKeys, ATableDoesNotPull) {
  const auto fast = [](const std::string& rate) {
    return Overrides{{"/release", R"({"tilt_deg": 0, "angular_velocity_body_rad_s": [)" + rate + ", 0, 0]}"}};
  };
  // sqrt(9.80665 / 0.03) = 18.08 rad/s for the centre of mass over a tip at rest.
  EXPECT_TRUE(report_of(R"({"tip_radius_m": 0, "law": "frictionless"})", fast("18.07")).scenario);
  expect_fault({R"({"tip_radius_m": 0, "law": "frictionless"})", "5:13 /contact", "leaves the table at once", fast("18.09")});
}

/// The rate is mu g (1 + m (r + l)^2 / I1) / eps upright.
TEST(ContactKeys, ARegularisationThatStepsCannotFollowIsRefused) {
  const Overrides upright = {{"/release/tilt_deg", "0"}};
  const double expected = 0.2 * 9.80665 * (1 + 0.1 * 0.032 * 0.032 / 3e-5);
  const double rate = report_of(kCoulomb, upright).scene->touchdown().relaxation_rate_per_s();
  const double by_earth = std::pow(7.292115e-5, 2) * 0.032 / 9.80665;  // its rotation adds to the normal force
  EXPECT_NEAR(rate, expected / 0.02, by_earth * rate);
  const double least = expected / 1e5;
  const auto with_eps = [&](double eps) {
    Overrides changes = upright;
    changes.emplace_back("/contact/regularisation_m_s", std::to_string(eps));
    return changes;
  };
  EXPECT_TRUE(report_of(kCoulomb, with_eps(1.02 * least)).scenario);
  const ScenarioReport refused = report_of(kCoulomb, with_eps(0.98 * least));
  ASSERT_EQ(refused.errors.size(), 1U);
  EXPECT_EQ(refused.errors[0].pointer, "/contact/regularisation_m_s");
  EXPECT_NE(refused.errors[0].message.find("100000 per second, or 0 for the exact law"), std::string::npos)
      << refused.errors[0].message;
  EXPECT_EQ(report_of(kExact).scene->touchdown().relaxation_rate_per_s(), 0);
  EXPECT_EQ(report_of(kRolling).scene->touchdown().relaxation_rate_per_s(), 0);
  // 8 R w / (3 pi) takes the place of eps.
  EXPECT_NEAR(report_of(kContensou, upright).scene->touchdown().relaxation_rate_per_s() *
                  (8 * 3e-5 * 200 / (3 * 3.141592653589793)) / expected,
              1, by_earth);
}

TEST(ContactKeys, MistakesOfUnitAreWarnedOf) {
  struct Case {
    std::string contact, pointer, says;
    Overrides others = {};
  };
  const Case cases[] = {
      {R"({"tip_radius_m": 2, "law": "frictionless"})", "/contact/tip_radius_m", "write 0.002"},
      {R"({"tip_radius_m": 0.5, "law": "frictionless"})", "/contact/tip_radius_m", "larger than the body"},
      {replaced(kContensou, "3e-5", "0.03"), "/contact/patch_radius_m", "write 3e-05"},
      {replaced(kExact, "0.2", "20"), "/contact/friction_coefficient", "write 0.2", {{"/release/tilt_deg", "0"}}},
      {with(kRolling, R"("static_coefficient": 30)"), "/contact/static_coefficient", "write 0.3"},
      {with(kRolling, R"("rolling_resistance_m": 0.02, "regularisation_rad_s": 1)"), "/contact/rolling_resistance_m",
       "longer than the tip"},
      {replaced(kContensou, "3e-5", "1e-9"), "/contact/patch_radius_m", "a slip dies out at"},
      {replaced(kViscous, "0.05", "5e4"), "/contact/sliding_viscosity_N_s_m", "a slip dies out at"},
      {kContensou, "/contact", "0.028 m below the table", {{"/release/tilt_deg", "180"}}},
      {kContensou, "/contact/law", "does not turn about the normal", {{"/release/spin_rad_s", "0"}}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.contact);
    const ScenarioReport report = report_of(c.contact, c.others);
    for (const Diagnostic& error : report.errors) ADD_FAILURE() << error.pointer << " " << error.message;
    bool warned = false;
    for (const Diagnostic& warning : report.warnings)
      warned = warned || (warning.pointer == c.pointer && warning.message.find(c.says) != std::string::npos);
    EXPECT_TRUE(warned) << (report.warnings.empty() ? "no warning" : report.warnings[0].message);
  }
}

/// The roots of the quadratic equations of steady precession in contact_release.hpp, in 20 digits.
TEST(ContactKeys, SteadyPrecessionIsThatOnTheTable) {
  const auto rate = [](const std::string& contact, const std::string& which) {
    const Scene scene = *report_of(contact, {{"/release/precession", which}}).scene;
    const Vec3<double> w = scene.release<double>().w_XB_B;
    EXPECT_EQ(w[2], 200);
    return -w[0] / std::sin(20 * 3.141592653589793 / 180);
  };
  EXPECT_NEAR(rate(kFree, "steady_slow"), 3.7264267985134958930, testing::rounding(80));
  EXPECT_NEAR(rate(kFree, "steady_fast"), 280.05431252839642435, testing::rounding(20) * 280);
  EXPECT_NEAR(rate(kRolling, "steady_slow"), 3.3465228640411654360, testing::rounding(80));
}

}  // namespace
}  // namespace earthtop::scenario_test
