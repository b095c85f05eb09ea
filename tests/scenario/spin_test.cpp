// SPDX-License-Identifier: GPL-3.0-or-later
// The spin in revolutions per minute: the number that is made of it, the canonical text, and the other key of the pair.
#include <cmath>
#include <limits>
#include <random>

#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "support.hpp"

namespace earthtop::scenario_test {
namespace {

const std::string kInRpm = replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rpm\": 1910");

TEST(SpinInRpm, TakesThePlaceOfTheOtherInAChangedText) {
  const Overrides rpm = {{"/release/spin_rpm", "1910"}, {"/site/height_m", "5"}};
  const std::string changed = changed_text(kMinimal, rpm);
  EXPECT_EQ(changed.find("spin_rad_s"), changed.npos);
  EXPECT_EQ(canonical_json(parse_scenario({"top.json", changed})), canonical_json(parse_scenario({"top.json", kMinimal}, rpm)));
  const Overrides rad_s = {{"/release/spin_rad_s", "200"}};
  EXPECT_EQ(changed_text(kInRpm, rad_s).find("spin_rpm"), std::string::npos);
  EXPECT_EQ(changed_text(kMinimal, {}), kMinimal);
}

TEST(SpinInRpm, IsTheNearestNumberInRadians) {
  // Pi with 40 digits (DLMF 3.12.1), of which float128 holds 34.
  const float128 pi = 3.141592653589793238462643383279502884197Q;
  std::mt19937_64 random(24);
  for (int i = 0; i < 20000; ++i) {
    const double rpm =
        std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -60 + static_cast<int>(random() % 30));
    const float128 exact = float128(rpm) * pi / 30;
    const double rad_s = rad_s_from_rpm(rpm);
    const double up = std::nextafter(rad_s, std::numeric_limits<double>::infinity()),
                 down = std::nextafter(rad_s, -std::numeric_limits<double>::infinity());
    const auto off = [&](double x) { return x > exact ? x - exact : exact - x; };
    EXPECT_LE(off(rad_s), off(up)) << rpm;
    EXPECT_LE(off(rad_s), off(down)) << rpm;
  }
  EXPECT_EQ(rad_s_from_rpm(60), 2 * 3.14159265358979311600);
  EXPECT_EQ(rad_s_from_rpm(-60), -rad_s_from_rpm(60));
  EXPECT_EQ(rad_s_from_rpm(0), 0);
}

/// A conversion that is not undone by the canonical text, or is applied to it again, changes last bits for many of these.
TEST(SpinInRpm, TheCanonicalCopyIsTheSameSceneToTheLastBit) {
  std::mt19937_64 random(25);
  for (int i = 0; i < 300; ++i) {
    const double rpm = std::ldexp(static_cast<double>(random() >> 11), -50) * 100;
    const Scenario scenario = parse(kMinimal, {{"/release/spin_rpm", std::to_string(rpm)}});
    const std::string canonical = canonical_json(scenario);
    const Scenario again = parse(canonical);
    EXPECT_EQ(again.release.spin_rad_s, scenario.release.spin_rad_s) << rpm;
    EXPECT_TRUE(again == scenario);
    EXPECT_EQ(canonical_json(again), canonical);
    EXPECT_EQ(canonical.find("spin_rpm"), std::string::npos);
  }
}

TEST(SpinInRpm, ARunOfItsCanonicalCopyHasTheSameResults) {
  const Scenario scenario = parse(kInRpm, {{"/motion/duration_s", "1"}});
  EXPECT_EQ(summary_json(run(parse(canonical_json(scenario)))), summary_json(run(scenario)));
  EXPECT_EQ(resolve(scenario).sha256(), resolve(parse(canonical_json(scenario))).sha256());
  // The same scene given in rad/s is the same run.
  Scenario in_radians = parse(kMinimal, {{"/motion/duration_s", "1"}});
  in_radians.release.spin_rad_s = rad_s_from_rpm(1910);
  EXPECT_EQ(resolve(in_radians).sha256(), resolve(scenario).sha256());
}

TEST(SpinInRpm, IsRefusedBesideAnotherWayToGiveTheRates) {
  expect_one(replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rad_s\": 200, \"spin_rpm\": 1910"), "3:49 /release/spin_rpm",
             "spin_rad_s and spin_rpm are both given; give exactly one");
  expect_one(replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rpm\": 1910, \"angular_velocity_body_rad_s\": [0, 0, 1]"),
             "3:48 /release/angular_velocity_body_rad_s", "spin_rpm and angular_velocity_body_rad_s are both given");
  expect_one(replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rpm\": 1e10"), "3:42 /release/spin_rpm", "out of range");
  expect_one(replaced(kMinimal, "\"spin_rad_s\": 200", "\"spin_rpm\": \"1910\""), "3:42 /release/spin_rpm", "must be a number");
  expect_one(replaced(kMinimal, "spin_rad_s", "spin_rmp"), "3:30 /release/spin_rmp", "did you mean \"spin_rpm\"");
  expect_one(replaced(kMinimal, ", \"spin_rad_s\": 200", ""), "3:13 /release/spin_rad_s", "spin_rad_s or spin_rpm");
}

/// A change gives the spin anew, in whichever unit; two changes that give it twice are refused.
TEST(SpinInRpm, AChangeTakesThePlaceOfTheOtherUnit) {
  EXPECT_EQ(parse(kMinimal, {{"/release/spin_rpm", "60"}}).release.spin_rad_s, rad_s_from_rpm(60));
  EXPECT_EQ(parse(kInRpm, {{"/release/spin_rad_s", "60"}}).release.spin_rad_s, 60);
  EXPECT_EQ(parse(kInRpm, {{"/release/spin_rpm", "60"}}).release.spin_rad_s, rad_s_from_rpm(60));
  EXPECT_EQ(parse(kInRpm, {{"/release/tilt_deg", "10"}}).release.spin_rad_s, rad_s_from_rpm(1910));
  expect_set({{"/release/spin_rpm", "60"}, {"/release/spin_rad_s", "6"}}, "/release/spin_rpm", "both given");
  expect_set({{"/release", R"({"tilt_deg": 20, "spin_rpm": 60, "spin_rad_s": 6})"}}, "/release/spin_rpm", "both given");
}

TEST(SpinInRpm, GoesWithPrecessionQuaternionAndTable) {
  EXPECT_EQ(parse(kInRpm, {{"/release/precession", "steady_slow"}}).release.precession, Precession::steady_slow);
  const Scenario turned =
      parse(kMinimal, {{"/release", R"({"quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0}, "spin_rpm": 30})"}});
  EXPECT_EQ(turned.release.spin_rad_s, rad_s_from_rpm(30));
  const Scenario table = parse(kInRpm, {{"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}});
  EXPECT_EQ(table.release.spin_rad_s, rad_s_from_rpm(1910));
}

TEST(SpinInRpm, ABurstingRimIsNotTakenForAnotherUnit) {
  const auto warning = [](const std::string& key, const std::string& value) {
    const ScenarioReport report = examine_scenario({"", kMinimal}, {{key, value}});
    return report.warnings.empty() ? "" : report.warnings.front().message;
  };
  EXPECT_NE(warning("/release/spin_rad_s", "200000").find("revolutions per minute"), std::string::npos);
  const std::string in_rpm = warning("/release/spin_rpm", "1909859");
  EXPECT_NE(in_rpm.find("and burst"), std::string::npos);
  EXPECT_EQ(in_rpm.find("revolutions per minute"), std::string::npos);
}

}  // namespace
}  // namespace earthtop::scenario_test
