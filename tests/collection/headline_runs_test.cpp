// SPDX-License-Identifier: GPL-3.0-or-later
/// Every shipped scenario meets its headline figure, and would not if the program were wrong about the Earth's rotation.

#include <gtest/gtest.h>

#include <set>

#include "collection/shipped.hpp"
#include "earthtop/results/headline.hpp"
#include "results/columns.hpp"
#include "support/headlines.hpp"

namespace earthtop {
namespace {

using testing::parse_file;
using testing::shipped_files;

/// This scenario takes a quarter of a minute, most of the computing time of the collection.
constexpr const char* kLongest = "fast-gyro";

/// Compares all drifts at the headline's time with the values of the reference program, within the bounds that the run states.
void expect_generated_drifts(const RunResult& result) {
  const testing::GeneratedValues generated = testing::generated_values(result.scene.scenario().name);
  const auto row = std::find_if(result.rows.begin(), result.rows.end(),
                                [&](const DriftRow& r) { return std::abs(r.t_s - generated.at_s) < 1e-9; });
  ASSERT_NE(row, result.rows.end());
  EXPECT_LE(std::abs(row->drift_axis_rad - generated.at("drift_axis_rad")), row->drift_axis_bound_rad);
  EXPECT_LE(std::abs(row->drift_attitude_rad - generated.at("drift_attitude_rad")), row->drift_attitude_bound_rad);
  if (row->contact) {
    const auto& contact = *row->contact;
    EXPECT_LE(std::abs(contact.drift_tip_m - generated.at("drift_tip_m")), contact.drift_tip_bound_m);
    // The bound is one of the error's length; each component's error is below it.
    EXPECT_LE(std::abs(contact.drift_tip_xy_m[0] - generated.at("drift_tip_x_m")), contact.drift_tip_bound_m);
    EXPECT_LE(std::abs(contact.drift_tip_xy_m[1] - generated.at("drift_tip_y_m")), contact.drift_tip_bound_m);
  }
  if (row->rotor)
    EXPECT_LE(std::abs(row->rotor->drift_axis_rad - generated.at("drift_rotor_axis_rad")), row->rotor->drift_axis_bound_rad);
  // Azimuth, tilt and spin have no bounds of their own; the attitude's error appears in them divided by sin(tilt).
  const double sine = std::max(1e-3, std::hypot(row->axis_L[0], row->axis_L[1]));
  for (const Column& column : trajectory_columns()) {
    if (column.name != "drift_azimuth_rad" && column.name != "drift_tilt_rad" && column.name != "drift_spin_rad") continue;
    const auto& truth = generated.columns.at(std::string(column.name));
    if (!truth) continue;
    EXPECT_LE(std::abs(column.value(*row).value() - *truth), row->drift_attitude_bound_rad / sine) << column.name;
  }
}

void expect_met(const Scenario& scenario) {
  SCOPED_TRACE(scenario.name);
  const RunResult result = run(scenario);
  const auto check = check_headline(result);
  ASSERT_TRUE(check && check->computed);
  EXPECT_TRUE(check->met) << check->stated.quantity << " = " << *check->computed << ", off by " << *check->difference;
  expect_generated_drifts(result);
}

TEST(Headlines, EveryScenarioMeetsItsOwn) {
  for (const auto& file : shipped_files())
    if (file.stem() != kLongest) expect_met(parse_file(file));
}

TEST(Headlines, FastGyroMeetsItsOwn) { expect_met(parse_file(std::filesystem::path(EARTHTOP_SCENARIOS) / "fast-gyro.json")); }

bool is_met(const Scenario& scenario) { return check_headline(run(scenario))->met; }

// The results of a program without the Earth's rotation meet none of the figures of scenes that have it.
TEST(Headlines, NoneIsMetWithoutTheEarth) {
  for (const auto& file : shipped_files()) {
    Scenario scenario = parse_file(file);
    if (scenario.rotation_rate_rad_s == 0 || scenario.name == kLongest) continue;
    scenario.rotation_rate_rad_s = 0;
    EXPECT_FALSE(is_met(scenario)) << scenario.name;
  }
}

// Nor do the results of a program with the wrong sign of the rotation, except for drifts that are even in Omega, exactly or to
// first order.
TEST(Headlines, FewAreMetOnAnEarthThatTurnsBackward) {
  const std::set<std::string> even = {"free-gyro", "north-pole", "foucault-pendulum", "round-the-world"};
  for (const auto& file : shipped_files()) {
    Scenario scenario = parse_file(file);
    if (scenario.rotation_rate_rad_s == 0 || scenario.name == kLongest) continue;
    scenario.rotation_rate_rad_s *= -1;
    EXPECT_EQ(is_met(scenario), even.contains(scenario.name)) << scenario.name;
  }
}

// Nor, in the two scenes that differ by their matching rule only, the result of the other rule.
TEST(Headlines, MatchingRulesAreToldApart) {
  for (const char* name : {"matching-laboratory", "matching-inertial"}) {
    Scenario scenario = parse_file(std::filesystem::path(EARTHTOP_SCENARIOS) / (std::string(name) + ".json"));
    const bool laboratory = scenario.release.rates_relative_to == RatesRelativeTo::laboratory;
    scenario.release.rates_relative_to = laboratory ? RatesRelativeTo::inertial : RatesRelativeTo::laboratory;
    EXPECT_FALSE(is_met(scenario)) << name;
  }
}

}  // namespace
}  // namespace earthtop
