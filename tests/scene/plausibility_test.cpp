// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings: values that look like a mistake of units are reported, and sensible ones are not.
#include <gtest/gtest.h>

#include <filesystem>

#include "scenario/support.hpp"

namespace earthtop::scenario_test {
namespace {

/// Expects a single warning at "line:column pointer", whose message contains the part, and no error.
void expect_warning(const Overrides& overrides, const std::string& pointer, const std::string& part) {
  const ScenarioReport report = examine_scenario({"minimal.json", kMinimal}, overrides);
  EXPECT_TRUE(report.scenario.has_value()) << part;
  ASSERT_EQ(report.warnings.size(), 1U) << part << (report.warnings.empty() ? "" : "\n" + report.warnings[0].message);
  EXPECT_EQ(report.warnings[0].pointer, pointer);
  EXPECT_NE(report.warnings[0].message.find(part), std::string::npos) << report.warnings[0].message;
}

void expect_no_warning(const Overrides& overrides) {
  const ScenarioReport report = examine_scenario({"minimal.json", kMinimal}, overrides);
  EXPECT_TRUE(report.scenario.has_value());
  for (const Diagnostic& warning : report.warnings) ADD_FAILURE() << warning.pointer << ": " << warning.message;
}

TEST(Plausibility, GravityOfAnotherPlanetOnTheEarth) {
  expect_warning({{"/site/gravity_m_s2", "9.75"}}, "/site/gravity_m_s2", "between 9.76 and 9.84");
  expect_warning({{"/site/gravity_m_s2", "9.85"}}, "/site/gravity_m_s2", "leave it out");
  expect_warning({{"/site/gravity_m_s2", "981"}}, "/site/gravity_m_s2", "not found on the Earth");
  expect_warning({{"/site/gravity_m_s2", "9.81"}, {"/site/height_m", "100000"}}, "/site/gravity_m_s2", "at this height");
  for (const std::string gravity : {"9.76", "9.80665", "9.84"}) expect_no_warning({{"/site/gravity_m_s2", gravity}});
  expect_no_warning({{"/site/gravity_m_s2", "9.5"}, {"/site/height_m", "100000"}});
  // Values that do not belong to the Earth, and a body on which gravity has no torque.
  expect_no_warning({{"/site/gravity_m_s2", "1.6"}, {"/earth/rotation_rate_rad_s", "2.66e-6"}});
  expect_no_warning({{"/site/gravity_m_s2", "3.71"}, {"/earth/rotation_rate_rad_s", "7.088e-5"}});
  expect_no_warning({{"/site/gravity_m_s2", "0"}});
  expect_no_warning({{"/site/gravity_m_s2", "0"}, {"/body/center_of_mass_m", "[0, 0, 0]"}});
}

TEST(Plausibility, RadiansForDegrees) {
  expect_warning({{"/site/latitude_deg", "0.7853981634"}}, "/site/latitude_deg", "45 degrees in radians");
  expect_warning({{"/site/latitude_deg", "-0.9"}}, "/site/latitude_deg", "if these are radians, write -51.5");
  expect_warning({{"/release/tilt_deg", "0.5235987756"}}, "/release/tilt_deg", "30 degrees in radians");
  expect_warning({{"/release/azimuth_deg", "3.14159265"}}, "/release/azimuth_deg", "180 degrees in radians");
  for (const std::string latitude : {"0", "2", "-1.6", "90"}) expect_no_warning({{"/site/latitude_deg", latitude}});
  for (const std::string tilt : {"0", "0.001", "0.5", "1", "1.5", "3"}) expect_no_warning({{"/release/tilt_deg", tilt}});
}

TEST(Plausibility, GramsMillimetresAndRevolutions) {
  expect_warning({{"/body", R"({"mass_kg": 100, "center_of_mass_m": [0, 0, 0.03],
                    "inertia": {"about": "center_of_mass", "principal_kg_m2": [1.1e-4, 1.1e-4, 4e-5]}})"}},
                 "/body/inertia", "grams");
  expect_warning({{"/body", R"({"mass_kg": 0.1, "center_of_mass_m": [0, 0, 30],
                    "inertia": {"about": "center_of_mass", "principal_kg_m2": [1.1e-4, 1.1e-4, 4e-5]}})"}},
                 "/body/center_of_mass_m", "millimetres");
  expect_warning({{"/body", R"({"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                    "inertia": {"about": "center_of_mass", "principal_kg_m2": [110, 110, 40]}})"},
                  {"/release/spin_rad_s", "1"}},
                 "/body/inertia", "thinner than air");
  expect_warning({{"/body", R"({"solids": [{"shape": "disc", "radius_m": 0.05, "length_m": 0.01, "density_kg_m3": 7.8}]})"}},
                 "/body/solids/0/density_kg_m3", "write 7800");
  expect_warning({{"/body", R"({"mass_kg": 100, "center_of_mass_m": [0, 0, 0.03],
                    "inertia": {"about": "center_of_mass", "principal_kg_m2": [0.11, 0.11, 0.04]}})"}},
                 "/body/inertia", "denser than any matter");
  expect_warning({{"/body", R"({"mass_kg": 0.1, "center_of_mass_m": [0, 0, 3],
                    "inertia": {"about": "center_of_mass", "principal_kg_m2": [1.1e-4, 1.1e-4, 4e-5]}})"}},
                 "/body/center_of_mass_m", "millimetres");
  expect_no_warning({{"/body/mass_kg", "5e-324"}, {"/body/center_of_mass_m", "[0, 0, 0]"}});
  expect_warning({{"/release/spin_rad_s", "200000"}}, "/body/inertia", "revolutions per minute");
  expect_no_warning(
      {{"/body", R"({"solids": [{"shape": "disc", "radius_m": 0.05, "length_m": 0.01, "density_kg_m3": 7800}]})"}});
  // Mass, lever and moments together in grams and millimetres: a body of a reasonable density, which spins far out on its lever.
  const auto all_wrong = [](const std::string& about) {
    return R"({"mass_kg": 100, "center_of_mass_m": [0, 0, 30], "inertia": {"about": "center_of_mass", "principal_kg_m2": )" +
           about + "}}";
  };
  expect_warning({{"/body", all_wrong("[30, 30, 40]")}}, "/body/center_of_mass_m",
                 "the centre of mass is 30 m from the pivot, 42.4 times the radius of gyration; are these millimetres?");
  expect_warning({{"/body", all_wrong("[30, 30, 30]")}}, "/body/center_of_mass_m", "are these millimetres?");
  expect_warning({{"/body", all_wrong("[30, 30, 40]")},
                  {"/release/spin_rad_s", "0"},
                  {"/release/precession", R"("none")"},
                  {"/release/spin_rad_s", "-50"}},
                 "/body/center_of_mass_m", "are these millimetres?");
  // The same body without a spin is a pendulum; so it is with the slow turn of the laboratory, and a long lever with a wide body.
  expect_no_warning({{"/body", all_wrong("[30, 30, 40]")}, {"/release/spin_rad_s", "0"}});
  expect_no_warning({{"/body", all_wrong("[30, 30, 40]")}, {"/release/spin_rad_s", "0.5"}});
  expect_no_warning({{"/body", all_wrong("[300, 300, 400]")}, {"/release/spin_rad_s", "20"}});
  // These mistakes cannot be noticed, as the manual says.
  expect_no_warning({{"/release/tilt_deg", "0.35"}});
  expect_no_warning({{"/release/spin_rad_s", "3000"}});
  expect_no_warning({{"/release/spin_rpm", "40"}});
  // A point bob on a long wire, and a steel flywheel at its limit.
  expect_no_warning({{"/body", R"({"mass_kg": 28, "center_of_mass_m": [0, 0, -67],
                       "inertia": {"about": "center_of_mass", "principal_kg_m2": [0.08, 0.08, 0.08]}})"},
                     {"/release/spin_rad_s", "0"}});
  expect_no_warning({{"/release/spin_rad_s", "10000"}});
}

TEST(Plausibility, EarthRateInDegreesAnHour) {
  expect_warning({{"/earth/rotation_rate_rad_s", "15.041"}}, "/earth/rotation_rate_rad_s", "degrees per hour");
  expect_warning({{"/earth/rotation_rate_rad_s", "4.178e-3"}}, "/earth/rotation_rate_rad_s", "degrees per second");
  expect_no_warning({{"/earth/rotation_rate_rad_s", "14"}, {"/motion/duration_s", "1"}});
}

TEST(Plausibility, ShippedScenariosAreAboveSuspicion) {
  for (const auto& entry : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS)) {
    if (entry.path().extension() != ".json") continue;
    const ScenarioReport report = examine_scenario(read_scenario_source(entry.path()));
    EXPECT_TRUE(report.scenario.has_value()) << entry.path();
    for (const Diagnostic& warning : report.warnings)
      ADD_FAILURE() << format_diagnostic(entry.path().string(), warning, "warning");
  }
}

}  // namespace
}  // namespace earthtop::scenario_test
