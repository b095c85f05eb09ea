// SPDX-License-Identifier: GPL-3.0-or-later
// A journey of the laboratory: its keys, knots, its table, and bad input, which is refused with the place and a remedy.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>

#include "earthtop/frames/site.hpp"
#include "support.hpp"
#include "support/refusals.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::scenario_test {
namespace {

constexpr const char* kSailing = R"({"path": "rhumb", "course_deg": 30, "speed_m_s": 10})";
constexpr const char* kHeader = "t_s,latitude_deg,longitude_deg,height_m\n";
constexpr const char* kRows = "0,45,10,100\n20,45.001,10.002,101\n40,45.002,10.004,102\n60,45.003,10.006,100\n";
constexpr const char* kByTable = R"({"path": "table", "file": "voyage.csv"})";

/// A journey with these keys beside those of `kSailing`.
std::string sailing(const std::string& more) { return replaced(kSailing, "}", ", " + more + "}"); }

Scenario travelling(const std::string& travel, const Overrides& more = {}) {
  Overrides overrides{{"/travel", travel}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return parse(kMinimal, overrides);
}

std::string site_of(double latitude_deg, double longitude_deg, double height_m) {
  return fmt::format(R"({{"latitude_deg": {}, "longitude_deg": {}, "height_m": {}}})", latitude_deg, longitude_deg, height_m);
}

/// A scene beside a table of places.
class Voyage : public ::testing::Test {
 protected:
  /// @param rows  of the table   @param site  JSON
  Scenario read(const std::string& rows, const std::string& site) const {
    return parse_scenario(source(rows), {{"/travel", kByTable}, {"/site", site}});
  }
  ScenarioSource source(const std::string& rows) const {
    std::ofstream(temporary_.path() / "voyage.csv") << kHeader << rows;
    return {(temporary_.path() / "minimal.json").string(), kMinimal};
  }
  void expect_refused(const std::string& rows, const std::string& site, const char* pointer, const char* words) const {
    testing::expect_refused(source(rows), {{{"/travel", kByTable}, {"/site", site}}, pointer, words});
  }

 private:
  testing::TemporaryDirectory temporary_;
};

TEST(Travel, KeysAreReadAndWritten) {
  const Scenario s = travelling(R"({
    "path": "geodesic", "course_deg": -90, "speed_kn": 36, "reference": "at_rest", "eotvos": "off", "figure": "sphere",
    "radius_m": 6.4e6,
    "legs": [{"duration_s": 60}, {"duration_s": 5, "speed_m_s": 7, "turn_deg": -3}, {"duration_s": 9, "speed_kn": 18, "climb_m": 2}]})");
  TravelSpec expected;
  expected.path = TravelPath::geodesic;
  expected.course_deg = -90;
  expected.speed_m_s = 18.52;
  expected.legs = {{60, {}, 0, 0}, {5, 7, -3, 0}, {9, 9.26, 0, 2}};
  expected.reference = TravelReference::at_rest;
  expected.eotvos = TravelEotvos::off;
  expected.figure = TravelFigure::sphere;
  expected.radius_m = 6.4e6;
  expected.has_normal_gravity = true;
  ASSERT_TRUE(s.travel);
  EXPECT_EQ(*s.travel, expected);
  const std::string canonical = canonical_json(s);
  EXPECT_EQ(parse(canonical), s);
  EXPECT_EQ(canonical_json(parse(canonical)), canonical);
  EXPECT_NE(identity_json(s), identity_json(parse(kMinimal)));
}

TEST(Travel, DefaultsAreThoseOfTheSpecification) {
  TravelSpec expected;
  expected.course_deg = 30;
  expected.speed_m_s = 10;
  expected.has_normal_gravity = true;
  const Scenario s = travelling(kSailing);
  EXPECT_EQ(s.travel, expected);
  EXPECT_EQ(expected.reference, TravelReference::same_path);
  EXPECT_EQ(expected.eotvos, TravelEotvos::rotating);
  EXPECT_EQ(expected.figure, TravelFigure::wgs84);
  EXPECT_EQ(expected.radius_m, 6371008.7714);
  // A key that does not belong to it is not written, as it would be refused.
  EXPECT_NE(canonical_json(s).find(R"("travel":{"course_deg":30.0,"eotvos":"rotating","figure":"wgs84","path":"rhumb",)"
                                   R"("reference":"same_path","speed_m_s":10.0})"),
            std::string::npos)
      << canonical_json(s);
  EXPECT_FALSE(parse(kMinimal).travel);
  EXPECT_EQ(canonical_json(parse(kMinimal)).find("travel"), std::string::npos);
}

/// A product with the rounded 1852/3600 misses about half of these; so does a second conversion of the canonical text.
TEST(Travel, KnotsAreTheNearestNumberInMetresPerSecond) {
  std::mt19937_64 random(24);
  for (int i = 0; i < 300; ++i) {
    const double knots = std::ldexp(static_cast<double>(random() >> 11), -40);
    const Scenario s = travelling(fmt::format(R"({{"path": "rhumb", "course_deg": 90, "speed_kn": {}}})", knots));
    const double speed = s.travel->speed_m_s;
    const auto off = [&](double x) {  // 900 x - 463 knots, in 113 bits exact but for a rounding
      const float128 difference = float128(x) * 900 - float128(knots) * 463;
      return difference < 0 ? -difference : difference;
    };
    EXPECT_LE(off(speed), off(std::nextafter(speed, 1e9))) << knots;
    EXPECT_LE(off(speed), off(std::nextafter(speed, 0))) << knots;
    const std::string canonical = canonical_json(s);
    EXPECT_EQ(canonical.find("speed_kn"), std::string::npos);
    EXPECT_EQ(parse(canonical), s);
  }
  EXPECT_LE(travelling(R"({"path": "rhumb", "course_deg": 90, "speed_kn": 194384})").travel->speed_m_s, 1e5);
}

// A change gives the speed anew, in whichever unit; two changes that give it twice are refused.
TEST(Travel, AChangeTakesThePlaceOfTheOtherUnit) {
  const auto with = [](const std::string& travel) {
    return replaced(kMinimal, "\"release\"", "\"travel\": " + travel + ", \"release\"");
  };
  const std::string text = with(R"({"path": "rhumb", "course_deg": 30, "speed_kn": 36})");
  EXPECT_EQ(parse(with(kSailing), {{"/travel/speed_kn", "36"}}).travel->speed_m_s, 18.52);
  EXPECT_EQ(parse(text, {{"/travel/speed_m_s", "7"}}).travel->speed_m_s, 7);
  EXPECT_EQ(parse(text, {{"/travel/speed_kn", "18"}}).travel->speed_m_s, 9.26);
  EXPECT_EQ(parse(text, {{"/travel/course_deg", "7"}}).travel->speed_m_s, 18.52);
  EXPECT_EQ(parse(changed_text(text, {{"/travel/speed_m_s", "7"}})).travel->speed_m_s, 7);
  testing::expect_refused({"minimal.json", text},
                          {{{"/travel/speed_m_s", "7"}, {"/travel/speed_kn", "7"}}, "/travel/speed_kn", "both given"});
}

TEST_F(Voyage, BeginsWhereItsTableDoes) {
  const Scenario s = read(kRows, "{}");
  EXPECT_EQ(s.site.latitude_deg, 45);
  EXPECT_EQ(s.site.longitude_deg, 10);
  EXPECT_EQ(s.site.height_m, 100);
  EXPECT_EQ(s.site.gravity_m_s2, normal_gravity(45, 100));
  ASSERT_EQ(tables_of(s).size(), 1U);  // one file
  EXPECT_EQ(tables_of(s).front()->rows->value, (std::vector<double>{45, 45.001, 45.002, 45.003}));
  EXPECT_EQ(s.travel->table[1].rows->value, (std::vector<double>{10, 10.002, 10.004, 10.006}));
  EXPECT_EQ(s.travel->table[2].rows->value, (std::vector<double>{100, 101, 102, 100}));
  const std::string canonical = canonical_json(s);
  EXPECT_NE(canonical.find("\"file_sha256\":\"" + s.travel->table[0].file_sha256), std::string::npos);
  ScenarioSource again = source(kRows);
  again.text = canonical;
  EXPECT_EQ(parse_scenario(again), s);
  // Another file is another run, though it begins at the same place.
  EXPECT_NE(identity_json(read("0,45,10,100\n20,45,10,100\n40,45,10,100\n60,45,10,100\n", "{}")), identity_json(s));
}

TEST_F(Voyage, BeginsBetweenRowsWhereTheSplineIs) {
  const Scenario s = read("-10,45,10,90\n20,45.003,10.006,120\n40,45.005,10.01,140\n60,45.007,10.014,160\n", "{}");
  // All three go evenly: what is left is rounding, a hundred of a number's last digits.
  const auto rounding = [](double x) { return 100 * std::numeric_limits<double>::epsilon() * x; };
  EXPECT_NEAR(s.site.latitude_deg, 45.001, rounding(45));
  EXPECT_NEAR(s.site.longitude_deg, 10.002, rounding(10));
  EXPECT_NEAR(s.site.height_m, 100, rounding(100));
}

TEST_F(Voyage, MayBeSaidToBeginThere) {
  EXPECT_EQ(read(kRows, site_of(45 + 9e-10, 10 - 9e-10, 100 + 9e-7)).site.height_m, 100 + 9e-7);
  EXPECT_EQ(read(kRows, site_of(45, -350, 100)).site.longitude_deg, -350);  // the same place
  expect_refused(kRows, site_of(45 + 1.1e-9, 10, 100), "/site/latitude_deg", "the table of /travel begins at 45 at t = 0");
  expect_refused(kRows, site_of(45, 10.001, 100), "/site/longitude_deg", "must be the same to 1e-09, or leave it out");
  expect_refused(kRows, site_of(45, 10, 100 + 1.1e-6), "/site/height_m", "must be the same to 1e-06");
}

TEST_F(Voyage, GoesRoundTheEarthWithoutJumps) {
  const auto longitudes = [&](const char* rows) { return read(rows, "{}").travel->table[1].rows->value; };
  EXPECT_EQ(longitudes("0,45,179.75,0\n20,45,-179.875,0\n40,45,-179.5,0\n60,45,179.875,0\n"),
            (std::vector<double>{179.75, 180.125, 180.5, 179.875}));
  EXPECT_EQ(longitudes("0,45,0.25,0\n20,45,359.75,0\n40,45,359.5,0\n60,45,0.5,0\n"),
            (std::vector<double>{0.25, -0.25, -0.5, 0.5}));
  // Near the pole half a turn is a short way; it is none by which a row could be turned.
  EXPECT_EQ(longitudes("0,89.8,-90,0\n20,89.8,90,0\n40,89.8,90,0\n60,89.8,90,0\n"), (std::vector<double>{-90, 90, 90, 90}));
  // A journey twice round before t = 0 leads to a longitude that a site may have.
  const Scenario s = read("-4000,89,0,0\n-3000,89,120,0\n-2000,89,240,0\n-1000,89,0,0\n0,89,120,0\n60,89,121,0\n", "{}");
  EXPECT_EQ(s.travel->table[1].rows->value[4], 480);
  EXPECT_EQ(s.site.longitude_deg, 120);
}

TEST_F(Voyage, BadTablesAreRefused) {
  const std::string rest = "20,45.001,10.002,101\n40,45.002,10.004,102\n60,45.003,10.006,100\n";
  expect_refused("0,45,10,100\n20,45,10,100\n40,45,10,100\n59,45,10,100\n", "{}", "/travel/file",
                 "must reach the duration, 60 s");
  expect_refused("1,45,10,100\n" + rest, "{}", "/travel/file", "it must begin at 0 s");
  expect_refused("0,45,10\n" + rest, "{}", "/travel/file", "must be 4 numbers with commas between them");
  expect_refused("0,95,10,100\n" + rest, "{}", "/travel/file",
                 "voyage.csv:2: latitude_deg is 95; East and North lose their meaning");
  expect_refused("0,45,370,100\n" + rest, "{}", "/travel/file", "voyage.csv:2: longitude_deg is 370; must be from -360 to 360");
  expect_refused("0,45,10,-2e4\n" + rest, "{}", "/travel/file", "height_m is -20000; must be from -12000 to 1e6");
  // 20 deg of the meridian in 20 s, and 1 degree of the parallel in 0.5 s
  expect_refused("0,45,10,100\n20,65,10,100\n40,65,10,100\n60,65,10,100\n", "{}", "/travel/file",
                 "voyage.csv:3: is reached at about 1.11e+05 m/s from the row before; at most 100000 are allowed");
  expect_refused("0,45,10,100\n0.5,45,11,100\n40,45,11,100\n60,45,11,100\n", "{}", "/travel/file", "about 1.57e+05 m/s");
  expect_refused("0,45,10,100\n1e-6,45,10,1000\n2e-6,45,10,0\n60,45,11,100\n", "{}", "/travel/file",
                 "the places in degrees and metres");
}

/// A fault of a journey, as a JSON value for /travel, or beside one.
const testing::Refusal kRefusals[] = {
    {{{"/travel", "{}"}}, "/travel/path", "must be \"rhumb\", \"geodesic\", \"table\""},
    {{{"/travel", "true"}}, "/travel", "must be an object"},
    {{{"/travel", R"({"path": "loxodrome"})"}}, "/travel/path", "must be \"rhumb\""},
    {{{"/travel", R"({"path": "rhumb", "speed_m_s": 1})"}},
     "/travel/course_deg",
     "is missing; must be a number from -360 to 360"},
    {{{"/travel", R"({"path": "geodesic", "course_deg": 1})"}}, "/travel/speed_m_s", "neither speed_m_s nor speed_kn is given"},
    {{{"/travel", sailing(R"("speed_kn": 20)")}},
     "/travel/speed_kn",
     "speed_m_s and speed_kn are both given; give exactly one"},
    {{{"/travel", sailing(R"("speed_km_h": 20)")}}, "/travel/speed_km_h", "1 km/h = 0.277777777777778 m/s"},
    {{{"/travel/path", "rhumb"}, {"/travel/course_deg", "0"}, {"/travel/speed_m_s", "100001"}},
     "/travel/speed_m_s",
     "from 0 to"},
    {{{"/travel/path", "rhumb"}, {"/travel/course_deg", "0"}, {"/travel/speed_kn", "-1"}},
     "/travel/speed_kn",
     "from 0 to 194384"},
    {{{"/travel/path", "rhumb"}, {"/travel/course_deg", "361"}, {"/travel/speed_kn", "1"}},
     "/travel/course_deg",
     "from -360 to 360"},
    {{{"/travel", sailing(R"("file": "voyage.csv")")}},
     "/travel/file",
     "does not belong to the path \"rhumb\"; allowed with it: course_deg"},
    {{{"/travel", R"({"path": "table"})"}}, "/travel/file", "is missing"},
    {{{"/travel", R"({"path": "table", "file": "none.csv"})"}}, "/travel/file", "no such file"},
    {{{"/travel", R"({"path": "table", "file": "none.csv", "speed_kn": 3})"}},
     "/travel/speed_kn",
     "does not belong to the path \"table\"; allowed with it: file, file_sha256"},
    {{{"/travel", R"({"path": "table", "file": "none.csv", "legs": [{"duration_s": 1}]})"}},
     "/travel/legs",
     "does not belong to the path \"table\""},
    {{{"/travel", sailing(R"("legs": [{"turn_deg": 90}])")}}, "/travel/legs/0/duration_s", "is missing"},
    {{{"/travel", sailing(R"("legs": [{"duration_s": 1}, {"duration_s": 0}])")}}, "/travel/legs/1/duration_s", "above 0"},
    {{{"/travel", sailing(R"("legs": [{"duration_s": 9, "speed_m_s": 1, "speed_kn": 2}])")}},
     "/travel/legs/0/speed_kn",
     "both given"},
    {{{"/travel", sailing(R"("legs": [{"duration_s": 9, "bank_deg": 2}])")}}, "/travel/legs/0/bank_deg", "unknown key"},
    {{{"/travel", sailing(R"("legs": [])")}}, "/travel/legs", "at least one object"},
    {{{"/travel", sailing(R"("radius_m": 6.4e6)")}}, "/travel/radius_m", "belongs to the figure \"sphere\""},
    {{{"/travel", sailing(R"("figure": "sphere", "radius_m": 0)")}}, "/travel/radius_m", "above 0"},
    {{{"/travel", sailing(R"("figure": "geoid")")}}, "/travel/figure", "must be \"wgs84\""},
    {{{"/travel", sailing(R"("reference": "at_rest", "eotvos": "both")")}},
     "/travel/eotvos",
     "stays where it is and has no Eotvos term; must be \"rotating\" or \"off\""},
    {{{"/travel", kSailing}, {"/site", R"({"latitude_deg": -89.95})"}},
     "/site/latitude_deg",
     "near a pole East and North turn too fast to travel by them"},
    {{{"/travel", kSailing}, {"/site", R"({"gravity_m_s2": 9.8})"}, {"/earth", R"({"rotation_rate_rad_s": 0})"}},
     "/site/latitude_deg",
     "is missing; the journey begins there"},
    {{{"/travel", kSailing}, {"/contact", R"({"tip_radius_m": 0.002, "law": "frictionless"})"}},
     "/contact",
     "the table on which a top stands does not travel yet; leave one of the two out"},
    {{{"/travel", kSailing}, {"/effects/tide", R"({"amplitude_m_s2": [1e-6, 0, 0], "frequency_hz": 1e-5})"}},
     "/effects/tide",
     "belongs to one place, and is not carried along; leave one of the two out"},
    {{{"/travel", kSailing}, {"/effects/polar_motion", R"({"x_arcsec": 0.1, "y_arcsec": 0.3})"}},
     "/effects/polar_motion",
     "leave one of the two out"},
    {{{"/travel", kSailing}, {"/effects/deflection_of_vertical", R"({"north_arcsec": 3})"}},
     "/effects/deflection_of_vertical",
     "leave one of the two out"},
    {{{"/travel", kSailing}, {"/effects/excess_length_of_day_ms", "1"}},
     "/effects/excess_length_of_day_ms",
     "give the changed rate as /earth/rotation_rate_rad_s"},
    {{{"/travel", kSailing}, {"/effects/gravity_gradient", "normal"}},
     "/effects/gravity_gradient",
     "take true, the radial term"},
    {{{"/travel", kSailing}, {"/effects/coriolis", "false"}}, "/effects/coriolis", "has a share in all three torques"},
    {{{"/travel", kSailing}, {"/effects/centrifugal", "false"}}, "/effects/centrifugal", "leave one of the two out"},
    {{{"/travel", kSailing}, {"/effects/transverse", "false"}}, "/effects/transverse", "leave one of the two out"},
    {{{"/travel", kSailing}, {"/effects/gimbal", "true"}, {"/release/tilt_deg", "90"}},
     "/effects/gimbal",
     "take /gimbals, with the inner one locked"},
    {{{"/travel", kSailing}, {"/effects/coulomb_torque_N_m", "1e-6"}},
     "/effects/coulomb_torque_N_m",
     "dry friction that brings a motion to rest is not modelled aboard"},
    {{{"/platform", R"({"motion": "course"})"}},
     "/platform/motion",
     "is \"course\", and there is no journey whose course the platform could turn with"},
    {{{"/travel", kSailing}, {"/platform", R"({"motion": "course", "axis": [0, 0.1, 1]})"}},
     "/platform/axis",
     "a vehicle turns with its course about Up; leave it out"},
    {{{"/travel", kSailing}, {"/platform", R"({"motion": "course", "rate_rad_s": 1})"}},
     "/platform/rate_rad_s",
     "does not belong to \"course\" motion"},
    {{{"/travel", kSailing}, {"/effects", "auto"}, {"/accuracy/drift_rad", "1e-9"}},
     "/effects",
     "sizes effects for a laboratory at rest"},
    {{{"/travel", kSailing}, {"/effects/select", "auto"}, {"/accuracy/drift_rad", "1e-9"}},
     "/effects/select",
     "name the effects instead"},
};

TEST(Travel, BadInputIsRefusedWithPlaceAndRemedy) {
  for (const testing::Refusal& refusal : kRefusals) testing::expect_refused({"dir/minimal.json", kMinimal}, refusal);
  std::string many = R"("legs": [{"duration_s": 1})";
  for (int i = 0; i < 10000; ++i) many += R"(, {"duration_s": 1})";
  testing::expect_refused({"dir/minimal.json", kMinimal},
                          {{{"/travel", sailing(many + "]")}}, "/travel/legs", "has 10001 legs; at most 10000 are allowed"});
}

/// A part that is switched off, or acts without a change, is not refused.
TEST(Travel, WhatDoesNotActBesideItIsTaken) {
  for (const auto& [pointer, value] :
       {std::pair("/effects/tide", "false"), std::pair("/effects/polar_motion", "false"), std::pair("/effects/gimbal", "false"),
        std::pair("/effects/coriolis", "true"), std::pair("/effects/excess_length_of_day_ms", "0"),
        std::pair("/effects/gravity_gradient", "true"), std::pair("/effects/viscous_torque_N_m_s", "1e-6"),
        std::pair("/site/latitude_deg", "-89.9")})
    EXPECT_NO_THROW(travelling(kSailing, {{pointer, value}})) << pointer;
}

/// Returns the warnings of a journey, each with its place.
std::string warnings(const std::string& travel) {
  std::string all;
  for (const Diagnostic& warning : examine_scenario({"minimal.json", kMinimal}, {{"/travel", travel}}).warnings)
    all += warning.pointer + ": " + warning.message + '\n';
  return all;
}

/// 15/8 of the mean is the largest rate of a leg: the limits lie at 5.333 deg/s and at 5.2302 m/s^2 of the means.
TEST(Travel, LegsThatNoVehicleFollowsAreWarnedOf) {
  const auto with = [](const char* leg) {
    return warnings(sailing(fmt::format(R"("legs": [{{"duration_s": 60}}, {}])", leg)));
  };
  EXPECT_EQ(with(R"({"duration_s": 9, "turn_deg": -47.9})"), "");
  EXPECT_NE(with(R"({"duration_s": 9, "turn_deg": -48.1})")
                .find("/travel/legs/1/turn_deg: the course turns at up to 10.02 deg/s, as no ship or aircraft does"),
            std::string::npos);
  EXPECT_EQ(with(R"({"duration_s": 10, "speed_m_s": 62.3})"), "");
  EXPECT_NE(
      with(R"({"duration_s": 10, "speed_m_s": 62.4})")
          .find("/travel/legs/1/speed_m_s: from 10 to 62.4 m/s the laboratory accelerates at up to 9.82 m/s^2, more than"),
      std::string::npos)
      << with(R"({"duration_s": 10, "speed_m_s": 62.4})");
  // A leg begins with the speed of the one before, and stopping is a change, too.
  EXPECT_EQ(warnings(sailing(
                R"("legs": [{"duration_s": 20, "speed_m_s": 90}, {"duration_s": 5}, {"duration_s": 1, "speed_kn": 175}])")),
            "");
  EXPECT_NE(
      warnings(sailing(R"("legs": [{"duration_s": 1, "speed_kn": 0}])")).find("/travel/legs/0/speed_kn: from 10 to 0 m/s"),
      std::string::npos);
}

/// White noise of sigma in rows that are D apart is an acceleration of 6 sigma/D^2: 1 m at 1 s is 6 m/s^2.
TEST_F(Voyage, TheNoiseOfItsDigitsIsKnown) {
  constexpr double kRounding = 1e-12;
  constexpr double kMetresADegree = kEquatorialRadiusWgs84 * std::numbers::pi / 180;
  const auto expect = [&](const std::string& rows, double expected) {
    EXPECT_NEAR(noise_of_table_m_s2(*read(rows, "{}").travel), expected, kRounding * expected) << rows;
  };
  expect("0,45,10,100\n1,45,10,101\n2,45,10,105\n60,45,10,100\n", 6);
  expect("0,45,10,100\n1,45,10,101.5\n2,45,10,105\n60,45,10,100\n", 0.6);
  expect("0,45,10,1e2\n2,45,10,1.01e2\n4,45,10,1.05E+2\n60,45,10,100\n", 6 / 4.0);
  expect("0,45,10,1.000e2\n2,45,10,101\n4,45,10,105\n60,45,10,100\n", 0.1 * 6 / 4);
  expect("0,45,10,0\n20,45.001,10,0\n40,45.0021,10,0\n60,45.003,10,0\n", 6 * 1e-4 * kMetresADegree / 400);
  expect("0,60,10,0\n20,60,10.001,0\n40,60,10.002,0\n60,60,10.003,0\n",
         6 * 1e-3 * kMetresADegree * std::cos(std::numbers::pi / 3) / 400);
  expect("0,45,10,0\n1,45,10,0\n2,45,10,0\n60,45,10,0\n", 0);
  EXPECT_EQ(noise_of_table_m_s2(*travelling(kSailing).travel), 0);
}

TEST_F(Voyage, ATableOfTooFewDigitsIsWarnedOf) {
  const auto warned = [&](const std::string& rows) {
    std::string all;
    for (const Diagnostic& warning : examine_scenario(source(rows), {{"/travel", kByTable}, {"/site", "{}"}}).warnings)
      all += warning.pointer + ": " + warning.message + '\n';
    return all;
  };
  EXPECT_NE(warned("0,45,10,100\n1,45,10,101\n2,45,10,105\n60,45,10,100\n")
                .find("/travel/file: an error of one unit in the last digit of its places is an acceleration of about 6 m/s^2"),
            std::string::npos);
  EXPECT_NE(warned("0,45,10,0\n77,45,10,1\n154,45,10,0\n231,45,10,0\n").find("about 0.00101 m/s^2"), std::string::npos);
  EXPECT_EQ(warned("0,45,10,0\n78,45,10,1\n156,45,10,0\n234,45,10,0\n"), "");
}

/// In the middle of a long table the spline through 0, 0, h, 0, 0 has the second derivative -6 (sqrt(3) - 1) h/D^2: the mean of its
/// response to all frequencies.
TEST_F(Voyage, OneThatNoVehicleFollowsIsWarnedOf) {
  const auto warned = [&](double height_m) {
    std::string rows, all;
    for (int i = 0; i <= 60; ++i) rows += fmt::format("{},45,10,{:.6f}\n", i, i == 30 ? height_m : 0);
    for (const Diagnostic& warning : examine_scenario(source(rows), {{"/travel", kByTable}, {"/site", "{}"}}).warnings)
      all += warning.pointer + ": " + warning.message + '\n';
    return all;
  };
  EXPECT_NE(
      warned(2.24).find("/travel/file: between its places the laboratory accelerates at up to 9.84 m/s^2, more than a free"),
      std::string::npos)
      << warned(2.24);
  EXPECT_EQ(warned(2.23), "");
}

TEST_F(Voyage, HasNoCourseForAVehicleToTurnWith) {
  testing::expect_refused(source(kRows), {{{"/travel", kByTable}, {"/site", "{}"}, {"/platform", R"({"motion": "course"})"}},
                                          "/platform/motion",
                                          "a journey by a table has no course where it stands; give the angle as a table"});
}

TEST(Travel, AGivenGravityThatHoldsFarIsWarnedOf) {
  const auto said = [](const char* course_deg, const char* gravity, const char* duration_s) {
    std::string all;
    for (const Diagnostic& warning :
         examine_scenario({"minimal.json", kMinimal},
                          {{"/travel", fmt::format(R"({{"path": "rhumb", "course_deg": {}, "speed_m_s": 1000}})", course_deg)},
                           {"/site", fmt::format(R"({{"latitude_deg": 45{}}})", gravity)},
                           {"/motion/duration_s", duration_s},
                           {"/motion/output_step_s", "10"}})
             .warnings)
      all += warning.pointer + ": " + warning.message + '\n';
    return all;
  };
  constexpr const char* kGravity = R"(, "gravity_m_s2": 9.81)";
  // One degree of the meridian has 111,130 m there.
  EXPECT_NE(said("0", kGravity, "112").find("/site/gravity_m_s2: holds along the whole journey, which leads 1.01 deg"),
            std::string::npos);
  EXPECT_NE(said("180", kGravity, "500").find("which leads 4.5 deg"), std::string::npos);
  EXPECT_EQ(said("0", kGravity, "110"), "");
  EXPECT_EQ(said("90", kGravity, "500"), "");
  EXPECT_EQ(said("0", "", "500"), "");
}

TEST(Travel, AJourneyThatLeadsNowhereIsWarnedOf) {
  const auto stays = [](const std::string& rest) {
    return warnings(R"({"path": "rhumb", "course_deg": 0, "speed_m_s": 0, "reference": "at_rest")" + rest + "}");
  };
  EXPECT_NE(stays("").find("/travel/reference: is \"at_rest\", and the journey leads nowhere: both motions are the same"),
            std::string::npos);
  EXPECT_NE(stays(R"(, "legs": [{"duration_s": 9, "turn_deg": 9}])").find("leads nowhere"), std::string::npos);
  EXPECT_EQ(stays(R"(, "legs": [{"duration_s": 9, "speed_m_s": 1}])"), "");
  EXPECT_EQ(stays(R"(, "legs": [{"duration_s": 9, "climb_m": -1}])"), "");
  EXPECT_EQ(warnings(R"({"path": "rhumb", "course_deg": 0, "speed_m_s": 0})"), "");
}

}  // namespace
}  // namespace earthtop::scenario_test
