// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that is generated from the table of fields: annotated scenarios, the Markdown table, the pointers for --set.
#include "earthtop/scenario/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "earthtop/compare/compare.hpp"
#include "earthtop/study/study.hpp"
#include "support.hpp"

namespace earthtop::scenario_test {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void expect_annotation_changes_nothing(const ScenarioSource& source) {
  const std::string annotated = annotated_scenario(source);
  EXPECT_EQ(identity_json(parse_scenario({source.file, annotated})), identity_json(parse_scenario(source))) << annotated;
  EXPECT_EQ(annotated_scenario({source.file, annotated}), annotated) << "annotated again";
}

TEST(ScenarioReference, AnnotationChangesNothing) {
  for (const auto& entry : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS))
    if (entry.path().extension() == ".json") expect_annotation_changes_nothing(read_scenario_source(entry.path()));
  const auto with = [](const std::string& what, const std::string& instead) {
    return ScenarioSource{"minimal.json", replaced(kMinimal, what, instead)};
  };
  expect_annotation_changes_nothing({"minimal.json", kMinimal});
  expect_annotation_changes_nothing(
      with("\"tilt_deg\": 20, \"spin_rad_s\": 200",
           R"("quaternion_LB": {"w": 0, "x": 1, "y": 0, "z": 0}, "angular_velocity_body_rad_s": [1, 2, 3])"));
  expect_annotation_changes_nothing(with("\"spin_rad_s\": 200", R"("spin_rad_s": 200, "precession": {"rate_rad_s": 1})"));
  expect_annotation_changes_nothing(with("{\"site\"", R"({"numerics": {"method": "abm8", "step_s": 1e-3}, "site")"));
  for (const char* motion : {R"("constant", "rate_rad_s": 1)", R"("ramp", "acceleration_rad_s2": 1)",
                             R"("harmonic", "amplitude_rad": 1, "frequency_hz": 1)"})
    expect_annotation_changes_nothing(with("{\"site\"", std::string(R"({"platform": {"motion": )") + motion + R"(}, "site")"));
}

TEST(ScenarioReference, EveryValueIsExplained) {
  const std::string annotated = annotated_scenario({"minimal.json", kMinimal});
  EXPECT_NE(annotated.find("\"_latitude_deg\": \"geodetic latitude"), std::string::npos);
  EXPECT_NE(annotated.find("\"rotation_rate_rad_s\": 7.292115e-05"), std::string::npos) << "a default is filled in";
  EXPECT_NE(annotated.find("\"center_of_mass_m\": [0, 0, 0.03]"), std::string::npos) << "on one line";
}

TEST(ScenarioReference, EveryPointerCanBeSet) {
  const auto pointers = scenario_pointers();
  EXPECT_GT(pointers.size(), 50U);
  for (const std::string& pointer : pointers) {
    const Found found = found_in(kMinimal, {{pointer, "null"}});
    ASSERT_FALSE(found.places.empty()) << pointer;
    for (const std::string& message : found.messages) EXPECT_EQ(message.find("unknown key"), std::string::npos) << pointer;
  }
}

TEST(ScenarioReference, ManualsHoldTheTables) {
  const std::filesystem::path scenarios = EARTHTOP_SCENARIOS;
  EXPECT_NE(text_of(scenarios / "README.md").find(scenario_reference_markdown()), std::string::npos)
      << "put the output of `earthtop schema --markdown` into scenarios/README.md";
  const std::string tools_manual = text_of(scenarios / ".." / "tools" / "README.md");
  EXPECT_NE(tools_manual.find(study_reference_markdown()), std::string::npos)
      << "put the output of `earthtop schema --study --markdown` into tools/README.md";
  EXPECT_NE(tools_manual.find(mapping_reference_markdown()), std::string::npos)
      << "put the output of `earthtop schema --mapping --markdown` into tools/README.md";
  EXPECT_NE(tools_manual.find(tolerances_reference_markdown()), std::string::npos)
      << "put the output of `earthtop schema --tolerances --markdown` into tools/README.md";
}

TEST(ScenarioReference, AKeyIsNamedInAnyOfFourWays) {
  for (const char* key : {"latitude_deg", "site.latitude_deg", "site/latitude_deg", "/site/latitude_deg"})
    EXPECT_EQ(scenario_pointer(key), "/site/latitude_deg") << key;
  EXPECT_EQ(scenario_pointer("mass_kg"), "/body/mass_kg") << "and not the rotor's or a gimbal's";
  EXPECT_EQ(scenario_pointer("tilt_deg"), "/release/tilt_deg") << "and not the table's";
  EXPECT_EQ(scenario_pointer("numerics"), "/numerics");
  EXPECT_EQ(scenario_pointer("moving_masses.0.mass_kg"), "/moving_masses/0/mass_kg");
  EXPECT_EQ(scenario_pointer("axial_kg_m2"), "/rotor/axial_kg_m2") << "which no other section has";
  EXPECT_EQ(scenario_pointer("/no/such/key"), "/no/such/key") << "a pointer is not examined";
  for (const char* key : {"locked", "latitude", "", "nonsense"}) EXPECT_THROW(scenario_pointer(key), ScenarioError) << key;
}

// Every key that can be set is found by its pointer's steps with dots, and by its bare name where that is said to be enough.
TEST(ScenarioReference, EveryPointerIsItsOwnDottedName) {
  for (const std::string& pointer : scenario_pointers()) {
    std::string dotted = pointer.substr(1);
    std::replace(dotted.begin(), dotted.end(), '/', '.');
    if (dotted.find('.') != dotted.npos) EXPECT_EQ(scenario_pointer(dotted), pointer);
  }
}

}  // namespace
}  // namespace earthtop::scenario_test
