// SPDX-License-Identifier: GPL-3.0-or-later
// Bad scenarios with gimbals are refused, with the place and a remedy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "earthtop/scenario/scenario.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/refusals.hpp"

namespace earthtop {
namespace {

constexpr const char* kScene = R"({
  "site": {"latitude_deg": 45, "gravity_m_s2": 9.80665},
  "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0], "inertia": {"principal_kg_m2": [1.2e-4, 1.0e-4, 2.0e-4]}},
  "rotor": {"mass_kg": 0.3, "axial_kg_m2": 2e-4, "transverse_kg_m2": 1.1e-4, "spin_rad_s": 1000},
  "gimbals": {"outer": {"mass_kg": 0.15, "inertia": {"principal_kg_m2": [4e-4, 4e-4, 3e-4]}}, "inner": {}},
  "release": {"outer_angle_deg": 20, "inner_angle_deg": 60},
  "motion": {"duration_s": 0.5}
})";

const testing::Refusal kRefusals[] = {
    {{{"/gimbals/outer/axis_tilt_deg", "190"}}, "/gimbals/outer/axis_tilt_deg", "from 0 to 180"},
    {{{"/gimbals/outer/mass_kg", "0"}}, "/gimbals/outer/mass_kg", "above 0"},
    {{{"/gimbals/outer/mass_kg", "-1"}}, "/gimbals/outer/mass_kg", "above 0"},
    {{{"/gimbals/outer", R"({"mass_kg": 0.1})"}}, "/gimbals/outer/inertia", "missing"},
    {{{"/gimbals/outer", R"({"inertia": {"principal_kg_m2": [1e-4, 1e-4, 1e-4]}})"}}, "/gimbals/outer/mass_kg", "missing"},
    {{{"/gimbals/outer", R"({"center_of_mass_m": [0, 0, 0.1]})"}}, "/gimbals/outer/mass_kg", "missing"},
    {{{"/gimbals/outer/inertia/principal_kg_m2", "[1e-4, 1e-4, 3e-4]"}}, "/gimbals/outer/inertia", "triangle"},
    {{{"/gimbals/outer/inertia", R"({"matrix_kg_m2": [[1e-4, 1e-5, 0], [0, 1e-4, 0], [0, 0, 1e-4]]})"}},
     "/gimbals/outer/inertia/matrix_kg_m2",
     "not symmetric"},
    {{{"/gimbals/outer/inertia", "{}"}}, "/gimbals/outer/inertia/principal_kg_m2", "exactly one"},
    {{{"/gimbals/outer/center_of_mass_m", "[0, 0, 1]"}}, "/gimbals/outer/inertia", "negative"},
    {{{"/gimbals/inner/axis_skew_deg", "90"}}, "/gimbals/inner/axis_skew_deg", "89.9"},
    {{{"/gimbals/inner/axis_skew_deg", "\"none\""}}, "/gimbals/inner/axis_skew_deg", "number"},
    {{{"/gimbals/inner/locked", "1"}}, "/gimbals/inner/locked", "true or false"},
    {{{"/gimbals/inner/viscous_torque_N_m_s", "-1"}}, "/gimbals/inner/viscous_torque_N_m_s", "from 0"},
    {{{"/gimbals/outer/coulomb_torque_N_m", "1e-4"}}, "/gimbals/outer/regularisation_rad_s", "missing"},
    {{{"/gimbals/inner/regularisation_rad_s", "0.01"}}, "/gimbals/inner/regularisation_rad_s", "coulomb_torque_N_m"},
    {{{"/gimbals/inner/coulomb_torque_N_m", "1e-4"}, {"/gimbals/inner/regularisation_rad_s", "0"}},
     "/gimbals/inner/regularisation_rad_s",
     "above 0"},
    {{{"/gimbals/outer/torsion_rest_deg", "5"}}, "/gimbals/outer/torsion_rest_deg", "torsion_N_m_rad"},
    {{{"/gimbals/outer/torsion_N_m_rad", "-1"}}, "/gimbals/outer/torsion_N_m_rad", "from 0"},
    {{{"/gimbals/inner", R"({"locked": true, "viscous_torque_N_m_s": 1e-5})"}},
     "/gimbals/inner/viscous_torque_N_m_s",
     "locked"},
    {{{"/gimbals/inner", R"({"locked": true, "torsion_N_m_rad": 1})"}}, "/gimbals/inner/torsion_N_m_rad", "locked"},
    {{{"/gimbals/outer/locked", "true"}, {"/gimbals/inner/locked", "true"}}, "/gimbals/inner/locked", "both gimbals"},
    {{{"/gimbals/inner/locked", "true"}, {"/release/inner_rate_rad_s", "1"}}, "/release/inner_rate_rad_s", "locked"},
    {{{"/gimbals/outer/locked", "true"}, {"/release/outer_rate_rad_s", "1"}}, "/release/outer_rate_rad_s", "locked"},
    {{{"/gimbals/outer/inertia/about", "\"axis\""}}, "/gimbals/outer/inertia/about", "pivot"},
    {{{"/gimbals/middle", "{}"}}, "/gimbals/middle", "unknown"},
    {{{"/release", R"({"outer_angle_deg": 20})"}}, "/release/inner_angle_deg", "missing"},
    {{{"/release", R"({"inner_angle_deg": 20})"}}, "/release/outer_angle_deg", "missing"},
    {{{"/release/tilt_deg", "20"}}, "/release/tilt_deg", "outer_angle_deg"},
    {{{"/release/quaternion_LB", R"({"w": 1, "x": 0, "y": 0, "z": 0})"}},
     "/release/quaternion_LB",
     "belongs to a body on a pivot"},
    {{{"/release/spin_rad_s", "20"}}, "/release/spin_rad_s", "belongs to a body on a pivot"},
    {{{"/release/spin_rpm", "20"}}, "/release/spin_rpm", "belongs to a body on a pivot"},
    {{{"/release/precession", "\"steady_slow\""}}, "/release/precession", "belongs to a body on a pivot"},
    {{{"/release/angular_velocity_body_rad_s", "[0, 0, 1]"}},
     "/release/angular_velocity_body_rad_s",
     "belongs to a body on a pivot"},
    {{{"/release/outer_angle_deg", "\"north\""}}, "/release/outer_angle_deg", "number"},
    {{{"/effects", R"({"viscous_torque_N_m_s": 1e-6})"}}, "/effects/viscous_torque_N_m_s", "bearings"},
    {{{"/effects", R"({"quadratic_torque_N_m_s2": 1e-6})"}}, "/effects/quadratic_torque_N_m_s2", "bearings"},
    {{{"/effects", R"({"coulomb_torque_N_m": 1e-6})"}}, "/effects/coulomb_torque_N_m", "bearings"},
    {{{"/effects", R"({"air_drag": {"disc_radius_m": 0.05}})"}}, "/effects/air_drag", "disc"},
    {{{"/effects", R"({"gimbal": true})"}}, "/effects/gimbal", "rigid wheel"},
    {{{"/effects", R"({"centrifugal": false})"}}, "/effects/centrifugal", "belong to all three"},
    {{{"/effects", R"({"coriolis": false})"}}, "/effects/coriolis", "belong to all three"},
    {{{"/numerics", R"({"observer": "body"})"}}, "/numerics/observer", "laboratory"},
    {{{"/numerics", R"({"method": "splitting"})"}}, "/numerics/method", "gimbals"},
    {{{"/numerics", R"({"method": "long_horizon"})"}}, "/numerics/method", "gimbals"},
    {{{"/numerics", R"({"method": "closed_form"})"}}, "/numerics/method", "gimbals"},
    {{{"/numerics", R"({"method": "dop853"})"}}, "/numerics/method", "taylor"},
    {{{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}}, "/gimbals", "/contact"},
    {{{"/gimbals", "{}"}, {"/release/inner_angle_deg", "0"}, {"/body/inertia/principal_kg_m2", "[1e-4, 1e-4, 0]"}},
     "/release/inner_angle_deg",
     "gimbal_lock"},
    {{{"/uncertainty", R"({"tilt_deg": 0.1})"}}, "/uncertainty/tilt_deg", "no such number"},
    {{{"/uncertainty", R"({"outer_torsion_N_m_rad": 0.1})"}}, "/uncertainty/outer_torsion_N_m_rad", "no such number"},
};

