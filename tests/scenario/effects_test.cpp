// SPDX-License-Identifier: GPL-3.0-or-later
// Effects that a scene cannot have, or not together, are refused at their place, with a remedy.
#include <gtest/gtest.h>

#include "earthtop/scene/scene.hpp"

namespace earthtop {
namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

ScenarioReport examine(const Overrides& overrides) {
  return examine_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/toy-top.json"), overrides);
}

const std::pair<std::string, std::string> kLevel{"/release/tilt_deg", "90"};

TEST(EffectRefusals, EachStandsWhereItIsWrong) {
  struct Case {
    Overrides overrides;
    std::string pointer, says;
  };
  const std::string platform = R"({"motion": "constant", "axis": [0, 0, 1], "rate_rad_s": 0.1})";
  const std::string inertial = "\"inertial\"";
  const Case cases[] = {
      {{{"/effects/gimbal", "true"}}, "/effects/gimbal", "tilts it by 20 deg"},
      {{{"/effects/gimbal", "true"}, {"/release/tilt_deg", "90.0001"}}, "/effects/gimbal", "level"},
      {{{"/effects/gimbal", "true"}, kLevel, {"/platform", platform}}, "/effects/gimbal", "platform"},
      {{{"/effects/gimbal", "true"}, kLevel, {"/effects/coulomb_torque_N_m", "1e-5"}}, "/effects/coulomb_torque_N_m", "gimbal"},
      {{{"/effects/gimbal", "true"}, kLevel, {"/release/rates_relative_to", inertial}}, "/effects/gimbal", "laboratory"},
      {{{"/effects/gimbal", R"({"damping_N_m_s": -1})"}, kLevel}, "/effects/gimbal/damping_N_m_s", "range"},
      {{{"/effects/coulomb_torque_N_m", "1e-5"}, {"/platform", platform}}, "/effects/coulomb_torque_N_m", "platform"},
      {{{"/effects/coulomb_torque_N_m", "1e-5"}, {"/numerics/method", "\"dopri5\""}}, "/numerics/method", "rkf78"},
      {{{"/effects/viscous_torque_N_m_s", "-1e-5"}}, "/effects/viscous_torque_N_m_s", "range"},
      {{{"/effects/tide", "true"}}, "/effects/tide", "/motion/start_utc"},
      {{{"/effects/tide", R"({"amplitude_m_s2": [0, 0, 1e-6]})"}}, "/effects/tide/frequency_hz", ""},
      {{{"/effects/tide", R"({"phase_deg": 3})"}, {"/motion/start_utc", "\"2026-11-22T12:00:00Z\""}},
       "/effects/tide/phase_deg",
       "amplitude_m_s2"},
      {{{"/effects/polar_motion", "true"}}, "/effects/polar_motion", "/motion/start_utc"},
      {{{"/effects/polar_motion", R"({"x_arcsec": 0.1})"}}, "/effects/polar_motion/y_arcsec", ""},
      {{{"/motion/start_utc", "\"22.11.2026\""}}, "/motion/start_utc", "YYYY-MM-DD"},
      {{{"/effects/air_drag", "{}"}}, "/effects/air_drag/disc_radius_m", ""},
      {{{"/effects/gravity_gradient", "{}"}}, "/effects/gravity_gradient/gm_over_r3_s2", ""},
      {{{"/effects/gravity_gradient", "\"norml\""}}, "/effects/gravity_gradient", "normal"},
      {{{"/effects/select", "\"auto\""}}, "/effects/select", "/accuracy/drift_rad"},
      {{{"/effects", "\"auto\""}}, "/effects", "/accuracy/drift_rad"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.overrides.front().first + " " + c.pointer + " " + c.says);
    const ScenarioReport report = examine(c.overrides);
    EXPECT_FALSE(report.scenario);
    ASSERT_EQ(report.errors.size(), 1U);
    EXPECT_EQ(report.errors[0].pointer, c.pointer);
    EXPECT_NE(report.errors[0].message.find(c.says), std::string::npos) << report.errors[0].message;
  }
}

TEST(EffectRefusals, AGimbalTakesNoRateThatLeavesTheLevel) {
  ScenarioSource source = read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/toy-top.json");
  const std::string spin = "\"spin_rad_s\": 200";
  const std::size_t at = source.text.find(spin);
  ASSERT_NE(at, std::string::npos);
  // With the axis level and no turn about it, body axis 2 is Up's cross product with it, and -1 is Up.
  for (const auto& [rates, is_taken] : {std::pair("[0, 1, 5]", false), std::pair("[1, 0, 5]", true)}) {
    ScenarioSource changed = source;
    changed.text.replace(at, spin.size(), std::string("\"angular_velocity_body_rad_s\": ") + rates);
    const ScenarioReport report = examine_scenario(changed, {{"/effects/gimbal", "true"}, kLevel});
    EXPECT_EQ(report.scenario.has_value(), is_taken) << rates;
    if (is_taken) continue;
    ASSERT_EQ(report.errors.size(), 1U);
    EXPECT_EQ(report.errors[0].pointer, "/effects/gimbal");
    EXPECT_NE(report.errors[0].message.find("out of the level at 1 rad/s"), std::string::npos) << report.errors[0].message;
  }
}

TEST(EffectRefusals, MethodsOfPlainScenesRefuseEveryEffect) {
  const Overrides effects = {
      {"/effects/viscous_torque_N_m_s", "1e-9"},
      {"/effects/gravity_gradient", "true"},
      {"/effects/coulomb_torque_N_m", "1e-9"},
      {"/effects/tide", R"({"amplitude_m_s2": [0, 0, 1e-6], "frequency_hz": 1})"},
      {"/effects/air_drag", R"({"disc_radius_m": 0.1})"},
  };
  for (const auto* method : {"\"splitting\"", "\"long_horizon\"", "\"closed_form\""})
    for (const auto& effect : effects) {
      SCOPED_TRACE(std::string(method) + " " + effect.first);
      const ScenarioReport report = examine({effect, {"/numerics/method", method}, {"/earth/rotation_rate_rad_s", "0"}});
      ASSERT_EQ(report.errors.size(), 1U);
      EXPECT_EQ(report.errors[0].pointer, "/numerics/method");
    }
}

// A series needs friction without a corner: on a top that spins on, and on no pendulum.
TEST(EffectRefusals, SeriesTakeEffectsThatBrakeNoRateToZero) {
  const auto errors = [](const char* pointer, const char* value, const char* spin) {
    return examine({{pointer, value}, {"/numerics/method", "\"taylor\""}, {"/release/spin_rad_s", spin}}).errors.size();
  };
  for (const auto& [pointer, value] : {std::pair{"/effects/viscous_torque_N_m_s", "1e-9"},
                                       {"/effects/gravity_gradient", "true"},
                                       {"/platform", R"({"motion": "ramp", "acceleration_rad_s2": 0.1})"}}) {
    EXPECT_EQ(errors(pointer, value, "200"), 0u) << pointer;
    EXPECT_EQ(errors(pointer, value, "0"), 0u) << pointer;
  }
  for (const auto& [pointer, value] : {std::pair{"/effects/coulomb_torque_N_m", "1e-9"},
                                       {"/effects/quadratic_torque_N_m_s2", "1e-11"},
                                       {"/effects/air_drag", R"({"disc_radius_m": 0.03})"}}) {
    EXPECT_EQ(errors(pointer, value, "200"), 0u) << pointer;
    EXPECT_EQ(errors(pointer, value, "0"), 1u) << pointer;
  }
  EXPECT_EQ(errors("/effects/coulomb_torque_N_m", "1e-3", "200"), 1u);  // it stops the top
  EXPECT_EQ(errors("/effects/air_drag", R"({"disc_radius_m": 10})", "200"), 1u);
  EXPECT_EQ(errors("/effects/coriolis", "false", "200"), 1u);
}

// Torques that leave most of the spin one by one may stop the top together: with k / I3 = a and T / I3 = d the spin is
// (w0 + d/a) exp(-a t) - d/a, here 0 after 43 s of the 60 s.
TEST(EffectRefusals, SeriesTakeDryFrictionByWhatAllFrictionLeaves) {
  const auto is_taken = [](const char* dry, const char* viscous) {
    return examine({{"/effects/coulomb_torque_N_m", dry},
                    {"/effects/viscous_torque_N_m_s", viscous},
                    {"/numerics/method", "\"taylor\""}})
        .errors.empty();
  };
  EXPECT_TRUE(is_taken("5e-5", "0"));
  EXPECT_TRUE(is_taken("0", "2e-6"));
  EXPECT_FALSE(is_taken("5e-5", "2e-6"));
  EXPECT_TRUE(is_taken("5e-6", "1e-7"));
}

// A disc or quadratic drag brakes the spin relative to the platform to zero.
TEST(EffectRefusals, SeriesTakeDragOnATopThatOutrunsItsPlatform) {
  const auto is_taken = [](const char* drag, const std::string& platform_rate) {
    return examine({{"/effects/quadratic_torque_N_m_s2", drag},
                    {"/platform", R"({"motion": "constant", "axis": [0, 0, 1], "rate_rad_s": )" + platform_rate + "}"},
                    {"/numerics/method", "\"taylor\""}})
        .errors.empty();
  };
  EXPECT_TRUE(is_taken("1e-11", "0.1"));
  EXPECT_TRUE(is_taken("1e-11", "50"));
  EXPECT_FALSE(is_taken("1e-11", "200"));   // the turntable goes round with the top
  EXPECT_FALSE(is_taken("1e-11", "-200"));  // or against it, which the rule does not tell apart
  EXPECT_TRUE(is_taken("5e-9", "1"));
  EXPECT_FALSE(is_taken("5e-9", "50"));  // the drag brakes the top to the rate of the turntable
}

TEST(EffectRefusals, TheSameScenesWithWhatIsMissingAreTaken) {
  const std::pair<std::string, std::string> date{"/motion/start_utc", "\"2026-11-22T12:00:00Z\""};
  const Overrides taken[] = {
      {{"/effects/gimbal", "true"}, kLevel, {"/effects/viscous_torque_N_m_s", "1e-6"}},
      {{"/effects/gimbal", R"({"damping_N_m_s": 1e-5})"}, kLevel},
      {{"/effects/coulomb_torque_N_m", "1e-5"}, {"/numerics/method", "\"extrapolation\""}},
      {{"/effects/tide", "true"}, date},
      {{"/effects/polar_motion", "true"}, date},
      {{"/effects", "\"auto\""}, {"/accuracy/drift_rad", "1e-9"}},
      {{"/effects/select", "\"auto\""}, {"/effects/viscous_torque_N_m_s", "1e-6"}, {"/accuracy/drift_rad", "1e-9"}},
      {{"/effects/gravity_gradient", R"({"gm_over_r3_s2": 1.5e-6})"}},
  };
  for (const Overrides& overrides : taken) {
    SCOPED_TRACE(overrides.front().first);
    const ScenarioReport report = examine(overrides);
    EXPECT_TRUE(report.scenario);
    for (const Diagnostic& error : report.errors) ADD_FAILURE() << error.pointer << " " << error.message;
  }
}

}  // namespace
}  // namespace earthtop
