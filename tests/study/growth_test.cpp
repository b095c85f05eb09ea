// SPDX-License-Identifier: GPL-3.0-or-later
// Studies whose design has changed: what an older store has of the new design is copied, and the results are those of a study that was
// computed from the beginning, byte for byte.
#include "study/growth.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "earthtop/error.hpp"
#include "earthtop/study/run_study.hpp"
#include "study/sqlite.hpp"
#include "study/store.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

const std::string kLatitudes = R"("axes": [{"pointer": "/site/latitude_deg", "range": {"from": -80, "to": 80, "points": )";
const std::string kDrawn = R"("axes": [{"pointer": "/site/latitude_deg", "range": {"from": -80, "to": 80}},
                                       {"pointer": "/release/tilt_deg", "range": {"from": 5, "to": 60}}], "design": )";
const std::string kTwo = R"("collect": ["drift.axis_final_rad", "drift.azimuth_final_rad"])";
const std::string kOne = R"("collect": ["drift.azimuth_final_rad"])";

std::string latitudes(int points) { return kLatitudes + std::to_string(points) + "}}]"; }
std::string listed(const std::string& values) {
  return R"("axes": [{"pointer": "/site/latitude_deg", "values": )" + values +
         R"(}, {"pointer": "/release/spin_rad_s", "values": [150, 200]}])";
}
std::string drawn(const std::string& kind, int points, const std::string& more = "") {
  return kDrawn + R"({"kind": ")" + kind + R"(", "points": )" + std::to_string(points) + more + "}";
}

