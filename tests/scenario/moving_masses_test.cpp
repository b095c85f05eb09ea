// SPDX-License-Identifier: GPL-3.0-or-later
// Refusals of masses on given paths, each with its place and what to do.
#include <fstream>

#include "support.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::scenario_test {
namespace {

constexpr const char* kResting = R"("motion": "fixed", "center_m": [0, 0, 0.1])";
constexpr const char* kSwinging =
    R"("motion": "harmonic", "center_m": [0, 0, 0.1], "amplitude_m": [0.1, 0, 0], "frequency_hz": 1)";
constexpr const char* kCircling =
    R"("motion": "circle", "center_m": [0, 0, 0.1], "start_m": [0.1, 0, 0], "axis": [0, 0, 1], "frequency_hz": 1)";
constexpr const char* kOnWay = R"("motion": "waypoints", "times_s": [0, 1], "points_m": [[0, 0, 0.1], [0.1, 0, 0]])";

std::string masses(const std::string& mass) { return "[{\"mass_kg\": 0.01, " + mass + "}]"; }

/// Expects that one mass is refused, with one finding at a key of it, or at itself.
void expect_mass(const std::string& mass, const std::string& key, const std::string& part, const Overrides& more = {}) {
  Overrides overrides{{"/moving_masses", masses(mass)}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  expect_set(overrides, "/moving_masses/0" + key, part);
}

/// Expects that a scene with a further value is refused at it, by what only the whole scene knows.
void expect_refused_scene(Overrides overrides, const std::string& pointer, const std::string& value, const std::string& part) {
  overrides.emplace_back(pointer, value);
  const ScenarioReport report = examine_scenario({"minimal.json", kMinimal}, overrides);
  ASSERT_EQ(report.error_count, 1) << pointer;
  EXPECT_EQ(report.errors.front().pointer, pointer);
  EXPECT_NE(report.errors.front().message.find(part), std::string::npos) << report.errors.front().message;
}

TEST(MovingMassRules, EachMotionIsRead) {
  for (const char* mass : {kResting, kSwinging, kCircling, kOnWay})
    EXPECT_EQ(parse(kMinimal, {{"/moving_masses", masses(mass)}}).moving_masses.size(), 1u) << mass;
}

TEST(MovingMassRules, KeysBelongToTheirMotion) {
  expect_mass(R"("motion": "fixed")", "/center_m", "is missing");
  expect_mass(R"("motion": "harmonic", "center_m": [0, 0, 0], "amplitude_m": [1, 0, 0])", "/frequency_hz", "is missing");
  expect_mass(R"("motion": "circle", "center_m": [0, 0, 0], "start_m": [1, 0, 0], "frequency_hz": 1)", "/axis", "is missing");
  expect_mass(R"("motion": "waypoints", "times_s": [0, 1])", "/points_m", "is missing");
  expect_mass(R"("motion": "table")", "/file", "is missing");
  expect_mass(std::string(kResting) + R"(, "phase_deg": 1)", "/phase_deg",
              "does not belong to the motion \"fixed\"; allowed with it: center_m");
  expect_mass(std::string(kSwinging) + R"(, "start_m": [1, 0, 0])", "/start_m", "does not belong to the motion \"harmonic\"");
  expect_mass(std::string(kOnWay) + R"(, "center_m": [1, 0, 0])", "/center_m", "does not belong to the motion \"waypoints\"");
  expect_mass(R"("center_m": [0, 0, 0])", "/motion", "is missing; must be \"fixed\", \"harmonic\"");
  expect_mass(R"("motion": "spiral")", "/motion", "is \"spiral\"; must be");
}

TEST(MovingMassRules, NumbersMakeSense) {
  expect_set({{"/moving_masses", R"([{"mass_kg": 0, "motion": "fixed", "center_m": [0, 0, 0]}])"}}, "/moving_masses/0/mass_kg",
             "must be a number above 0");
  expect_set({{"/moving_masses", R"([{"motion": "fixed", "center_m": [0, 0, 0]}])"}}, "/moving_masses/0/mass_kg", "is missing");
  expect_mass(R"("motion": "circle", "center_m": [0, 0, 0], "start_m": [1, 0, 0], "axis": [0, 0, 0], "frequency_hz": 1)",
              "/axis", "is the zero vector, or nearly; must have a direction");
  expect_mass(R"("motion": "circle", "center_m": [0, 0, 0], "start_m": [0, 0, 0], "axis": [0, 0, 1], "frequency_hz": 1)",
              "/start_m", "a circle without a radius");
  expect_mass(R"("motion": "circle", "center_m": [0, 0, 0], "start_m": [1, 0, 1e-8], "axis": [0, 0, 1], "frequency_hz": 1)",
              "/start_m", "is not perpendicular to axis: the cosine between the two is 1e-08, and may be 1e-09 at most");
  expect_mass(R"("motion": "waypoints", "times_s": [1, 0.5], "points_m": [[0, 0, 0], [1, 0, 0]])", "/times_s",
              "has 0.5 after 1; the times must ascend");
  expect_mass(R"("motion": "waypoints", "times_s": [-1, 1], "points_m": [[0, 0, 0], [1, 0, 0]])", "/times_s/0",
              "-1 is out of range");
  expect_mass(R"("motion": "waypoints", "times_s": [0], "points_m": [[0, 0, 0]])", "/times_s", "a path needs at least two");
  expect_mass(R"("motion": "waypoints", "times_s": [0, 1], "points_m": [[0, 0, 0]])", "/points_m",
              "give one point for each time");
  expect_mass(R"("motion": "waypoints", "times_s": [0, 1], "points_m": [[0, 0, 0], [1, 0]])", "/points_m/1",
              "must be an array of 1 to 1000 rows of 3 numbers");
  expect_mass(R"("motion": "waypoints", "times_s": [], "points_m": [[0, 0, 0], [1, 0, 0]])", "/times_s",
              "must be an array of 1 to 1000 numbers from 0 to 1e+09 (s)");
  expect_set({{"/criteria", R"([{"kind": "value", "quantity": "drift_axis_rad", "values": [], "tolerance": 1, "why": ""}])"}},
             "/criteria/0/values", "must be an array of 1 to 4 numbers");
  EXPECT_NO_THROW(parse(
      kMinimal,
      {{"/moving_masses",
        masses(
            R"("motion": "circle", "center_m": [0, 0, 0], "start_m": [1, 0, 1e-10], "axis": [0, 0, 1], "frequency_hz": 1)")}}));
}

TEST(MovingMassRules, AtMostSixtyFour) {
  std::string many = "[";
  for (int i = 0; i < 65; ++i) many += std::string(i > 0 ? ", " : "") + "{\"mass_kg\": 1, " + kResting + "}";
  expect_set({{"/moving_masses", many + "]"}}, "/moving_masses", "has 65 masses; at most 64 are allowed");
  expect_set({{"/moving_masses", "[]"}}, "/moving_masses", "must be an array of at least one object");
}

TEST(MovingMassRules, WhatTheyAreNotAvailableWith) {
  expect_mass(std::string(R"("carrier": "outer", )") + kResting, "/carrier",
              "there is no outer gimbal that could carry the mass");
  const Overrides with{{"/moving_masses", masses(kSwinging)}};
  const auto beside = [&](const std::string& pointer, const std::string& value, const std::string& place,
                          const std::string& part, Overrides more = {}) {
    Overrides overrides = with;
    overrides.emplace_back(pointer, value);
    overrides.insert(overrides.end(), more.begin(), more.end());
    expect_set(overrides, place, part);
  };
  beside("/effects/gimbal", "true", "/effects/gimbal", "is not available with /moving_masses: it holds a rigid wheel",
         {{"/release/tilt_deg", "90"}});
  beside("/effects/air_drag", R"({"disc_radius_m": 0.1})", "/effects/air_drag", "is not available with /moving_masses");
  beside("/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})", "/moving_masses",
         "is not available with /contact: masses that move in a top on a table are not modelled; leave one of the two out");
  for (const auto& [pointer, value, part] :
       {std::array{"/effects/coriolis", "false", "the torques of what moves in the body belong to all three"},
        std::array{"/effects/coulomb_torque_N_m", "1e-6", "dry friction at the pivot"}})
    expect_refused_scene(with, pointer, value, part);
  expect_refused_scene(with, "/release/precession", "\"steady_slow\"", "no steady precession: masses move in the body");
  expect_refused_scene(with, "/numerics/method", "\"closed_form\"", "is not available with masses that move in the body");
  expect_refused_scene(with, "/numerics/method", "\"splitting\"", "is not available with masses that move in the body");
  expect_refused_scene(with, "/numerics/method", "\"long_horizon\"", "is not available with masses that move in the body");
  expect_refused_scene(with, "/numerics/method", "\"dop853\"", "is not built for a body with moving masses");
}

TEST(MovingMassRules, TablesCoverTheRun) {
  const testing::TemporaryDirectory temporary;
  const auto errors_with = [&](const std::string& table) {
    std::ofstream(temporary.path() / "places.csv") << table;
    const ScenarioReport report = examine_scenario({(temporary.path() / "minimal.json").string(), kMinimal},
                                                   {{"/moving_masses", masses(R"("motion": "table", "file": "places.csv")")}});
    return report.errors.empty() ? std::string() : report.errors.front().pointer + " " + report.errors.front().message;
  };
  const std::string rows = "t_s,x_m,y_m,z_m\n0,0,0,0.1\n20,0.01,0,0.1\n40,0.02,0,0.1\n";
  EXPECT_EQ(errors_with(rows + "60,0,0,0.1\n"), "");
  for (const auto& [table, part] :
       {std::pair{rows + "59,0,0,0.1\n", "it must reach the duration, 60 s"}, std::pair{rows, "a spline needs at least 4"},
        std::pair{rows + "60,0,0\n", "must be 4 numbers with commas between them"},
        std::pair{rows + "60,0,nought,0.1\n", "y_m is \"nought\""}, std::pair{rows + "30,0,0,0.1\n", "times must ascend"},
        std::pair{std::string("t_s,angle_rad\n"), "must be the header \"t_s,x_m,y_m,z_m\""}})
    EXPECT_NE(errors_with(table).find(part), std::string::npos) << errors_with(table);
}

}  // namespace
}  // namespace earthtop::scenario_test
