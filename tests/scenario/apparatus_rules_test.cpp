// SPDX-License-Identifier: GPL-3.0-or-later
// Bad friction of body axes, supports, given torques and air are refused, with the place and a remedy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "earthtop/scenario/scenario.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/refusals.hpp"

namespace earthtop::apparatus_rules {
namespace {

constexpr const char* kScene = R"({
  "site": {"latitude_deg": 45, "gravity_m_s2": 9.80665},
  "body": {"mass_kg": 1, "center_of_mass_m": [0, 0, -0.5], "inertia": {"principal_kg_m2": [0.26, 0.26, 0.01]}},
  "release": {"tilt_deg": 5, "spin_rad_s": 0},
  "motion": {"duration_s": 0.5}
})";

constexpr const char* kTable = R"({"tip_radius_m": 0.002, "law": "frictionless"})";
constexpr const char* kGimbals = R"({"outer": {"mass_kg": 0.15, "inertia": {"principal_kg_m2": [4e-4, 4e-4, 3e-4]}}})";
constexpr const char* kAngles = R"({"outer_angle_deg": 20, "inner_angle_deg": 60})";

const testing::Refusal kRefusals[] = {
    {{{"/effects/viscous_torque_N_m_s", "-1"}}, "/effects/viscous_torque_N_m_s", "from 0"},
    {{{"/effects/viscous_torque_N_m_s", "[1, 2]"}}, "/effects/viscous_torque_N_m_s", "a number, or an array of 3 numbers"},
    {{{"/effects/viscous_torque_N_m_s", "[1, 2, -3]"}}, "/effects/viscous_torque_N_m_s/2", "from 0"},
    {{{"/effects/viscous_torque_N_m_s", "\"much\""}}, "/effects/viscous_torque_N_m_s", "must be a number"},
    {{{"/effects/viscous_torque_N_m_s", "[1, 2, 3]"}, {"/gimbals", kGimbals}, {"/release", kAngles}},
     "/effects/viscous_torque_N_m_s",
     "bearings"},
    {{{"/effects/unequal_support", "{}"}}, "/effects/unequal_support/kappa_N_m", "missing"},
    {{{"/effects/unequal_support", "true"}}, "/effects/unequal_support", "an object"},
    {{{"/effects/unequal_support", R"({"kappa_N_m": 1, "periods_s": [1, 2]})"}},
     "/effects/unequal_support/periods_s",
     "exactly one"},
    {{{"/effects/unequal_support", R"({"periods_s": [0, 2]})"}}, "/effects/unequal_support/periods_s/0", "above 0"},
    {{{"/effects/unequal_support", R"({"periods_s": [1, 2]})"}, {"/site/gravity_m_s2", "0"}},
     "/effects/unequal_support/periods_s",
     "kappa_N_m"},
    {{{"/effects/unequal_support", R"({"periods_s": [1, 2]})"}, {"/body/inertia/principal_kg_m2", "[0.26, 0.27, 0.01]"}},
     "/effects/unequal_support/periods_s",
     "symmetric"},
    {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}, {"/contact", kTable}}, "/effects/unequal_support", "pivot"},
    {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}, {"/gimbals", kGimbals}, {"/release", kAngles}},
     "/effects/unequal_support",
     "torsion"},
    {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}, {"/platform", R"({"motion": "constant", "rate_rad_s": 1})"}},
     "/effects/unequal_support",
     "laboratory"},
    {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}, {"/effects/gimbal", "true"}, {"/release/tilt_deg", "90"}},
     "/effects/unequal_support",
     "level"},
    {{{"/effects/unequal_support", R"({"kappa_N_m": 1, "stiffness": 2})"}}, "/effects/unequal_support/stiffness", "unknown"},
    {{{"/effects/given_torque", R"({"torque_N_m": [0, 0, 1]})"}}, "/effects/given_torque/axes", "missing"},
    {{{"/effects/given_torque", R"({"axes": "space", "torque_N_m": [0, 0, 1]})"}}, "/effects/given_torque/axes", "laboratory"},
    {{{"/effects/given_torque", R"({"axes": "body"})"}}, "/effects/given_torque/torque_N_m", "missing"},
    {{{"/effects/given_torque", R"({"axes": "body", "torque_N_m": 1})"}}, "/effects/given_torque/torque_N_m", "3 numbers"},
    {{{"/effects/given_torque", R"({"axes": "body", "torque_N_m": [0, 0, 1], "frequency_hz": 1})"}},
     "/effects/given_torque/frequency_hz",
     "does not belong to the course \"constant\""},
    {{{"/effects/given_torque", R"({"axes": "body", "course": "harmonic", "torque_N_m": [0, 0, 1]})"}},
     "/effects/given_torque/frequency_hz",
     "missing"},
    {{{"/effects/given_torque", R"({"axes": "body", "course": "table"})"}}, "/effects/given_torque/file", "missing"},
    {{{"/effects/given_torque", R"({"axes": "body", "course": "table", "file": "none.csv"})"}},
     "/effects/given_torque/file",
     "no such file"},
    {{{"/effects/given_torque", R"({"axes": "body", "torque_N_m": [0, 0, 1]})"}, {"/contact", kTable}},
     "/effects/given_torque",
     "/contact"},
    {{{"/effects/given_torque", R"({"axes": "body", "torque_N_m": [0, 0, 1]})"}, {"/gimbals", kGimbals}, {"/release", kAngles}},
     "/effects/given_torque",
     "pivot"},
    {{{"/effects/air_force", R"({"linear_N_s_m": 1})"}}, "/effects/air_force", "/contact"},
    {{{"/effects/air_force", R"({"linear_N_s_m": -1})"}, {"/contact", kTable}}, "/effects/air_force/linear_N_s_m", "from 0"},
    {{{"/effects/coulomb_torque_N_m", "1"}, {"/contact", kTable}}, "/effects/coulomb_torque_N_m", "/contact"},
    {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}, {"/numerics", R"({"method": "closed_form"})"}},
     "/numerics/method",
     "leave the other effects out"},
    {{{"/effects/given_torque", R"({"axes": "body", "torque_N_m": [0, 0, 1]})"},
      {"/numerics", R"({"method": "long_horizon"})"}},
     "/numerics/method",
     "leave the other effects out"},
    {{{"/effects/unequal_support", R"({"kappa_N_m": 1})"}, {"/numerics", R"({"method": "fourier"})"}},
     "/numerics/method",
     "leave the other effects out"},
    {{{"/effects/viscous_torque_N_m_s", "[1, 1, 1]"}, {"/numerics", R"({"method": "splitting"})"}},
     "/numerics/method",
     "leave the other effects out"},
    {{{"/uncertainty", R"({"viscous_torque_1_N_m_s": 0.1})"}}, "/uncertainty/viscous_torque_1_N_m_s", "no such number"},
    {{{"/uncertainty", R"({"support_azimuth_deg": 0.1})"}}, "/uncertainty/support_azimuth_deg", "no such number"},
    {{{"/uncertainty", R"({"given_torque_2_N_m": 0.1})"}}, "/uncertainty/given_torque_2_N_m", "no such number"},
};

TEST(ApparatusRules, BadInputIsRefusedWithPlaceAndRemedy) {
  for (const testing::Refusal& refusal : kRefusals) testing::expect_refused({"apparatus.json", kScene}, refusal);
}

TEST(ApparatusRules, WhatActsIsWrittenAndReadAgain) {
  const Scenario s =
      parse_scene({"apparatus.json", kScene},
                  {{"/effects/viscous_torque_N_m_s", "[1e-6, 2e-6, 0]"},
                   {"/effects/unequal_support", R"({"periods_s": [1.4, 1.5], "azimuth_deg": -20})"},
                   {"/effects/given_torque",
                    R"({"axes": "laboratory", "course": "harmonic", "torque_N_m": [0, 1, 0], "frequency_hz": 2})"}})
          .scenario();
  EXPECT_EQ(parse_scene({"again.json", canonical_json(s)}).scenario(), s);
}

}  // namespace
}  // namespace earthtop::apparatus_rules
