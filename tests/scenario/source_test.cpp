// SPDX-License-Identifier: GPL-3.0-or-later
// Reading files, --set, output times and the canonical form.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "support.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::scenario_test {
namespace {

class ScenarioFile : public ::testing::Test {
 protected:
  static void expect_refused(const std::string& path, const std::string& part) {
    try {
      read_scenario_source(path);
      FAIL() << path;
    } catch (const ScenarioError& error) {
      EXPECT_EQ(error.file(), path);
      ASSERT_EQ(error.diagnostics().size(), 1u);
      EXPECT_NE(error.diagnostics()[0].message.find(part), std::string::npos) << error.what();
    }
  }

  testing::TemporaryDirectory temporary_;
  const std::filesystem::path directory_ = temporary_.path();
};

TEST_F(ScenarioFile, IsReadWhole) {
  const std::string path = directory_ / "top.json";
  std::ofstream(path) << kMinimal;
  const ScenarioSource source = read_scenario_source(path);
  EXPECT_EQ(source.file, path);
  EXPECT_EQ(source.text, kMinimal);
  EXPECT_EQ(parse_scenario(source).name, "top");
}

TEST_F(ScenarioFile, WhatIsNoFileIsRefusedAtOnce) {
  expect_refused(directory_ / "none.json", "there is no such file");
  expect_refused("", "there is no such file");
  expect_refused(directory_, "is a directory");
  expect_refused("/dev/null", "is not a regular file");
  const std::string fifo = directory_ / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  expect_refused(fifo, "is a FIFO");  // and does not wait for a writer
  const std::string unreadable = directory_ / "unreadable.json";
  std::ofstream(unreadable) << kMinimal;
  ::chmod(unreadable.c_str(), 0);
  if (::access(unreadable.c_str(), R_OK) != 0) expect_refused(unreadable, "cannot be opened");
}

TEST_F(ScenarioFile, SixteenMebibytesAreTheLimit) {
  const std::string path = directory_ / "large.json";
  std::ofstream(path) << std::string(std::size_t{16} << 20, ' ');
  EXPECT_EQ(read_scenario_source(path).text.size(), std::size_t{16} << 20);
  std::ofstream(path, std::ios::app) << ' ';
  expect_refused(path, "more than 16 MiB");
}

TEST_F(ScenarioFile, DashIsStandardInput) {
  const std::string path = directory_ / "input.json";
  std::ofstream(path) << kMinimal;
  const int saved = ::dup(STDIN_FILENO), file = ::open(path.c_str(), O_RDONLY);
  ASSERT_GE(file, 0);
  ::dup2(file, STDIN_FILENO);
  const ScenarioSource source = read_scenario_source("-");
  if (saved >= 0) ::dup2(saved, STDIN_FILENO), ::close(saved);
  ::close(file);
  EXPECT_EQ(source.file, "<stdin>");
  EXPECT_EQ(source.text, kMinimal);
}

TEST(ScenarioOverrides, ReplaceAddAndCreate) {
  const Scenario s = parse(kMinimal, {{"/site/latitude_deg", "-12.5"},
                                      {"/earth/rotation_rate_rad_s", "1"},
                                      {"/body/center_of_mass_m/2", "0.02"},
                                      {"/name", "other"},
                                      {"/title", "two words"},
                                      {"/site/latitude_deg", "12.5"}});
  EXPECT_EQ(s.site.latitude_deg, 12.5);  // the last one counts
  EXPECT_EQ(s.rotation_rate_rad_s, 1);
  EXPECT_EQ(s.body.center_of_mass_m[2], 0.02);
  EXPECT_EQ(s.name, "other");
  EXPECT_EQ(s.title, "two words");
}

TEST(ScenarioOverrides, MendsTheFile) {
  EXPECT_EQ(parse(replaced(kMinimal, "45", "\"x\""), {{"/site/latitude_deg", "1"}}).site.latitude_deg, 1);
  EXPECT_EQ(parse(replaced(kMinimal, "\"latitude_deg\": 45", ""), {{"/site/latitude_deg", "1"}}).site.latitude_deg, 1);
}

TEST(ScenarioOverrides, MalformedPointersAreRefused) {
  for (const std::string pointer : {"", "site", "site/latitude_deg", "/site~2x", "/site~"})
    expect_set({{pointer, "1"}}, pointer, "malformed JSON pointer");
  expect_set({{"/site/latitude_deg/x", "1"}}, "/site/latitude_deg/x", "leads through a number");
  expect_set({{"/body/center_of_mass_m/3", "1"}}, "/body/center_of_mass_m/3", "\"3\" is not an index of an array of 3");
  expect_set({{"/body/center_of_mass_m/-", "1"}}, "/body/center_of_mass_m/-", "not an index");
  expect_set({{"/body/center_of_mass_m/01", "1"}}, "/body/center_of_mass_m/01", "not an index");
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "/a";
  EXPECT_EQ(found_in(kMinimal, {{deep, "1"}}).places.size(), 1u);
}

TEST(ScenarioOverrides, ValuesAreStrictAndSayWhereTheyComeFrom) {
  expect_set({{"/site/latitude_deg", "95"}}, "/site/latitude_deg", "(from --set)");
  expect_set({{"/site/latitude_deg", "1e999"}}, "/site/latitude_deg", "too large for a double");
  expect_set({{"/site/latitude_deg", "1e-400"}}, "/site/latitude_deg", "too small for a double");
  expect_set({{"/site/latitude_deg", "NaN"}}, "/site/latitude_deg", "is \"NaN\"");
  expect_set({{"/site/latitude_deg", "45 deg"}}, "/site/latitude_deg", "is \"45 deg\"");
  expect_set({{"/site/latitude", "45"}}, "/site/latitude", "did you mean \"latitude_deg\"");
  expect_set({{"/numerics", R"({"method": "auto", "method": "auto"})"}}, "/numerics/method", "duplicate key");
  // From --set first, then by place.
  const Found found = found_in(replaced(kMinimal, "45", "95"), {{"/motion/duration_s", "-1"}});
  EXPECT_EQ(found.places, (std::vector<std::string>{"0:0 /motion/duration_s", "1:27 /site/latitude_deg"}));
}

TEST(OutputTimes, AreProductsAndEndAtTheDuration) {
  const auto times = output_times(60, 0.1);
  ASSERT_EQ(times.size(), 601u);
  for (std::size_t k = 0; k < 600; ++k) EXPECT_EQ(times[k], static_cast<double>(k) * 0.1);
  EXPECT_EQ(times.back(), 60);
  EXPECT_EQ(output_times(1, 0.3), (std::vector<double>{0, 0.3, 2 * 0.3, 3 * 0.3, 1}));
  EXPECT_EQ(output_times(0.3, 0.1), (std::vector<double>{0, 0.1, 0.2, 0.3}));  // 3 x 0.1 is above 0.3
  EXPECT_EQ(output_times(1, 1), (std::vector<double>{0, 1}));
  EXPECT_EQ(output_times(1, 2), (std::vector<double>{0, 1}));
  EXPECT_EQ(output_times(1, 1e12), (std::vector<double>{0, 1}));  // the duration lies within 1e-9 step of 0
  EXPECT_EQ(output_times(1 + 0.4e-9, 0.5), (std::vector<double>{0, 0.5, 1 + 0.4e-9}));
  EXPECT_EQ(output_times(1 + 0.6e-9, 0.5), (std::vector<double>{0, 0.5, 1, 1 + 0.6e-9}));
  EXPECT_EQ(output_times(1'999'999, 1).size(), 2'000'000u);
  struct Refused {
    double duration_s, step_s;
    const char* says;
  };
  for (const auto& [duration, step, says] : {Refused{2'000'000, 1, "about 2000001 output rows; at most 2000000 are allowed"},
                                             {1, 0, "0 is not a time step; must be above 0 (s)"},
                                             {0, 1, "0 is not a duration; must be above 0 (s)"},
                                             {-1, 1, "-1 is not a duration; must be above 0 (s)"},
                                             {1, NAN, "nan is not a time step; must be above 0 (s)"},
                                             {INFINITY, 1, "inf is not a duration; must be above 0 (s)"}}) {
    try {
      output_times(duration, step);
      ADD_FAILURE() << says;
    } catch (const ScenarioError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  }
  for (const double duration : {1.0, 0.7, 1e-3, 86164.1, 3e7 / 7}) {
    const auto rows = output_times(duration, duration / 1000);
    EXPECT_EQ(rows.size(), 1001u) << duration;
    EXPECT_EQ(rows.back(), duration);
  }
}

TEST(CanonicalScenario, FormattingCommentsAndSpelledOutDefaultsDoNotMatter) {
  const std::string canonical = identity_json(parse(kMinimal));
  EXPECT_EQ(canonical.find('\n'), std::string::npos);
  const std::string compact = testing::text_of(testing::parse_json(kMinimal));
  EXPECT_EQ(identity_json(parse(compact)), canonical);
  const Overrides spelled_out = {
      {"/$schema", "earthtop-scenario-1.json"},
      {"/name", "minimal"},
      {"/title", "any"},
      {"/_comment", "any"},
      {"/site/longitude_deg", "-0.0"},
      {"/site/height_m", "0"},
      {"/earth/rotation_rate_rad_s", "0.00007292115"},
      {"/body/inertia", R"({"about": "pivot", "matrix_kg_m2": [[2e-4,0,0],[0,0.0002,0],[0,0,4e-5]]})"},
      {"/release/azimuth_deg", "0"},
      {"/release/spin_angle_deg", "0"},
      {"/release/rates_relative_to", "laboratory"},
      {"/release/precession", "none"},
      {"/motion/output_step_s", "0.06"},
      {"/effects", R"({"coriolis": true, "centrifugal": true, "transverse": true})"},
      {"/numerics", R"({"method": "auto", "observer": "laboratory", "precision": "double", "relative_tolerance": 1e-12})"},
      {"/accuracy", "{}"},
      {"/report", "{}"}};
  for (const auto& one : spelled_out) EXPECT_EQ(identity_json(parse(kMinimal, {one})), canonical) << one.first;
  EXPECT_EQ(identity_json(parse(kMinimal, spelled_out)), canonical);
}

}  // namespace
}  // namespace earthtop::scenario_test
