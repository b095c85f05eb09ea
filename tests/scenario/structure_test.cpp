// SPDX-License-Identifier: GPL-3.0-or-later
// The table of fields: unknown keys, types, ranges, words, and features that are not available.
#include <cmath>

#include "input/reader.hpp"
#include "scenario/fields.hpp"
#include "support.hpp"

namespace earthtop::scenario_test {
namespace {

TEST(ScenarioFields, UnknownKeysAreNamedWithTheLikelyOne) {
  const auto spoiled = [](const std::string& good, const std::string& bad) {
    return replaced(kMinimal, "\"" + good + "\"", "\"" + bad + "\"");
  };
  expect_one(spoiled("mass_kg", "mass"), "2:11 /body/mass", "did you mean \"mass_kg\"");
  expect_one(spoiled("mass_kg", "mass_grams"), "2:11 /body/mass_grams", "did you mean \"mass_kg\"");
  expect_one(spoiled("mass_kg", "Mass_kg"), "2:11 /body/Mass_kg", "did you mean \"mass_kg\"");
  expect_one(spoiled("center_of_mass_m", "centre_of_mass_m"), "2:27 /body/centre_of_mass_m",
             "did you mean \"center_of_mass_m\"");
  expect_one(spoiled("latitude_deg", "lattitude_deg"), "1:11 /site/lattitude_deg", "did you mean \"latitude_deg\"");
  expect_one(spoiled("spin_rad_s", "spin"), "3:30 /release/spin", "did you mean \"spin_rad_s\"");
  expect_one(spoiled("duration_s", "durations"), "4:13 /motion/durations", "did you mean \"duration_s\"");
  expect_one(spoiled("motion", "motoin"), "4:2 /motoin", "did you mean \"motion\"");
  expect_one(replaced(kMinimal, "{\"site\"", "{\"gravity_m_s2\": 9.8, \"site\""), "1:2 /gravity_m_s2",
             "did you mean \"/site/gravity_m_s2\"");
  expect_one(replaced(kMinimal, "{\"site\"", "{\"qqqqqqqq\": 9.8, \"site\""), "1:2 /qqqqqqqq", "allowed here: $schema, name");
  expect_one(replaced(kMinimal, "{\"site\"", "{\"site/latitude_deg\": 9.8, \"site\""), "1:2 /site~1latitude_deg",
             "unknown key");
  expect_one(replaced(kMinimal, "{\"latitude_deg\"", "{\"$schema\": \"x\", \"latitude_deg\""), "1:11 /site/$schema",
             "unknown key");
}

TEST(ScenarioFields, QuantitiesWithoutUnitMayBeMisspelledToo) {
  expect_one(replaced(kMinimal, "\"spin_rad_s\"", "\"spinn\""), "3:30 /release/spinn", "did you mean \"spin_rad_s\"");
  expect_one(replaced(kMinimal, "\"latitude_deg\"", "\"lattitude\""), "1:11 /site/lattitude", "did you mean \"latitude_deg\"");
}

TEST(ScenarioFields, CommentsAreAllowedInEveryObject) {
  std::string text = kMinimal;
  for (const char* object : {"{\"site\"", "{\"latitude", "{\"mass", "{\"principal", "{\"tilt", "{\"duration"})
    text = replaced(text, object,
                    "{\"_note\": [null, {\"x\": 1}], \"// why\": false, \"//\": \"\", " + std::string(object).substr(1));
  EXPECT_EQ(canonical_json(parse(text)), canonical_json(parse(kMinimal)));
}

TEST(ScenarioFields, SchemaIsOptionalAndFixed) {
  EXPECT_NO_THROW(parse(kMinimal, {{"/$schema", "earthtop-scenario-1.json"}}));
  expect_set({{"/$schema", "earthtop-scenario-2.json"}}, "/$schema", "must be \"earthtop-scenario-1.json\"");
  expect_set({{"/$schema", "1"}}, "/$schema", "is 1; must be");
}

TEST(ScenarioFields, WrongTypesSayWhatIsThereAndWhatMayBe) {
  expect_one(replaced(kMinimal, "45", "\"45\""), "1:27 /site/latitude_deg", "is \"45\"; must be a number from -90 to 90 (deg)");
  expect_one(replaced(kMinimal, "45", "null"), "1:27 /site/latitude_deg", "is null");
  expect_one(replaced(kMinimal, "45", "[45]"), "1:27 /site/latitude_deg", "is an array of 1");
  expect_one(replaced(kMinimal, "{\"latitude_deg\": 45}", "45"), "1:10 /site", "must be an object");
  expect_one(replaced(kMinimal, "[0, 0, 0.03]", "[0, 0.03]"), "2:47 /body/center_of_mass_m",
             "an array of 2; must be an array of 3 numbers");
  expect_one(replaced(kMinimal, "[0, 0, 0.03]", "[0, true, 0.03]"), "2:51 /body/center_of_mass_m/1",
             "is true; must be a number");
  expect_one(replaced(kMinimal, "{\"site\"", "{\"name\": 5, \"site\""), "1:10 /name", "is 5");
  expect_one(replaced(kMinimal, "{\"site\"", "{\"effects\": {\"coriolis\": 1}, \"site\""), "1:26 /effects/coriolis",
             "is 1; must be true or false");
}

TEST(ScenarioFields, RangesHoldAtTheirEnds) {
  const struct {
    std::string pointer, inside, outside;
  } cases[] = {
      {"/site/latitude_deg", "90", "90.00000000000001"},
      {"/site/latitude_deg", "-90", "-90.00000000000001"},
      {"/site/longitude_deg", "-360", "360.1"},
      {"/site/height_m", "-12000", "-12000.1"},
      {"/site/gravity_m_s2", "0", "-1e-09"},
      {"/body/mass_kg", "1e-3", "0"},
      {"/body/mass_kg", "1e-3", "1000001"},
      {"/release/tilt_deg", "180", "180.1"},
      {"/release/tilt_deg", "0", "-0.1"},
      {"/release/azimuth_deg", "360", "361"},
      {"/release/spin_angle_deg", "-360", "-361"},
      {"/motion/duration_s", "1e-6", "0"},
      {"/motion/output_step_s", "1", "0"},
      {"/numerics/relative_tolerance", "1e-14", "9e-15"},
      {"/numerics/relative_tolerance", "0.1", "0.11"},
      {"/report/threshold_rad", "3.14", "0"},
      {"/report/threshold_rad", "3.14", "3.2"},
  };
  for (const auto& c : cases) {
    EXPECT_NO_THROW(parse(kMinimal, {{c.pointer, c.inside}})) << c.pointer << " " << c.inside;
    expect_set({{c.pointer, c.outside}}, c.pointer, c.outside + " is out of range; must be a number");
  }
  const std::string at_rest = replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rad_s\": 0");
  const Overrides slow = {{"/body/center_of_mass_m", "[0, 0, 0]"}, {"/motion/duration_s", "1e9"}};
  EXPECT_NO_THROW(parse(at_rest, slow));
  expect_set({{"/motion/duration_s", "1100000000"}}, "/motion/duration_s", "out of range");
  for (const std::string rate : {"0", "1", "-1", "1e6", "-7.292115e-5"})
    EXPECT_EQ(parse(kMinimal, {{"/earth/rotation_rate_rad_s", rate}}).rotation_rate_rad_s, std::stod(rate));
  expect_one(replaced(kMinimal, "2e-4, 2e-4", "2e-4, -2e-4"), "2:99 /body/inertia/principal_kg_m2/1", "out of range");
}

TEST(ScenarioFields, TheAttainableToleranceIsNamed) {
  expect_set({{"/numerics/relative_tolerance", "1e-16"}}, "/numerics/relative_tolerance",
             "from 1e-14 to 0.1; below 1e-14 the rounding of double precision");
  expect_set({{"/numerics/relative_tolerance", "1e-18"}, {"/numerics/precision", "long_double"}},
             "/numerics/relative_tolerance", "from 5e-18 to 0.1; below 5e-18 the rounding of long_double precision");
  expect_set({{"/numerics/relative_tolerance", "1e-33"}, {"/numerics/precision", "float128"}}, "/numerics/relative_tolerance",
             "out of range; must be a number from 1e-32 to 0.1");
}

TEST(ScenarioFields, WordsAreCheckedAndSuggested) {
  expect_set({{"/numerics/tolerance", "1e-9"}}, "/numerics/tolerance", "did you mean \"relative_tolerance\"");
  expect_set({{"/numerics/method", "dopri"}}, "/numerics/method", "did you mean \"dopri5\"");
  expect_set({{"/numerics/method", "bulirsch-stoer"}}, "/numerics/method", "did you mean \"bulirsch_stoer\"");
  expect_set({{"/numerics/observer", "lab"}}, "/numerics/observer", "must be \"laboratory\", \"body\", \"inertial\"");
  expect_set({{"/release/precession", "slow"}}, "/release/precession",
             "\"none\", \"steady_slow\", \"steady_fast\", or an object");
  expect_set({{"/release/rates_relative_to", "earth"}}, "/release/rates_relative_to", "must be \"laboratory\", \"inertial\"");
  expect_set({{"/body/inertia/about", "cm"}}, "/body/inertia/about", "must be \"pivot\", \"center_of_mass\"");
}

TEST(ScenarioFields, NamesFollowTheirPattern) {
  for (const std::string name : {"a", "0", "lecture-gyro", "a-"})
    EXPECT_EQ(parse(kMinimal, {{"/name", "\"" + name + "\""}}).name, name);
  EXPECT_EQ(parse(kMinimal, {{"/name", std::string(64, 'a')}}).name.size(), 64u);
  for (const std::string name : {"", "-a", "A", "a b", "a_b", "../x"})
    expect_set({{"/name", name}}, "/name", "must be a string of 1 to 64");
  expect_set({{"/name", std::string(65, 'a')}}, "/name", "must be a string of 1 to 64");
}

TEST(ScenarioFields, AnEffectThatIsNotModelledIsSaidSo) {
  const Found found = found_in(kMinimal, {{"/effects/magnetic", "true"}});
  ASSERT_EQ(found.places.size(), 1u);
  EXPECT_TRUE(found.says(0, "not available")) << found.messages[0];
}

TEST(ScenarioFields, AllErrorsComeAtOnceSortedAndAtMostTwenty) {
  const Found found = found_in(replaced(replaced(replaced(kMinimal, "45", "95"), "\"spin_rad_s\"", "\"spinn\""), "60", "-60"));
  EXPECT_EQ(found.places,
            (std::vector<std::string>{"1:27 /site/latitude_deg", "3:30 /release/spinn", "4:27 /motion/duration_s"}));

  std::string many = "{";
  for (int i = 0; i < 30; ++i) many += "\"k" + std::to_string(i) + "\": 1,\n";
  const Found cut = found_in(replaced(kMinimal, "{", many));
  ASSERT_EQ(cut.places.size(), 21u);
  EXPECT_EQ(cut.places[0], "1:2 /k0");
  EXPECT_EQ(cut.places[19], "20:1 /k19");
  EXPECT_EQ(cut.messages[20], "10 more errors are not shown");
}

// Every default in the table is valid JSON within its own range; otherwise, a default written out would be refused.
TEST(ScenarioFields, TableIsConsistent) {
  for (const input::Field& field : scenario::fields().fields) {
    EXPECT_EQ(scenario::fields().find(field.pointer), &field) << field.pointer;  // no pointer twice
    EXPECT_TRUE(field.parent().empty() || scenario::fields().find(field.parent())) << field.pointer;
    EXPECT_FALSE(field.doc.empty()) << field.pointer;
    if (field.fallback.empty()) continue;
    input::Findings findings;
    input::Node node;
    EXPECT_EQ(input::read_json(field.fallback, "", false, node, findings), input::ReadOutcome::complete) << field.pointer;
    if (field.kind == input::FieldKind::number) {
      EXPECT_TRUE(field.range.contains(node.number)) << field.pointer;
    }
  }
}

}  // namespace
}  // namespace earthtop::scenario_test
