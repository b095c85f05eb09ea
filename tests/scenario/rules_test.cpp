// SPDX-License-Identifier: GPL-3.0-or-later
// Rules that involve more than one key, and defaults.
#include <random>

#include "earthtop/model/platform.hpp"
#include "earthtop/model/release.hpp"
#include "scenario/document.hpp"
#include "scenario/fields.hpp"
#include "support.hpp"

namespace earthtop::scenario_test {
namespace {

TEST(ScenarioDefaults, EveryDefaultIsTheDocumentedOne) {
  const Scenario s = parse(kMinimal);
  EXPECT_EQ(s.name, "minimal");
  EXPECT_EQ(s.title, "");
  EXPECT_EQ(s.site.longitude_deg, 0);
  EXPECT_EQ(s.site.height_m, 0);
  EXPECT_EQ(s.site.gravity_m_s2, normal_gravity(45, 0));
  EXPECT_EQ(s.rotation_rate_rad_s, 7.292115e-5);
  EXPECT_EQ(s.body.inertia_about, InertiaAbout::pivot);
  EXPECT_EQ(s.release.azimuth_deg, 0);
  EXPECT_EQ(s.release.spin_angle_deg, 0);
  EXPECT_EQ(s.release.precession, Precession::none);
  EXPECT_EQ(s.release.rates_relative_to, RatesRelativeTo::laboratory);
  EXPECT_EQ(s.output_step_s, 60.0 / 1000);
  EXPECT_EQ(output_times(s.duration_s, s.output_step_s).size(), 1001u);
  EXPECT_FALSE(s.platform.has_value());
  EXPECT_TRUE(s.effects.all_on());
  EXPECT_EQ(s.numerics.method, Method::automatic);
  EXPECT_EQ(s.numerics.observer, Observer::laboratory);
  EXPECT_EQ(s.numerics.relative_tolerance, 1e-12);
  EXPECT_FALSE(s.numerics.step_s.has_value());
  EXPECT_FALSE(s.threshold_rad.has_value());
}

TEST(ScenarioDefaults, WhatIsNoWordLeavesAnEnumeratorThatExists) {
  for (const char* value : {"3", "1e-320", "true", "null", "[]", "{}", "\"\"", "\"nope\""}) {
    const scenario::Document document({"minimal.json", kMinimal}, {{"/numerics/method", value}, {"/numerics/observer", value}});
    const scenario::Decoded decoded = document.decode();
    EXPECT_FALSE(decoded.findings.empty()) << value;
    EXPECT_EQ(decoded.scenario.numerics.method, Method::automatic) << value;
    EXPECT_EQ(decoded.scenario.numerics.observer, Observer::laboratory) << value;
  }
}

TEST(ScenarioDefaults, GivenValuesAreRead) {
  const Scenario s =
      parse(kMinimal, {{"/title", "A \"title\""},
                       {"/site", R"({"latitude_deg": -30, "longitude_deg": 10, "height_m": 2000})"},
                       {"/release/azimuth_deg", "90"},
                       {"/release/spin_angle_deg", "7"},
                       {"/release/rates_relative_to", "inertial"},
                       {"/release/precession", R"({"rate_rad_s": -0.5})"},
                       {"/motion/output_step_s", "0.1"},
                       {"/effects", R"({"centrifugal": false})"},
                       {"/numerics", R"({"method": "rkf78", "observer": "inertial", "relative_tolerance": 1e-9})"},
                       {"/report/threshold_rad", "0.25"}});
  EXPECT_EQ(s.title, "A \"title\"");
  EXPECT_EQ(s.site.latitude_deg, -30);
  EXPECT_EQ(s.site.longitude_deg, 10);
  EXPECT_EQ(s.site.height_m, 2000);
  EXPECT_EQ(s.site.gravity_m_s2, normal_gravity(-30, 2000));
  EXPECT_EQ(s.release.azimuth_deg, 90);
  EXPECT_EQ(s.release.spin_angle_deg, 7);
  EXPECT_EQ(s.release.rates_relative_to, RatesRelativeTo::inertial);
  EXPECT_EQ(s.release.precession, Precession::given);
  EXPECT_EQ(s.release.precession_rate_rad_s, -0.5);
  EXPECT_EQ(s.output_step_s, 0.1);
  EXPECT_TRUE(s.effects.coriolis && s.effects.transverse && !s.effects.centrifugal);
  EXPECT_EQ(s.numerics.method, Method::rkf78);
  EXPECT_EQ(s.numerics.observer, Observer::inertial);
  EXPECT_EQ(s.numerics.relative_tolerance, 1e-9);
  EXPECT_EQ(s.threshold_rad, 0.25);
}

TEST(ScenarioDefaults, NameComesFromTheFile) {
  EXPECT_EQ(parse_scenario({"<stdin>", kMinimal}).name, "unnamed");
  EXPECT_EQ(parse_scenario({"/a/b/lecture-gyro.json", kMinimal}).name, "lecture-gyro");
  try {
    parse_scenario({"My Top.json", kMinimal});
    FAIL();
  } catch (const ScenarioError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1u);
    EXPECT_EQ(error.diagnostics()[0].pointer, "/name");
    EXPECT_NE(error.diagnostics()[0].message.find("\"My Top\" cannot replace it; give a name"), std::string::npos);
  }
}

TEST(ScenarioRules, MissingKeysStandAtTheirObject) {
  expect_one(replaced(kMinimal, "\"latitude_deg\": 45", ""), "1:10 /site/latitude_deg", "is missing");
  expect_one(replaced(kMinimal, "\"mass_kg\": 0.1, ", ""), "2:10 /body/mass_kg", "is missing; must be a number above 0");
  expect_one(replaced(kMinimal, "\"duration_s\": 60", ""), "4:12 /motion/duration_s", "is missing");
  expect_one(replaced(kMinimal, "\"tilt_deg\": 20, ", ""), "3:13 /release/tilt_deg", "neither tilt_deg nor quaternion_LB");
  expect_one(replaced(kMinimal, ", \"spin_rad_s\": 200", ""), "3:13 /release/spin_rad_s",
             "neither spin_rad_s nor angular_velocity");
  const Found all = found_in("{}");
  EXPECT_EQ(all.places,
            (std::vector<std::string>{"1:1 /site/latitude_deg", "1:1 /body", "1:1 /release", "1:1 /motion/duration_s"}));
}

TEST(ScenarioRules, LatitudeMayBeLeftOutWithoutRotationAndWithGravity) {
  const std::string text = replaced(kMinimal, "\"latitude_deg\": 45", "\"gravity_m_s2\": 9.8");
  EXPECT_EQ(parse(text, {{"/earth/rotation_rate_rad_s", "0"}}).site.gravity_m_s2, 9.8);
  expect_one(text, "1:10 /site/latitude_deg", "is missing");
  expect_one(replaced(kMinimal, "\"latitude_deg\": 45", ""), "1:10 /site/latitude_deg", "is missing",
             {{"/earth/rotation_rate_rad_s", "0"}});
  EXPECT_EQ(parse(text, {{"/earth/rotation_rate_rad_s", "0"}, {"/site/gravity_m_s2", "0"}}).site.gravity_m_s2, 0);
}

TEST(ScenarioRules, InertiaIsPrincipalOrMatrix) {
  const std::string matrix = "[[2e-4, 1e-6, 0], [1e-6, 2e-4, 0], [0, 0, 4e-5]]";
  const Scenario s = parse(replaced(kMinimal, "\"principal_kg_m2\": [2e-4, 2e-4, 4e-5]", "\"matrix_kg_m2\": " + matrix));
  EXPECT_EQ(s.body.inertia_kg_m2[0][1], 1e-6);
  EXPECT_EQ(parse(kMinimal).body.inertia_kg_m2,
            (std::array<std::array<double, 3>, 3>{{{2e-4, 0, 0}, {0, 2e-4, 0}, {0, 0, 4e-5}}}));
  expect_set({{"/body/inertia/matrix_kg_m2", matrix}}, "/body/inertia/matrix_kg_m2", "both given; give exactly one");
  expect_one(replaced(kMinimal, "\"principal_kg_m2\": [2e-4, 2e-4, 4e-5]", ""), "2:72 /body/inertia/principal_kg_m2",
             "give exactly one");
  expect_set({{"/body/inertia", R"({"matrix_kg_m2": [[2e-4, 1e-6, 0], [2e-6, 2e-4, 0], [0, 0, 4e-5]]})"}},
             "/body/inertia/matrix_kg_m2", "row 1, column 2 is 1e-06, row 2, column 1 is 2e-06");
  const Scenario averaged = parse(
      kMinimal, {{"/body/inertia", R"({"matrix_kg_m2": [[2e-4, 1e-6, 0], [1.0000000000000002e-6, 2e-4, 0], [0, 0, 4e-5]]})"}});
  EXPECT_EQ(averaged.body.inertia_kg_m2[0][1], averaged.body.inertia_kg_m2[1][0]);
  expect_set({{"/body/inertia", R"({"matrix_kg_m2": [[1, 0], [0, 1, 0], [0, 0, 1]]})"}}, "/body/inertia/matrix_kg_m2/0",
             "array of 2");
}

TEST(ScenarioRules, UnphysicalBodiesStandAtTheirInertia) {
  expect_one(replaced(kMinimal, "[2e-4, 2e-4, 4e-5]", "[2e-4, 2e-4, 5e-4]"), "2:72 /body/inertia", "triangle inequality");
  expect_one(replaced(kMinimal, "[2e-4, 2e-4, 4e-5]", "[2e-5, 2e-5, 4e-5]"), "2:72 /body/inertia", "negative");
  EXPECT_NO_THROW(
      parse(replaced(kMinimal, "[2e-4, 2e-4, 4e-5]", "[1e-4, 1e-4, 2e-4]"), {{"/body/center_of_mass_m", "[0,0,0]"}}));
  expect_set(
      {{"/body",
        R"({"mass_kg": 1e-300, "center_of_mass_m": [0,0,0], "inertia": {"principal_kg_m2": [1e-320, 1e-320, 1e-320]}})"}},
      "/body/inertia", "too small or too large");
}

std::string with_solid(const std::string& solid) {
  return "{\"site\": {\"latitude_deg\": 45}, \"release\": {\"tilt_deg\": 20, \"spin_rad_s\": 200}, \"motion\": "
         "{\"duration_s\": 60},\n"
         "\"body\": {\"solids\": [\n" +
         solid + "]}}";
}

TEST(ScenarioRules, SolidsNeedTheMembersOfTheirShape) {
  for (const char* good : {
           R"({"shape": "disc", "radius_m": 0.03, "mass_kg": 0.1, "at_m": 0.05})",
           R"({"shape": "disc", "radius_m": 0.03, "length_m": 0.01, "density_kg_m3": 8000, "at_m": 0.05})",
           R"({"shape": "ring", "radius_m": 0.03, "inner_radius_m": 0.02, "mass_kg": 0.1, "at_m": 0.05})",
           R"({"shape": "sphere", "radius_m": 0.03, "inner_radius_m": 0.02, "density_kg_m3": 1000, "at_m": -0.05})",
           R"({"shape": "ring", "radius_m": 0.03, "inner_radius_m": 0.03, "mass_kg": 0.1, "at_m": 0.05})",
           R"({"shape": "ring", "radius_m": 0.03, "inner_radius_m": 0.03, "length_m": 0.1, "mass_kg": 0.1})",
           R"({"shape": "sphere", "radius_m": 0.03, "inner_radius_m": 0.03, "mass_kg": 0.1, "at_m": -0.05})",
           R"({"shape": "cone", "radius_m": 0.03, "length_m": 0.02, "density_kg_m3": 1000})",
           R"({"shape": "rod", "radius_m": 0.003, "length_m": 0.02, "density_kg_m3": 1000, "at_m": 0.05})",
       })
    EXPECT_NO_THROW(parse(with_solid(good))) << good;
  const auto refused = [](const std::string& solid, const std::string& place, const std::string& part) {
    expect_one(with_solid(solid), place, part);
  };
  refused(R"({"shape": "disc", "radius_m": 0.03})", "3:1 /body/solids/0/mass_kg", "neither mass_kg nor density_kg_m3");
  refused(R"({"shape": "disc", "radius_m": 0.03, "mass_kg": 1, "density_kg_m3": 1})", "3:51 /body/solids/0/density_kg_m3",
          "both given");
  refused(R"({"shape": "disc", "radius_m": 0.03, "density_kg_m3": 1})", "3:37 /body/solids/0/density_kg_m3",
          "a disc without length_m has no volume");
  refused(R"({"shape": "ring", "radius_m": 0.03, "inner_radius_m": 0.01, "length_m": 0, "density_kg_m3": 1})",
          "3:76 /body/solids/0/density_kg_m3", "no volume; give mass_kg");
  refused(R"({"shape": "rod", "length_m": 0.03, "density_kg_m3": 1})", "3:36 /body/solids/0/density_kg_m3", "without radius_m");
  refused(R"({"shape": "disc", "mass_kg": 1})", "3:1 /body/solids/0/radius_m", "is missing");
  refused(R"({"shape": "cylinder", "radius_m": 0.1, "mass_kg": 1})", "3:1 /body/solids/0/length_m", "is missing");
  refused(R"({"shape": "cone", "radius_m": 0.1, "length_m": 0, "mass_kg": 1})", "3:48 /body/solids/0/length_m",
          "must be above 0");
  refused(R"({"shape": "ring", "radius_m": 0.1, "mass_kg": 1})", "3:1 /body/solids/0/inner_radius_m", "is missing");
  refused(R"({"shape": "ring", "radius_m": 0.1, "inner_radius_m": 0.11, "mass_kg": 1})", "3:54 /body/solids/0/inner_radius_m",
          "0.11 is larger than radius_m, 0.1; the inner radius must not be above the outer one");
  refused(R"({"shape": "ring", "radius_m": 0.1, "inner_radius_m": 0.1, "length_m": 0.1, "density_kg_m3": 1})",
          "3:76 /body/solids/0/density_kg_m3", "a ring as thin as its radii say has no volume; give mass_kg");
  refused(R"({"shape": "sphere", "radius_m": 0.1, "inner_radius_m": 0.1, "density_kg_m3": 1})",
          "3:61 /body/solids/0/density_kg_m3", "a sphere as thin as its radii say has no volume; give mass_kg");
  refused(R"({"shape": "disc", "radius_m": 0.1, "inner_radius_m": 0.1, "mass_kg": 1})", "3:36 /body/solids/0/inner_radius_m",
          "a disc has no inner_radius_m");
  refused(R"({"shape": "sphere", "radius_m": 0.1, "length_m": 0.1, "mass_kg": 1})", "3:38 /body/solids/0/length_m",
          "a sphere has no length_m");
  refused(R"({"shape": "disk", "radius_m": 0.1, "mass_kg": 1})", "3:11 /body/solids/0/shape", "did you mean \"disc\"");
  refused(R"({"radius_m": 0.1, "mass_kg": 1})", "3:1 /body/solids/0/shape", "is missing");
  refused("", "2:20 /body/solids", "an array of at least one object");
  refused("5", "3:1 /body/solids/0", "must be an object");
  refused(R"({"shape": "rod", "length_m": 0.1, "mass_kg": 1})", "2:20 /body/solids",
          "not positive definite (I3 is 0); every principal moment about the pivot must be positive");
  refused(R"({"shape": "sphere", "radius_m": 1000, "density_kg_m3": 1000})", "2:20 /body/solids", "the mass is");
}

TEST(ScenarioRules, SolidsExcludeMassCentreAndInertia) {
  const Found found = found_in(kMinimal, {{"/body/solids", R"([{"shape": "disc", "radius_m": 0.1, "mass_kg": 1}])"}});
  EXPECT_EQ(found.places,
            (std::vector<std::string>{"2:11 /body/mass_kg", "2:27 /body/center_of_mass_m", "2:61 /body/inertia"}));
  EXPECT_TRUE(found.says(0, "solids are given too"));
  expect_set({{"/body", "{}"}}, "/body/mass_kg", "give them, or solids");
}

TEST(ScenarioRules, AttitudeIsTiltOrQuaternion) {
  const auto release = [](const std::string& attitude) {
    return Overrides{{"/release", "{\"spin_rad_s\": 1, " + attitude + "}"}};
  };
  const std::string good = R"("quaternion_LB": {"w": 0.6, "x": 0, "y": 0.8, "z": 0})";
  EXPECT_EQ(parse(kMinimal, release(good)).release.quaternion_LB, (std::array<double, 4>{0.6, 0, 0.8, 0}));
  EXPECT_NO_THROW(parse(kMinimal, release(R"("quaternion_LB": {"w": 1.0000009, "x": 0, "y": 0, "z": 0})")));
  expect_set(release(R"("quaternion_LB": {"w": 1.0000011, "x": 0, "y": 0, "z": 0})"), "/release/quaternion_LB",
             "has the norm 1.0000011");
  expect_set(release(R"("quaternion_LB": {"w": 1, "x": 0, "y": 0})"), "/release/quaternion_LB/z", "is missing");
  expect_set(release("\"tilt_deg\": 1, " + good), "/release/quaternion_LB", "both given");
  expect_set(release("\"azimuth_deg\": 1, " + good), "/release/azimuth_deg", "belong to tilt_deg");
  expect_set(release("\"spin_angle_deg\": 1, " + good), "/release/spin_angle_deg", "belong to tilt_deg");
}

TEST(ScenarioRules, RatesAreSpinOrAngularVelocity) {
  const auto release = [](const std::string& rates) { return Overrides{{"/release", "{\"tilt_deg\": 1, " + rates + "}"}}; };
  const std::string good = "\"angular_velocity_body_rad_s\": [1, 2, 3]";
  EXPECT_EQ(parse(kMinimal, release(good)).release.angular_velocity_body_rad_s, (std::array<double, 3>{1, 2, 3}));
  expect_set(release("\"spin_rad_s\": 1, " + good), "/release/angular_velocity_body_rad_s", "both given");
  expect_set(release("\"precession\": \"none\", " + good), "/release/precession", "belongs to spin_rad_s");
  expect_set(release("\"spin_rad_s\": 1, \"precession\": {}"), "/release/precession/rate_rad_s", "is missing");
  expect_set(release("\"spin_rad_s\": 1, \"precession\": {\"rate\": 1}"), "/release/precession/rate",
             "did you mean \"rate_rad_s\"");
}

TEST(ScenarioRules, SteadyPrecessionThatDoesNotExistIsRefusedWithTheReason) {
  const auto with = [](const std::string& precession) {
    return replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rad_s\": 200, \"precession\": \"" + precession + "\"");
  };
  EXPECT_EQ(parse(with("steady_slow")).release.precession, Precession::steady_slow);
  EXPECT_EQ(parse(with("steady_fast")).release.precession, Precession::steady_fast);
  expect_one(replaced(with("steady_slow"), "200", "2"), "3:61 /release/precession", "the spin is too slow");
  expect_one(replaced(with("steady_fast"), "\"tilt_deg\": 20", "\"tilt_deg\": 90"), "3:63 /release/precession",
             "no fast steady precession");
  expect_one(replaced(with("steady_slow"), "\"tilt_deg\": 20", "\"tilt_deg\": 0"), "3:62 /release/precession",
             "the axis is vertical");
  expect_one(replaced(with("steady_slow"), "[2e-4, 2e-4, 4e-5]", "[2e-4, 2.1e-4, 4e-5]"), "3:63 /release/precession",
             "not equal");
}

