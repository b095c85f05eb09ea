// SPDX-License-Identifier: GPL-3.0-or-later
// A platform's table of angles: its text, its file, and what is refused in both.
#include "scenario/angle_table.hpp"

#include <sys/stat.h>

#include <fstream>
#include <limits>

#include "earthtop/model/platform.hpp"
#include "support.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"
#include "text/sha256.hpp"

namespace earthtop::scenario_test {
namespace {

using scenario::kTableOfRates;
using scenario::parse_angle_table;
using scenario::TableFault;

const std::string kRows = "t_s,angle_rad\n0,0\n10,0.5\n30,-0.25\n60,1e-3\n";

TEST(AngleTableText, IsReadWithEitherLineEnd) {
  for (const std::string& text :
       {kRows, kRows.substr(0, kRows.size() - 1), std::string("t_s,angle_rad\r\n0,0\r\n10,0.5\r\n30,-0.25\r\n60,1e-3\r\n"),
        std::string("t_s,angle_rad\r\n0,0\n10,0.5\r\n30,-0.25\n60,1e-3")}) {
    const auto parsed = parse_angle_table(text, 60);
    ASSERT_TRUE(std::holds_alternative<AngleTable>(parsed)) << std::get<TableFault>(parsed).message;
    EXPECT_EQ(std::get<AngleTable>(parsed).t_s, (std::vector<double>{0, 10, 30, 60}));
    EXPECT_EQ(std::get<AngleTable>(parsed).value, (std::vector<double>{0, 0.5, -0.25, 1e-3}));
  }
  EXPECT_TRUE(std::holds_alternative<AngleTable>(parse_angle_table("t_s,angle_rad\n-1,0\n0,1\n1,0\n61,0\n", 60)));
}

TEST(AngleTableText, ItsFirstFaultIsNamedWithItsLine) {
  struct Case {
    std::string text;
    std::size_t line;
    std::string part;
  };
  const Case cases[] = {
      {"", 1, "must be the header"},
      {"0,0\n1,0\n2,0\n60,0\n", 1, "must be the header"},
      {"t_s, angle_rad\n0,0\n1,0\n2,0\n60,0\n", 1, "must be the header"},
      {"\xEF\xBB\xBF" + kRows, 1, "must be the header"},
      {"t_s,angle_rad\n0,0\n1,0\n60,0\n", 4, "after 3 rows; a spline needs at least 4"},
      {"t_s,angle_rad", 1, "after 0 rows"},
      {replaced(kRows, "10,", "10;"), 3, "one comma"},
      {replaced(kRows, "10,", "10,1,"), 3, "one comma"},
      {replaced(kRows, "10,0.5", "10"), 3, "one comma"},
      {replaced(kRows, "10,0.5\n", "\n"), 3, "is empty"},
      {kRows + "\n", 6, "is empty"},
      {replaced(kRows, "0.5", ""), 3, "angle_rad is \"\""},
      {replaced(kRows, "0.5", "half"), 3, "angle_rad is \"half\""},
      {replaced(kRows, "0.5", "0.5 "), 3, "finite number"},
      {replaced(kRows, "0.5", " 0.5"), 3, "finite number"},
      {replaced(kRows, "0.5", "nan"), 3, "finite number"},
      {replaced(kRows, "0.5", "1e999"), 3, "finite number"},
      {replaced(kRows, "0.5", "\xFF\x01"), 3, "\"\\xff\\x01\""},
      {replaced(kRows, "\n10,", "\ninf,"), 3, "t_s is \"inf\""},
      {replaced(kRows, "30,", "10,"), 4, "t_s is 10 after 10; times must ascend"},
      {replaced(kRows, "30,", "9,"), 4, "t_s is 9 after 10; times must ascend"},
      {replaced(kRows, "0,0\n", "0.5,0\n"), 2, "begins at 0.5 s; it must begin at 0 s"},
      {replaced(kRows, "60,", "59.5,"), 5, "ends at 59.5 s; it must reach the duration, 60 s"},
      {replaced(kRows, "10,0.5\n", "1e-200,0.5\n"), 5, "at most 1e+09 are allowed"},
      {replaced(kRows, "0.5", "1e300"), 5, "at most 1e+09 are allowed"},
      {replaced(replaced(kRows, "0.5", "1.5e308"), "-0.25", "-1.5e308"), 5, "at most 1e+09 are allowed"},
  };
  for (const Case& c : cases) {
    const auto parsed = parse_angle_table(c.text, 60);
    ASSERT_TRUE(std::holds_alternative<TableFault>(parsed)) << c.text;
    EXPECT_EQ(std::get<TableFault>(parsed).line, c.line) << c.text;
    EXPECT_NE(std::get<TableFault>(parsed).message.find(c.part), std::string::npos) << std::get<TableFault>(parsed).message;
  }
}

TEST(RateTable, HasItsOwnHeaderAndLimits) {
  const std::string text = "t_s,rate_rad_s\n0,300\n10,310\n30,1e9\n60,280\n";
  EXPECT_TRUE(std::holds_alternative<AngleTable>(parse_angle_table(text, 60, kTableOfRates)));
  EXPECT_TRUE(std::holds_alternative<TableFault>(parse_angle_table(kRows, 60, kTableOfRates)));
  const auto parsed = parse_angle_table(replaced(text, "1e9", "2e9"), 60, kTableOfRates);
  ASSERT_TRUE(std::holds_alternative<TableFault>(parsed));
  const std::string message = std::get<TableFault>(parsed).message;
  EXPECT_NE(message.find("reaches 2e+09 rad/s"), std::string::npos) << message;
  EXPECT_NE(message.find("the rates in rad/s"), std::string::npos) << message;
}

class TableFile : public ::testing::Test {
 protected:
  TableFile() { write("turn.csv", kRows); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(temporary_.path() / name) << text; }
  /// A scenario file in the directory whose platform follows a table.
  ScenarioReport examine(const std::string& file, const std::string& more = "") const {
    const std::string platform = " \"platform\": {\"motion\": \"table\", \"file\": \"" + file + "\"" + more + "}, \"motion\"";
    return examine_scenario({temporary_.path() / "scene.json", replaced(kMinimal, "\"motion\"", platform)});
  }
  void expect_refused(const std::string& file, const std::string& part, const std::string& more = "",
                      const std::string& key = "file") const {
    const ScenarioReport report = examine(file, more);
    ASSERT_EQ(report.error_count, 1u) << file;
    EXPECT_EQ(report.errors[0].pointer, "/platform/" + key);
    EXPECT_EQ(report.errors[0].line, 4);
    EXPECT_GT(report.errors[0].column, 30);  // the value itself
    EXPECT_NE(report.errors[0].message.find(part), std::string::npos) << report.errors[0].message;
  }
  testing::TemporaryDirectory temporary_;
};

TEST_F(TableFile, IsLookedForBesideTheScenario) {
  const ScenarioReport report = examine("turn.csv");
  ASSERT_TRUE(report.scenario) << report.errors[0].message;
  const PlatformSpec& platform = *report.scenario->platform;
  EXPECT_EQ(platform.motion, PlatformMotion::table);
  EXPECT_EQ(platform.table.file, "turn.csv");
  EXPECT_EQ(platform.table.file_sha256, sha256_hex(kRows));
  ASSERT_TRUE(platform.table.rows);
  EXPECT_EQ(platform.table.rows->t_s, (std::vector<double>{0, 10, 30, 60}));
  EXPECT_EQ(make_platform<double>(platform).turn.table->angle(30), -0.25);
  EXPECT_TRUE(examine((temporary_.path() / "turn.csv").string()).scenario);  // an absolute path stands for itself
}

TEST_F(TableFile, WhatCannotBeReadIsRefused) {
  expect_refused("none.csv", "none.csv: there is no such file; check the path");
  expect_refused("", "names no file");
  expect_refused(".", "is a directory");
  expect_refused("/dev/zero", "is not a regular file");
  ASSERT_EQ(::mkfifo((temporary_.path() / "fifo").c_str(), 0600), 0);
  expect_refused("fifo", "is a FIFO; give a file");
  write("large.csv", std::string((std::size_t{16} << 20) + 1, '0'));
  expect_refused("large.csv", "more than 16 MiB");
  expect_refused(std::string(5000, 'a'), "cannot be opened");
  write("short.csv", "t_s,angle_rad\n0,0\n1,0\n2,0\n3,0\n");
  expect_refused("short.csv", "short.csv:5: the table ends at 3 s; it must reach the duration, 60 s");
}

TEST_F(TableFile, IsOneOfTheScenariosErrors) {
  const ScenarioReport report = examine_scenario(
      {temporary_.path() / "scene.json",
       replaced(replaced(kMinimal, "45", "95"), "\"motion\"",
                "\"platform\": {\"motion\": \"table\", \"file\": \"none.csv\", \"rate_rad_s\": 1}, \"motion\"")});
  EXPECT_EQ(report.error_count, 3u);
}

TEST_F(TableFile, BelongsToTheMotionTable) {
  expect_set({{"/platform", R"({"motion": "table"})"}}, "/platform/file", "is missing");
  expect_set({{"/platform", R"({"motion": "constant", "rate_rad_s": 1, "file": "turn.csv"})"}}, "/platform/file",
             "does not belong to \"constant\" motion");
  expect_refused("turn.csv", "does not belong to \"table\" motion", ", \"rate_rad_s\": 1", "rate_rad_s");
}

TEST_F(TableFile, IsPartOfTheRunsIdentity) {
  const Scenario scenario = *examine("turn.csv").scenario;
  const std::string canonical = canonical_json(scenario);
  const auto platform = testing::parse_json(canonical).at("platform");
  EXPECT_EQ(platform.at("motion"), "table");
  EXPECT_EQ(platform.at("file"), "turn.csv");
  EXPECT_EQ(platform.at("file_sha256"), sha256_hex(kRows));
  EXPECT_FALSE(platform.contains("rate_rad_s"));
  // It reads back beside the same file, and not beside another one.
  EXPECT_EQ(canonical_json(parse_scenario({temporary_.path() / "canonical.json", canonical})), canonical);
  write("turn.csv", kRows + "61,0\n");
  expect_refused("turn.csv", "is not that of turn.csv, " + sha256_hex(kRows + "61,0\n"),
                 ", \"file_sha256\": \"" + sha256_hex(kRows) + "\"", "file_sha256");
  EXPECT_NE(canonical_json(*examine("turn.csv").scenario), canonical);
}

TEST_F(TableFile, IsNotOpenedForATextThatMayNameNone) {
  const std::string text =
      replaced(kMinimal, "\"motion\"", "\"platform\": {\"motion\": \"table\", \"file\": \"turn.csv\"}, \"motion\"");
  const ScenarioReport report = examine_scenario({temporary_.path() / "scene.json", text, false});
  ASSERT_EQ(report.error_count, 1u);
  EXPECT_EQ(report.errors[0].pointer, "/platform/file");
}

TEST_F(TableFile, ItsTurnCountsInTheWork) {
  // A table sampled from a harmonic turn asks for about as many steps as that turn.
  std::string rows = "t_s,angle_rad\n";
  for (int i = 0; i <= 6000; ++i)
    rows += std::to_string(i / 100.0) + "," + std::to_string(0.5 * std::sin(2 * i / 100.0 * 3.14159265358979)) + "\n";
  write("swing.csv", rows);
  Scenario table = *examine("swing.csv", ", \"pivot_offset_m\": [3, 0, 0]").scenario, formula = table;
  formula.platform = PlatformSpec{PlatformMotion::harmonic, {0, 0, 1}, 0, 0, 0.5, 1, 0, {3, 0, 0}};
  EXPECT_NEAR(Scene(table).fastest_rate_rad_s() / Scene(formula).fastest_rate_rad_s(), 1, 0.01);
  table.platform.reset();
  EXPECT_GT(Scene(formula).fastest_rate_rad_s() / Scene(table).fastest_rate_rad_s(), 1.02);
}

}  // namespace
}  // namespace earthtop::scenario_test