class Growth : public ::testing::Test {
 protected:
  /// @param parts  of the study file besides the base
  Study study(const std::string& parts) const {
    return parse_study({"grown.json", R"({"base": ")" + std::string(EARTHTOP_SCENARIOS) + R"(/toy-top.json", "set": {)" + set_ +
                                          R"("/motion/duration_s": 0.3}, )" + parts + "}"});
  }
  StudyRunReport run(const std::string& parts, const std::string& dir, bool force = false, const std::string& reuse = "",
                     StudyShard shard = {}) const {
    StudyRunOptions options;
    options.dir = directory_.path() / dir;
    options.jobs = 2;
    options.force = force;
    options.shard = shard;
    if (!reuse.empty()) options.reuse = directory_.path() / reuse;
    const Study given = study(parts);
    if (shard.is_whole()) check_study_results(options.dir, given, force);
    StudyRunReport report = run_study(given, options);
    if (shard.is_whole()) write_study_results(report.store, {}, force);
    return report;
  }
  std::string text(const std::string& file) const {
    std::ifstream stream(directory_.path() / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::string refusal(const std::string& parts, const std::string& dir) const {
    const std::string before = text(dir + "/study.sqlite") + text(dir + "/study.csv") + text(dir + "/study.json");
    try {
      run(parts, dir);
    } catch (const ScenarioError& error) {
      EXPECT_EQ(text(dir + "/study.sqlite") + text(dir + "/study.csv") + text(dir + "/study.json"), before) << "changed";
      return error.what();
    }
    ADD_FAILURE() << "not refused";
    return "";
  }
  /// Checks that a directory has the files of a study that was computed from the beginning.
  void expect_fresh(const std::string& parts, const std::string& dir) {
    const std::string fresh = "fresh" + std::to_string(fresh_++);
    run(parts, fresh);
    EXPECT_EQ(text(dir + "/study.csv"), text(fresh + "/study.csv")) << parts;
    EXPECT_EQ(text(dir + "/study.json"), text(fresh + "/study.json")) << parts;
    EXPECT_TRUE(check_study_store(directory_.path() / dir / "study.sqlite").damage.empty());
  }
  /// Checks what a study reuses of an older design in the same directory.
  void expect_growth(const std::string& before, const std::string& after, std::uint64_t reused, std::uint64_t of,
                     bool force = false) {
    const std::string dir = "grown" + std::to_string(grown_++);
    run(before, dir);
    const StudyRunReport report = run(after, dir, force);
    ASSERT_EQ(report.growth.size(), 1U) << after;
    EXPECT_EQ(report.growth.front().reused, reused) << after;
    EXPECT_EQ(report.growth.front().points, of) << after;
    EXPECT_EQ(report.progress.before, reused) << after;
    EXPECT_EQ(report.progress.done, of - reused) << after;
    expect_fresh(after, dir);
  }

  testing::TemporaryDirectory directory_;
  std::string set_;
  int fresh_ = 0, grown_ = 0;
};

TEST_F(Growth, MoreValuesOfAGrid) {
  expect_growth(latitudes(5), latitudes(9), 5, 9);
  expect_growth(listed("[10, 20]"), listed("[5, 10, 15, 20]"), 4, 8);  // the points have other numbers now
}

TEST_F(Growth, MorePointsOfARandomDesignAndOfASobolSequence) {
  expect_growth(drawn("random", 20), drawn("random", 50), 20, 50);
  expect_growth(drawn("sobol", 64), drawn("sobol", 128), 64, 128);
  expect_growth(drawn("sobol", 8, R"(, "indices": true)"), drawn("sobol", 16, R"(, "indices": true)"), 32, 64);
}

TEST_F(Growth, OneQuantityLessKeepsAllPointsAndOneMoreNone) {
  expect_growth(latitudes(5) + "," + kTwo, latitudes(5) + "," + kOne, 5, 5);
  run(latitudes(5) + "," + kOne, "more");
  const StudyRunReport report = run(latitudes(5) + "," + kTwo, "more");
  EXPECT_EQ(report.progress.done, 5U);
  EXPECT_NE(report.growth.front().why.find("drift.axis_final_rad was not collected"), std::string::npos);
  expect_fresh(latitudes(5) + "," + kTwo, "more");
}

TEST_F(Growth, AQuantityOfAnotherNameOrAtAnotherPlaceIsKept) {
  expect_growth(latitudes(5) + "," + kTwo,
                latitudes(9) + R"(, "collect": ["drift.azimuth_final_rad", {"name": "axis", "path": "drift.axis_final_rad"}])",
                5, 9);
}

TEST_F(Growth, AQuantityThatIsGoneMayHaveAskedForOtherRows) {
  const std::string rows = R"(, "collect": ["drift.axis_final_rad", "drift.axis_max_rad"])",
                    end = R"(, "collect": ["drift.axis_final_rad"])";
  expect_growth(latitudes(5) + rows, latitudes(5) + end, 0, 5);
  expect_growth(latitudes(5) + end, latitudes(5) + rows, 0, 5);
}

TEST_F(Growth, InLanesAndSingle) {
  for (const char* method : {"taylor", "dop853", "auto"}) {
    set_ = R"("/numerics/method": ")" + std::string(method) + R"(", )";
    expect_growth(latitudes(5), latitudes(9), 5, 9);
    expect_growth(drawn("random", 7), drawn("random", 20), 7, 20);  // the neighbours in the lanes are others
  }
}

TEST_F(Growth, AChangedListLosesPointsOnlyByForce) {
  run(listed("[10, 20, 30]"), "list");
  const std::string said = refusal(listed("[20, 30, 40]"), "list");
  for (const char* part : {"holds 6 points of another study or another design; this one lacks 2 of them",
                           "/axes/0/values/0: 10 there, 20 here", "--reuse", "--force"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
  expect_growth(listed("[10, 20, 30]"), listed("[20, 30, 40]"), 4, 6, true);
  expect_growth(drawn("random", 20), drawn("random", 10), 10, 10, true);
}

TEST_F(Growth, ALongerLatinHypercubeSharesNoPointAndSaysSo) {
  run(drawn("latin_hypercube", 10), "cube");
  const std::string said = refusal(drawn("latin_hypercube", 20), "cube");
  EXPECT_NE(said.find("a Latin hypercube of another length shares no point"), std::string::npos) << said;
  EXPECT_NE(said.find("all 10 of them would be lost"), std::string::npos) << said;
  const StudyRunReport report = run(drawn("latin_hypercube", 20), "longer", false, "cube");
  EXPECT_EQ(report.growth.front().reused, 0U);
  EXPECT_NE(report.growth.front().why.find("a Latin hypercube of another length"), std::string::npos);
  expect_growth(drawn("latin_hypercube", 10), drawn("latin_hypercube", 20), 0, 20, true);
}

TEST_F(Growth, ReuseCopiesFromAStoreThatStaysAsItIs) {
  run(listed("[10, 20, 30]"), "old");
  const std::string before = text("old/study.sqlite");
  const StudyRunReport report = run(listed("[20, 30, 40]"), "new", false, "old");
  EXPECT_EQ(report.progress.before, 4U);
  EXPECT_EQ(report.progress.done, 2U);
  EXPECT_EQ(report.growth.front().left_out, 2U);
  EXPECT_FALSE(report.growth.front().replaced);
  EXPECT_EQ(text("old/study.sqlite"), before);
  expect_fresh(listed("[20, 30, 40]"), "new");
  EXPECT_THROW(run(listed("[1]"), "other", false, "nowhere"), ScenarioError);
  EXPECT_FALSE(fs::exists(directory_.path() / "other"));
  // A shard takes its own points only.
  const StudyRunReport shard = run(listed("[20, 30, 40]"), "part", false, "old", {2, 2});
  EXPECT_EQ(shard.progress.before, 2U);
  EXPECT_EQ(shard.progress.wanted, 3U);
}

TEST_F(Growth, PointsOfAnotherVersionAreNotReused) {
  run(latitudes(5), "old");
  const fs::path file = directory_.path() / "old/study.sqlite";
  {
    study::sqlite::Connection connection(file.string(), study::sqlite::Connection::Mode::write);
    connection.execute("UPDATE study SET value = '0.9.9' WHERE key = 'version'");
    study::Facts facts;
    study::sqlite::Statement all(connection, "SELECT key, value FROM study");
    while (all.step()) facts[all.text(0)] = all.text(1);
    connection.execute(
        ("UPDATE study SET value = '" + study::facts_checksum(facts) + "' WHERE key = 'facts_checksum'").c_str());
  }
  EXPECT_NE(refusal(latitudes(9), "old").find("another version of earthtop computed them (0.9.9"), std::string::npos);
  const StudyRunReport report = run(latitudes(9), "new", false, "old");
  EXPECT_EQ(report.progress.done, 9U);
  EXPECT_NE(report.growth.front().why.find("another version"), std::string::npos);
  // This version went on with that store: its points are of both, and are not reused either.
  run(latitudes(5), "old");
  EXPECT_NE(refusal(latitudes(9), "old").find("several versions of earthtop computed them"), std::string::npos);
}

TEST_F(Growth, AnotherBaseSharesNoPointAndItsKeyIsNamed) {
  run(latitudes(5), "old");
  set_ = R"("/release/tilt_deg": 11, )";
  const std::string said = refusal(latitudes(5), "old");
  EXPECT_NE(said.find("/set/release/tilt_deg: none there, 11 here"), std::string::npos) << said;
  EXPECT_NE(said.find("all 5 of them would be lost"), std::string::npos) << said;
}

TEST_F(Growth, ResultsOfTheDesignsBeforeAreOverwrittenAndThoseOfOthersNot) {
  run(latitudes(3), "a");
  StudyRunOptions options;
  options.dir = directory_.path() / "a";
  run_study(study(latitudes(5)), options);  // killed before its results are written
  run(latitudes(9), "a");
  expect_fresh(latitudes(9), "a");
  run(listed("[1]"), "b");
  fs::remove(directory_.path() / "b/study.sqlite");
  EXPECT_THROW(check_study_results(directory_.path() / "b", study(latitudes(9)), false), ScenarioError);
}

TEST_F(Growth, WhatAKilledGrowthLeftIsNoObstacle) {
  run(latitudes(5), "a");
  std::ofstream(directory_.path() / "a/study.sqlite.grown") << "half a database";
  EXPECT_EQ(run(latitudes(9), "a").progress.before, 5U);
  EXPECT_FALSE(fs::exists(directory_.path() / "a/study.sqlite.grown"));
  expect_fresh(latitudes(9), "a");
}

TEST_F(Growth, StoresOfUnlikeDesignsAreMergedWherePointsFit) {
  const auto store = [&](const std::string& dir) { return study_store(directory_.path() / dir); };
  run(latitudes(5), "five");
  run(latitudes(9), "nine");
  EXPECT_EQ(merge_study_stores({store("five"), store("nine")}, directory_.path() / "all", false), 9U);
  write_study_results(store("all"), {}, false);
  expect_fresh(latitudes(9), "all");
  // Half of the larger design and the smaller one.
  const fs::path half = run(latitudes(9), "half", false, "", {1, 2}).store;  // the same points as those of five
  EXPECT_EQ(merge_study_stores({store("five"), half}, directory_.path() / "some", false), 5U);
  const fs::path other = run(latitudes(9), "half", false, "", {2, 2}).store;
  EXPECT_EQ(merge_study_stores({store("five"), other}, directory_.path() / "both", false), 9U);
  write_study_results(store("both"), {}, false);
  expect_fresh(latitudes(9), "both");
  // Two lists of one axis become one.
  run(listed("[10, 30]"), "c");
  run(listed("[20, 30]"), "d");
  EXPECT_EQ(merge_study_stores({store("d"), store("c")}, directory_.path() / "list", false), 6U);
  write_study_results(store("list"), {}, false);
  expect_fresh(listed("[10, 20, 30]"), "list");
}

TEST_F(Growth, AMergerThatIsRefusedNamesTheKey) {
  run(latitudes(5), "five");
  run(latitudes(5) + "," + kOne, "quantities");
  set_ = R"("/release/tilt_deg": 11, )";
  run(latitudes(9), "tilted");
  const auto said = [&](const std::string& one, const std::string& other) {
    try {
      merge_study_stores({study_store(directory_.path() / one), study_store(directory_.path() / other)},
                         directory_.path() / "m", false);
    } catch (const ScenarioError& error) {
      EXPECT_FALSE(fs::exists(directory_.path() / "m"));
      return std::string(error.what());
    }
    return std::string("merged");
  };
  EXPECT_NE(said("five", "tilted").find("/set/release/tilt_deg: none there, 11 here"), std::string::npos)
      << said("five", "tilted");
  EXPECT_EQ(said("five", "quantities"), "merged");  // the points fit into the study of fewer quantities
}

}  // namespace
}  // namespace earthtop
