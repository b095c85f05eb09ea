// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs that change several of a scenario's numbers together change what they name, and nothing else.
#include "measure/estimated_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "earthtop/frames/earth.hpp"
#include "earthtop/model/body.hpp"

namespace earthtop {
namespace {

constexpr double kEarthRate = 7.292115e-5;  // rad/s
constexpr double kDegreeRad = std::numbers::pi / 180;

const ScenarioSource kTop{"", R"({"site": {"latitude_deg": 30}, "motion": {"duration_s": 1},
  "body": {"mass_kg": 1, "center_of_mass_m": [0, 0, 0.1], "inertia": {"principal_kg_m2": [0.02, 0.02, 0.01]}},
  "release": {"tilt_deg": 20, "spin_rad_s": 100}})"};

Vec3<double> rate_L(const Scene& scene) { return scene.rotation_rate_rad_s() * celestial_axis_L<double>(scene.site()); }

TEST(EstimatedInputs, TheTwoComponentsOfTheEarthsRate) {
  const Scene base = parse_scene(kTop);
  const double north = kEarthRate * std::cos(30 * kDegreeRad), up = kEarthRate / 2;
  const auto varied = [&](const std::vector<std::string>& names, const std::vector<double>& values) {
    const measure::EstimatedInputs inputs(kTop, {}, base, names);
    const auto scene = inputs.scene(values);
    if (!scene) throw std::runtime_error("no scene");
    EXPECT_EQ(scene->site().gravity_m_s2, base.site().gravity_m_s2);
    EXPECT_LE(std::abs(scene->site().latitude_deg), 90);
    return rate_L(*scene);
  };
  const measure::EstimatedInputs northward(kTop, {}, base, {"omega_cos_latitude_rad_s"});
  EXPECT_NEAR(northward.list()[0].start, north, 1e-15 * kEarthRate);
  EXPECT_EQ(northward.list()[0].unit, "rad/s");
  const double slack = 1e-15 * kEarthRate;
  for (const double value : {0.9 * kEarthRate, -0.2 * kEarthRate, 0.0}) {  // beyond the pole, too, and at it
    const Vec3<double> rate = varied({"omega_cos_latitude_rad_s"}, {value});
    EXPECT_NEAR(rate[1], value, slack);
    EXPECT_NEAR(rate[2], up, slack);
    const Vec3<double> vertical = varied({"omega_sin_latitude_rad_s"}, {value});
    EXPECT_NEAR(vertical[1], north, slack);
    EXPECT_NEAR(vertical[2], value, slack);
  }
  for (const bool up_first : {false, true}) {
    const Vec3<double> rate = up_first ? varied({"omega_sin_latitude_rad_s", "omega_cos_latitude_rad_s"}, {2e-5, 3e-5})
                                       : varied({"omega_cos_latitude_rad_s", "omega_sin_latitude_rad_s"}, {3e-5, 2e-5});
    EXPECT_NEAR(rate[1], 3e-5, slack);
    EXPECT_NEAR(rate[2], 2e-5, slack);
  }
}

TEST(EstimatedInputs, TheComponentsStandForRateAndLatitude) {
  const Scene base = parse_scene(kTop);
  for (const char* component : {"omega_sin_latitude_rad_s", "omega_cos_latitude_rad_s"})
    for (const char* other : {"latitude_deg", "rotation_rate_rad_s", "/site/latitude_deg"}) {
      const auto both = [&] { measure::EstimatedInputs(kTop, {}, base, {component, other}); };
      EXPECT_THROW(both(), ScenarioError) << component << ' ' << other;
    }
  const auto twice = [&] {
    measure::EstimatedInputs(kTop, {}, base, {"omega_cos_latitude_rad_s", "omega_cos_latitude_rad_s"});
  };
  EXPECT_THROW(twice(), ScenarioError);
}

TEST(EstimatedInputs, InertiaRatioAndCenterOfMass) {
  const Scene base = parse_scene(kTop);
  const measure::EstimatedInputs inputs(kTop, {}, base, {"inertia_ratio", "center_of_mass_m", "/body/mass_kg"});
  EXPECT_EQ(inputs.list()[0].start, 0.5);
  EXPECT_EQ(inputs.list()[1].start, 0.1);
  const auto scene = inputs.scene({0.6, 0.11, 0.8});
  ASSERT_TRUE(scene);
  const Body<double>& body = scene->body<double>();
  EXPECT_EQ(body.mass, 0.8);
  EXPECT_NEAR(body.p_PBcm_B[2], 0.11, 1e-16);
  EXPECT_EQ(body.I_BP_B(0, 0), 0.02);
  EXPECT_EQ(body.I_BP_B(1, 1), 0.02);
  EXPECT_NEAR(body.I_BP_B(2, 2), 0.012, 1e-17);
  EXPECT_EQ(scene->symmetry_axis(), 2);
  EXPECT_FALSE(inputs.scene({2.1, 0.1, 1})) << "no body has I3 above I1 + I2";
  // From solids, whose moments are computed.
  const Overrides solids = {{"/body", R"({"solids": [{"shape": "disc", "radius_m": 0.05, "mass_kg": 0.2, "at_m": 0.03}]})"}};
  const Scene disc = parse_scene(kTop, solids);
  const measure::EstimatedInputs of_disc(kTop, solids, disc, {"center_of_mass_m"});
  const auto moved = of_disc.scene({0.029});
  ASSERT_TRUE(moved);
  EXPECT_NEAR(moved->body<double>().p_PBcm_B[2], 0.029, 1e-16);
  EXPECT_EQ(moved->body<double>().I_BP_B(0, 0), disc.body<double>().I_BP_B(0, 0));
}

}  // namespace
}  // namespace earthtop