TEST(ScenarioRules, OutputRowsAreLimitedWithTheEstimate) {
  EXPECT_NO_THROW(parse(kMinimal, {{"/motion/output_step_s", "60e-6"}, {"/motion/duration_s", "100"}}));
  expect_set({{"/motion/output_step_s", "1e-6"}}, "/motion/output_step_s", "about 6e+07 output rows; at most 2000000");
  EXPECT_EQ(parse(kMinimal, {{"/motion/output_step_s", "61"}}).output_step_s, 61);
}

TEST(ScenarioRules, PlatformKeysBelongToTheirMotion) {
  const Scenario s = parse(kMinimal, {{"/platform", R"({"motion": "ramp", "acceleration_rad_s2": 0.01})"}});
  ASSERT_TRUE(s.platform.has_value());
  EXPECT_EQ(s.platform->motion, PlatformMotion::ramp);
  EXPECT_EQ(s.platform->axis, (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(s.platform->rate_rad_s, 0);
  EXPECT_EQ(s.platform->acceleration_rad_s2, 0.01);
  EXPECT_EQ(s.platform->pivot_offset_m, (std::array<double, 3>{0, 0, 0}));
  const Scenario h = parse(
      kMinimal,
      {{"/platform", R"({"motion": "harmonic", "axis": [1, 1, 0], "amplitude_rad": 0.1, "frequency_hz": 2, "phase_deg": 90,
                                                        "pivot_offset_m": [0.3, 0, 1]})"}});
  EXPECT_EQ(h.platform->motion, PlatformMotion::harmonic);
  EXPECT_EQ(h.platform->axis, (std::array<double, 3>{1, 1, 0}));
  EXPECT_EQ(h.platform->amplitude_rad, 0.1);
  EXPECT_EQ(h.platform->frequency_hz, 2);
  EXPECT_EQ(h.platform->phase_deg, 90);
  EXPECT_EQ(h.platform->pivot_offset_m, (std::array<double, 3>{0.3, 0, 1}));
  expect_set({{"/platform", R"({"motion": "constant", "rate_rad_s": 1, "acceleration_rad_s2": 0})"}},
             "/platform/acceleration_rad_s2", "does not belong to \"constant\" motion; allowed with it: rate_rad_s");
  expect_set({{"/platform", R"({"motion": "harmonic", "amplitude_rad": 1, "frequency_hz": 1, "rate_rad_s": 1})"}},
             "/platform/rate_rad_s", "does not belong");
  expect_set({{"/platform", R"({"motion": "constant", "rate_rad_s": 1, "axis": [0, 0, 0]})"}}, "/platform/axis", "zero vector");
  expect_set({{"/platform", R"({"motion": "constant", "rate_rad_s": 1, "axis": [0, 1e-200, 0]})"}}, "/platform/axis",
             "zero vector");
  expect_set({{"/platform", R"({"motion": "harmonic", "frequency_hz": 1})"}}, "/platform/amplitude_rad", "is missing");
  expect_set({{"/platform", R"({"rate_rad_s": 1})"}}, "/platform/motion", "is missing");
}

TEST(ScenarioRules, TolerancesAndStepsBelongToTheirMethods) {
  const Scenario s = parse(kMinimal, {{"/numerics", R"({"method": "abm8", "step_s": 1e-4})"}});
  EXPECT_EQ(s.numerics.method, Method::abm8);
  EXPECT_EQ(s.numerics.step_s, 1e-4);
  expect_set({{"/numerics", R"({"method": "abm8"})"}}, "/numerics/step_s", "is missing");
  expect_set({{"/numerics", R"({"method": "abm8", "step_s": 1e-4, "relative_tolerance": 1e-9})"}},
             "/numerics/relative_tolerance", "has a fixed step and no tolerance");
  for (const std::string method : {"gauss", "splitting"}) {  // the one or the other
    EXPECT_FALSE(parse(kMinimal, {{"/numerics/method", method}}).numerics.step_s);
    EXPECT_EQ(parse(kMinimal, {{"/numerics", "{\"method\": \"" + method + "\", \"step_s\": 1e-3}"}}).numerics.step_s, 1e-3);
    expect_set({{"/numerics", "{\"method\": \"" + method + "\", \"step_s\": 1e-3, \"relative_tolerance\": 1e-9}"}},
               "/numerics/relative_tolerance", "give one of the two");
  }
  const Scenario composed = parse(kMinimal, {{"/numerics", R"({"method": "splitting", "composition": "aba864"})"}});
  EXPECT_EQ(composed.numerics.composition, Composition::aba864);
  EXPECT_EQ(parse(canonical_json(composed)).numerics.composition, Composition::aba864);
  expect_set({{"/numerics", R"({"method": "rkf78", "composition": "aba864"})"}}, "/numerics/composition",
             "does not compose flows");
  expect_set({{"/numerics", R"({"method": "splitting", "observer": "body"})"}}, "/numerics/method", "has no body axes");
  for (const std::string method : {"auto", "dopri5", "rkf78", "bulirsch_stoer", "dop853"}) {
    EXPECT_EQ(to_string(parse(kMinimal, {{"/numerics/method", method}}).numerics.method), method);
    expect_set({{"/numerics", "{\"method\": \"" + method + "\", \"step_s\": 1e-4}"}}, "/numerics/step_s",
               "chooses its own steps");
  }
  for (const std::string key : {"relative_tolerance", "step_s"})
    expect_set({{"/numerics", "{\"method\": \"closed_form\", \"" + key + "\": 1e-4}"}, {"/site/latitude_deg", "90"}},
               "/numerics/" + key, "takes no steps and has no tolerance");
  for (const std::string observer : {"laboratory", "body", "inertial"})
    EXPECT_EQ(to_string(parse(kMinimal, {{"/numerics/observer", observer}}).numerics.observer), observer);
  expect_set({{"/numerics", R"({"method": "abm8", "step_s": 1e-9})"}}, "/numerics/step_s", "about 6e+10 steps; at most 2e+09");
}

TEST(ScenarioRules, AClosedFormIsForTheScenesThatHaveOne) {
  const std::pair<std::string, std::string> method = {"/numerics/method", "closed_form"};
  const Overrides fits[] = {{{"/site/latitude_deg", "90"}},
                            {{"/site/latitude_deg", "-90"}},
                            {{"/earth/rotation_rate_rad_s", "0"}},
                            {{"/site/gravity_m_s2", "0"}},
                            {{"/body/center_of_mass_m", "[0, 0, 0]"}}};
  for (Overrides changes : fits) {
    changes.push_back(method);
    const Scenario s = parse(kMinimal, changes);
    EXPECT_EQ(s.numerics.method, Method::closed_form);
    EXPECT_EQ(canonical_json(parse(canonical_json(s))), canonical_json(s));
  }
  // Its cost follows the axis, not the spin.
  const Overrides balanced = {{"/body/center_of_mass_m", "[0, 0, 0]"},
                              {"/release/spin_rad_s", "1e6"},
                              {"/motion", R"({"duration_s": 1e6, "output_step_s": 1e4})"}};
  Overrides integrated = balanced;
  integrated.emplace_back("/numerics/method", "taylor");
  expect_set(integrated, "/motion/duration_s", "steps");
  Overrides exact = balanced;
  exact.push_back(method);
  EXPECT_LT(Scene(parse(kMinimal, exact)).estimate().solution.steps, 1000);
  expect_set({method, {"/site/latitude_deg", "90"}, {"/motion", R"({"duration_s": 1e9, "output_step_s": 1e6})"}},
             "/motion/duration_s", "steps");
  expect_set({method}, "/numerics/method", "away from the poles");
  expect_set({method, {"/site/latitude_deg", "89.999"}}, "/numerics/method", "away from the poles");
  expect_set({method, {"/body/center_of_mass_m", "[0, 0.001, 0.03]"}}, "/numerics/method", "only a symmetric top");
  expect_set({method, {"/effects/coriolis", "false"}}, "/numerics/method", "not available without");
  expect_set({method, {"/platform", R"({"motion": "constant", "rate_rad_s": 1})"}}, "/numerics/method",
             "not available on a platform");
}

TEST(ScenarioRules, PrecisionSetsMethodsAndTolerances) {
  const auto with = [](const std::string& precision, const std::string& more) {
    return Overrides{{"/numerics", "{\"precision\": \"" + precision + "\"" + more + "}"}};
  };
  const std::pair<std::string, double> defaults[] = {{"double", 1e-12}, {"long_double", 1e-16}, {"float128", 1e-28}};
  for (const auto& [precision, tolerance] : defaults) {
    const Scenario s = parse(kMinimal, with(precision, ""));
    EXPECT_EQ(to_string(s.precision), precision);
    EXPECT_EQ(s.numerics.relative_tolerance, tolerance);
    EXPECT_EQ(parse(canonical_json(s)).numerics.relative_tolerance, tolerance);
    EXPECT_EQ(canonical_json(parse(canonical_json(s))), canonical_json(s));
    for (const std::string method : {"auto", "rkf78", "extrapolation"})
      EXPECT_EQ(to_string(parse(kMinimal, with(precision, ", \"method\": \"" + method + "\"")).numerics.method), method);
    EXPECT_EQ(parse(kMinimal, with(precision, ", \"relative_tolerance\": 1e-9")).numerics.relative_tolerance, 1e-9);
  }
  EXPECT_EQ(parse(kMinimal, with("float128", ", \"relative_tolerance\": 1e-32")).numerics.relative_tolerance, 1e-32);
  EXPECT_NO_THROW(parse(kMinimal, with("long_double", ", \"method\": \"bulirsch_stoer\"")));
  expect_set(with("float128", ", \"method\": \"bulirsch_stoer\""), "/numerics/method",
             "is not built for float128; must be \"auto\", \"rkf78\", \"extrapolation\"");
  for (const std::string precision : {"long_double", "float128"}) {
    expect_set(with(precision, ", \"method\": \"dopri5\""), "/numerics/method", "\"dopri5\" is not built for " + precision);
    expect_set(with(precision, ", \"method\": \"abm8\", \"step_s\": 1e-3"), "/numerics/method",
               "\"abm8\" is not built for " + precision);
  }
}

TEST(ScenarioRules, WhatWouldTakeDaysIsRefusedInEveryPrecision) {
  // 200 rad/s: about 250 rad/s of fastest motion, 127 evaluations of 17 microseconds for each radian, twice.
  const Overrides quad = {{"/numerics/precision", "float128"}};
  EXPECT_NEAR(Scene(parse(kMinimal, quad)).estimate().seconds.all() / parse(kMinimal).duration_s, 1.0, 0.8);
  Overrides too_long = quad;
  too_long.push_back({"/motion/duration_s", "1e6"});
  expect_set(too_long, "/motion/duration_s", "in float128 this scenario needs about");
  too_long[0].second = "double";
  EXPECT_NO_THROW(parse(kMinimal, too_long));
}

// Any value at any key, several at a time, is refused at its place, or gives a scenario with finite start and times whose
// canonical form reads back as itself.
TEST(ScenarioRules, AnyValueAnywhereIsRefusedOrGivesAWholeScenario) {
  const std::vector<std::string> values = {"0",
                                           "-0.0",
                                           "1",
                                           "-1",
                                           "0.5",
                                           "1e300",
                                           "5e-324",
                                           "1e-12",
                                           "1e999",
                                           "null",
                                           "true",
                                           "false",
                                           "x",
                                           "",
                                           "[]",
                                           "{}",
                                           "[0,0,0]",
                                           "[1,2,3]",
                                           "[1e-200,0,0]",
                                           "[[1,0,0],[0,1,0],[0,0,1]]",
                                           "[{}]",
                                           "ring",
                                           "rod",
                                           "abm8",
                                           "splitting",
                                           "rkn6",
                                           "steady_slow",
                                           "steady_fast",
                                           "harmonic",
                                           "ramp",
                                           "constant",
                                           R"({"w":1,"x":0,"y":0,"z":0})",
                                           R"({"rate_rad_s":1})",
                                           R"([{"shape":"disc","radius_m":0.1,"mass_kg":1,"at_m":0.1}])"};
  std::vector<std::string> pointers;
  for (const input::Field& field : scenario::fields().fields) {
    std::string pointer(field.pointer);
    if (const auto star = pointer.find('*'); star != std::string::npos) pointer[star] = '0';
    pointers.push_back(pointer);
  }
  std::mt19937 random(271828);
  int accepted = 0;
  for (int i = 0; i < 20'000; ++i) {
    Overrides overrides;
    for (unsigned k = 0; k < 1 + random() % 3; ++k)
      overrides.emplace_back(pointers[random() % pointers.size()], values[random() % values.size()]);
    try {
      const Scenario s = parse(kMinimal, overrides);
      ++accepted;
      const std::string canonical = canonical_json(s);
      EXPECT_EQ(canonical_json(parse(canonical)), canonical) << overrides[0].first << "=" << overrides[0].second;
      const auto times = output_times(s.duration_s, s.output_step_s);
      EXPECT_EQ(times.back(), s.duration_s);
      EXPECT_TRUE(make_release<double>(s.release, make_body<double>(s.body), s.site.gravity_m_s2).w_XB_B.allFinite())
          << canonical;
      if (s.platform) {
        EXPECT_NEAR(norm(make_platform<double>(*s.platform).turn.axis), 1, 1e-12) << canonical;
      }
    } catch (const ScenarioError& error) {
      EXPECT_FALSE(error.diagnostics().empty());
      for (const Diagnostic& d : error.diagnostics()) EXPECT_FALSE(d.message.empty());
    }
  }
  EXPECT_GT(accepted, 200);
}

}  // namespace
}  // namespace earthtop::scenario_test