TEST(GimbalRules, BadInputIsRefusedWithPlaceAndRemedy) {
  for (const testing::Refusal& refusal : kRefusals) testing::expect_refused({"gimbals.json", kScene}, refusal);
}

// Without gimbals their angles are no release, and masses have no outer gimbal to ride on.
TEST(GimbalRules, AnglesBelongToGimbals) {
  const Overrides changes[] = {
      {{"/release/tilt_deg", "20"}},
      {{"/moving_masses", R"([{"mass_kg": 0.01, "carrier": "outer", "motion": "fixed", "center_m": [0, 0, 0]}])"}}};
  std::string text = kScene;
  const std::size_t at = text.find("  \"gimbals\""), end = text.find('\n', at);
  text.erase(at, end - at + 1);
  for (const Overrides& change : changes) EXPECT_THROW(parse_scene({"pivot.json", text}, change), ScenarioError);
}

// A study may begin at a coefficient of 0; what belongs to it is then forgotten.
TEST(GimbalRules, CoefficientMayBeZero) {
  const BearingSpec spring =
      parse_scene({"gimbals.json", kScene}, {{"/gimbals/outer/torsion_N_m_rad", "0"}, {"/gimbals/outer/torsion_rest_deg", "5"}})
          .scenario()
          .gimbals->outer;
  EXPECT_EQ(spring.torsion_rest_deg, 0);
  const BearingSpec friction = parse_scene({"gimbals.json", kScene}, {{"/gimbals/inner/coulomb_torque_N_m", "0"},
                                                                      {"/gimbals/inner/regularisation_rad_s", "0.1"}})
                                   .scenario()
                                   .gimbals->inner;
  EXPECT_EQ(friction.regularisation_rad_s, 0);
}

}  // namespace
}  // namespace earthtop
