// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/study/run_study.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/study/study_columns.hpp"
#include "study/message.hpp"
#include "study/sqlite.hpp"
#include "study/store_lock.hpp"
#include "study/value.hpp"
#include "support/json.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

using testing::TemporaryDirectory;
using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string kBase = std::string(EARTHTOP_SCENARIOS) + "/toy-top.json";

Study small_study(const std::string& more = "") {
  return parse_study({"small.json", R"({"base": ")" + kBase + R"(", "set": {"/motion/duration_s": 0.5},
    "axes": [{"pointer": "/site/latitude_deg", "range": {"from": -90, "to": 90, "points": 7}},
             {"pointer": "/release/tilt_deg", "values": [10, 20, 200]}])" +
                                        more + "}"});
}

std::string csv(const fs::path& store) {
  std::string text;
  study_csv(store, [&](std::string_view piece) { text += piece; });
  return text;
}

StudyRunReport run_in(const fs::path& dir, const Study& study, unsigned jobs = 2, StudyShard shard = {}) {
  StudyRunOptions options;
  options.dir = dir;
  options.jobs = jobs;
  options.shard = shard;
  return run_study(study, options);
}

TEST(RunStudy, ThreadsShardsAndResumptionGiveTheSameBytes) {
  const TemporaryDirectory dir;
  const Study study = small_study();
  const auto whole = run_in(dir.path() / "whole", study, 1);
  EXPECT_TRUE(whole.complete());
  EXPECT_EQ(whole.progress.done, 21U);
  EXPECT_EQ(whole.failed, 7U);  // a tilt of 200 degrees is refused, and stops nothing
  const std::string expected = csv(whole.store), document = study_json(whole.store);

  const auto threads = run_in(dir.path() / "threads", study, 5);
  EXPECT_EQ(csv(threads.store), expected);
  EXPECT_EQ(study_json(threads.store), document);

  std::vector<fs::path> shards;
  for (std::uint64_t k = 1; k <= 4; ++k) shards.push_back(run_in(dir.path() / "shards", study, 2, {k, 4}).store);
  std::reverse(shards.begin(), shards.end());
  EXPECT_EQ(merge_study_stores({shards[1], shards[3]}, dir.path() / "merged", false), 11U);
  EXPECT_EQ(merge_study_stores(shards, dir.path() / "merged", false), 21U);
  EXPECT_EQ(csv(study_store(dir.path() / "merged")), expected);
  EXPECT_EQ(study_json(study_store(dir.path() / "merged")), document);

  // Points that the store already has are not computed again.
  merge_study_stores({shards[0]}, dir.path() / "resumed", false);
  const auto resumed = run_in(dir.path() / "resumed", study);
  EXPECT_EQ(resumed.progress.before, 5U);
  EXPECT_EQ(resumed.progress.done, 16U);
  EXPECT_EQ(csv(resumed.store), expected);
}

TEST(StudyColumns, HoldTheTableOfThePoints) {
  const TemporaryDirectory dir;
  const Study study = parse_study({"columns.json", R"({"base": ")" + kBase + R"(", "set": {"/motion/duration_s": 0.5},
    "axes": [{"pointer": "/effects/coriolis", "values": [true, false]},
             {"pointer": "/release/precession", "values": ["none", {"rate_rad_s": 1}]},
             {"pointer": "/release/tilt_deg", "values": [20, 200]}]})"});
  const auto report = run_in(dir.path(), study);
  const std::vector<StudyColumn> columns = study_columns(report.store);
  std::string table;
  for (const StudyColumn& column : columns) table += (table.empty() ? "" : ",") + column.name;
  table += '\n';
  for (std::size_t row = 0; row < 8; ++row)
    for (const StudyColumn& column : columns) {
      ASSERT_EQ(column.numbers.size(), 8U) << column.name;
      const std::int32_t place = column.places.empty() ? -1 : column.places.at(row);
      const double number = column.numbers[row];
      const study::Value value = place >= 0           ? study::Value(column.words.at(static_cast<std::size_t>(place)))
                                 : std::isnan(number) ? study::Value()
                                                      : study::Value(number);
      EXPECT_TRUE(place < 0 || std::isnan(number)) << "a cell holds one thing only";
      table += study::csv_cell(value) + (&column == &columns.back() ? '\n' : ',');
    }
  EXPECT_EQ(table, csv(report.store));
  EXPECT_EQ(columns[1].words, (std::vector<std::string>{"true", "false"}));
  EXPECT_FALSE(columns[1].has_numbers);
  EXPECT_TRUE(columns[0].has_numbers && columns[0].places.empty());
  const std::atomic<bool> stop = true;
  EXPECT_THROW(study_columns(report.store, Watch(&stop)), Interrupted);
  EXPECT_THROW(study_json(report.store, Watch(&stop)), Interrupted);
  EXPECT_THROW(study_columns(dir.path() / "none.sqlite"), ScenarioError);
}

TEST(RunStudy, APointIsWhatRunGives) {
  const TemporaryDirectory dir;
  const auto report = run_in(dir.path(), small_study());
  const Json document = testing::parse_json(study_json(report.store));
  const auto scenario = parse_scenario(
      read_scenario_source(kBase), {{"/motion/duration_s", "0.5"}, {"/site/latitude_deg", "30"}, {"/release/tilt_deg", "20"}});
  const RunResult result = run(scenario);
  const Json& point = document.at("points").at(13);
  EXPECT_EQ(point.at("latitude_deg"), 30.0);
  EXPECT_EQ(point.at("drift.verdict"), "reliable");
  const double bound = result.drift.axis_bound_rad + point.at("drift.axis_bound_rad").get<double>();
  EXPECT_NEAR(point.at("drift.axis_final_rad").get<double>(), result.drift.axis_final_rad, bound);
  EXPECT_GT(result.drift.axis_final_rad, 1e3 * bound);
  EXPECT_EQ(document.at("failures").at(0).at("status"), "refused");
  EXPECT_NE(document.at("failures").at(0).at("reason").get<std::string>().find("/release/tilt_deg"), std::string::npos);
}

TEST(RunStudy, AllRowsAreComputedWhereAQuantityNeedsThem) {
  const TemporaryDirectory dir;
  int count = 0;
  const auto step_s = [&](const std::string& more) {
    const auto report = run_in(dir.path() / std::to_string(count++), small_study(more));
    return testing::parse_json(study_json(report.store)).at("points").at(0).at("scenario.motion.output_step_s").get<double>();
  };
  EXPECT_EQ(step_s(R"(, "collect": ["scenario.motion.output_step_s", "drift.axis_final_rad"])"), 0.5);  // release and end
  EXPECT_LT(step_s(R"(, "collect": ["scenario.motion.output_step_s", "drift.axis_max_rad"])"), 0.5);
  EXPECT_LT(step_s(R"(, "rows": "all", "collect": ["scenario.motion.output_step_s"])"), 0.5);
}

TEST(RunStudy, AQuantityThatSomeRunsLackIsEmptyThereAndNoFailure) {
  const TemporaryDirectory dir;
  const auto report = run_in(dir.path(), small_study(R"(, "collect": ["drift.digits.axis_final_rad", "drift.threshold_time_s",
      "stops.0.t_s", "theory.7.computed", "drift.axis_final_rad"])"));
  EXPECT_EQ(report.failed, 7U);  // a tilt of 200 degrees
  const Json document = testing::parse_json(study_json(report.store));
  const Json& point = document.at("points").at(0);
  for (const char* empty : {"drift.digits.axis_final_rad", "drift.threshold_time_s", "stops.0.t_s", "theory.7.computed"})
    EXPECT_TRUE(point.at(empty).is_null()) << empty;
  EXPECT_TRUE(point.at("drift.axis_final_rad").is_number());
}

/// A study in which every point is refused.
Study refused_study(int points) {
  return parse_study({"refused.json", R"({"base": ")" + kBase + R"(", "axes": [{"pointer": "/release/tilt_deg",
      "range": {"from": 200, "to": 300, "points": )" +
                                          std::to_string(points) + "}}]}"});
}

TEST(HopelessStudies, AreRefusedWithTheirOneFindingAndNothingWritten) {
  const TemporaryDirectory dir;
  for (const int points : {1, 7, 20, 21, 5000}) {
    const fs::path place = dir.path() / std::to_string(points);
    try {
      run_in(place, refused_study(points));
      ADD_FAILURE() << points << " points were computed";
    } catch (const ScenarioError& error) {
      EXPECT_NE(std::string(error.what()).find("/release/tilt_deg: 200 is out of range"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("--keep-going"), std::string::npos);
    }
    EXPECT_FALSE(fs::exists(place));
  }
  // A shard is refused like the whole study, because points of the whole design are sampled.
  EXPECT_THROW(run_in(dir.path() / "shard", refused_study(5000), 2, {3, 4}), ScenarioError);
  StudyRunOptions options;
  options.dir = dir.path() / "going";
  options.keep_going = true;
  EXPECT_EQ(run_study(refused_study(50), options).failed, 50U);
}

TEST(HopelessStudies, AreThoseWhoseEveryPointLookedAtIsRefusedForOneKey) {
  // Only one of the last axis's three values gives a valid scenario; twenty points at equal distances of 57 would meet only the
  // other two.
  const auto sampled = [](const std::string& values) {
    return sample_points(parse_study({"s.json", R"({"base": ")" + kBase + R"(", "axes": [
        {"pointer": "/site/longitude_deg", "range": {"from": 0, "to": 18, "points": 19}},
        {"pointer": "/release/tilt_deg", "values": )" +
                                                    values + "}]}"}));
  };
  const StudySample mixed = sampled("[200, 20, 200]");
  EXPECT_EQ(mixed.looked_at, 20U);
  EXPECT_GT(mixed.refused, 0U);
  EXPECT_LT(mixed.refused, 20U);
  EXPECT_FALSE(mixed.common);
  EXPECT_TRUE(sampled("[200, 190, -1]").common);
  // Two unrelated reasons for refusal do not count as a common one.
  const StudySample two = sample_points(parse_study({"s.json", R"({"base": ")" + kBase + R"(", "axes": [
      {"pointers": ["/release/tilt_deg", "/site/latitude_deg"], "values": [[200, 45], [20, 95]]}]})"}));
  EXPECT_EQ(two.refused, 2U);
  EXPECT_FALSE(two.common);
}

TEST(HopelessStudies, TheFirstAndTheLastPointAreLookedAt) {
  for (const char* values : {"[20, 200, 200]", "[200, 200, 20]"}) {
    const StudySample sample = sample_points(parse_study({"s.json", R"({"base": ")" + kBase + R"(", "axes": [
        {"pointer": "/release/tilt_deg", "values": )" + values + R"(},
        {"pointer": "/site/longitude_deg", "range": {"from": 0, "to": 1, "points": 1}}]})"}));
    EXPECT_FALSE(sample.common) << values;
  }
  std::string list = "[20";
  for (int i = 0; i < 4000; ++i) list += ", 200";
  EXPECT_FALSE(
      sample_points(parse_study({"s.json", R"({"base": ")" + kBase +
                                               R"(", "axes": [{"pointer": "/release/tilt_deg", "values": )" + list + "]}]}"}))
          .common);
}

TEST(HopelessStudies, OneThatIsUnderWayGoesOn) {
  const TemporaryDirectory dir;
  // The only valid point of 4,002 is the first one that is not among those looked at.
  const auto with_good_point = [](int at) {
    std::string list = "200";
    for (int i = 1; i < 4002; ++i) list += i == at ? ", 20" : ", 200";
    return parse_study(
        {"s.json", R"({"base": ")" + kBase +
                       R"(", "set": {"/motion/duration_s": 0.1}, "axes": [{"pointer": "/release/tilt_deg", "values": [)" +
                       list + "]}]}"});
  };
  int at = 1;
  while (at < 50 && !sample_points(with_good_point(at)).common) ++at;
  const Study study = with_good_point(at);
  ASSERT_TRUE(sample_points(study).common);
  EXPECT_THROW(run_in(dir.path(), study), ScenarioError);
  StudyRunOptions options;
  options.dir = dir.path();
  options.keep_going = true;
  EXPECT_EQ(run_study(study, options).failed, 4001U);
  EXPECT_EQ(run_in(dir.path(), study).progress.before, 4002U);
}

TEST(RunStudy, AStoreWithoutACompletedPointMakesRoom) {
  const TemporaryDirectory dir;
  StudyRunOptions options;
  options.dir = dir.path();
  options.keep_going = true;
  EXPECT_FALSE(run_study(refused_study(3), options).replaced);
  const auto next = run_study(small_study(), options);
  EXPECT_TRUE(next.replaced);
  EXPECT_EQ(next.progress.done, 21U);
  // Completed points are kept.
  EXPECT_THROW(run_study(refused_study(3), options), ScenarioError);
  EXPECT_EQ(run_in(dir.path(), small_study()).progress.before, 21U);
}

TEST(RunStudy, AnAccuracyThatIsNotReachedIsAFailureThatKeepsItsNumbers) {
  const TemporaryDirectory dir;
  const auto report = run_in(dir.path(), small_study(R"(, "design": {"kind": "one_at_a_time"})"));
  EXPECT_EQ(report.failed, 1U);
  const Study asking = parse_study({"asking.json", R"({"base": ")" + kBase + R"(", "set": {"/motion/duration_s": 0.5},
    "axes": [{"pointer": "/accuracy/drift_rad", "values": [1e-6, 1e-30]}]})"});
  const auto asked = run_in(dir.path() / "asking", asking);
  EXPECT_EQ(asked.failed, 1U);
  const Json document = testing::parse_json(study_json(asked.store));
  EXPECT_EQ(document.at("points").at(1).at("status"), "accuracy_not_reached");
  EXPECT_GT(document.at("points").at(1).at("drift.axis_final_rad").get<double>(), 0);
}

TEST(RunStudy, AnotherStudysStoreIsRefusedUnlessForced) {
  const TemporaryDirectory dir;
  run_in(dir.path(), small_study());
  const Study other = small_study(R"(, "rows": "all")");
  StudyRunOptions options;
  options.dir = dir.path();
  EXPECT_THROW(run_study(other, options), ScenarioError);
  EXPECT_EQ(run_in(dir.path(), small_study()).progress.before, 21U);  // untouched
  options.force = true;
  EXPECT_EQ(run_study(other, options).progress.before, 0U);
}

TEST(RunStudy, TitleFitsAndFiguresAreThoseOfTheFileGivenLast) {
  const TemporaryDirectory dir;
  run_in(dir.path(), small_study());
  const auto again = run_in(dir.path(), small_study(R"(, "title": "Later", "fits": [
      {"kind": "logarithmic", "axis": "tilt_deg", "quantity": "drift.axis_final_rad"}])"));
  EXPECT_EQ(again.progress.done, 0U);
  const Json document = testing::parse_json(study_json(again.store));
  EXPECT_EQ(document.at("title"), "Later");
  const Json &fit = document.at("fits").at(0), &points = document.at("points");
  // Two tilts at each of seven latitudes: the fitted line passes through the means at ln 10 and ln 20.
  double rise = 0;
  for (std::size_t i = 0; i < 7; ++i)
    for (const auto& [tilt, sign] : {std::pair(0, -1), std::pair(1, 1)})
      rise += sign * points.at(3 * i + static_cast<std::size_t>(tilt)).at("drift.axis_final_rad").get<double>() / 7;
  EXPECT_NEAR(fit.at("b").get<double>(), rise / std::log(2.0), 1e-12 * std::abs(rise));
  EXPECT_EQ(fit.at("points"), 14);
}

TEST(RunStudy, StoresOfDifferentStudiesAreNotMerged) {
  const TemporaryDirectory dir;
  const auto a = run_in(dir.path() / "a", small_study()), b = run_in(dir.path() / "b", small_study(R"(, "rows": "all")"));
  EXPECT_THROW(merge_study_stores({a.store, b.store}, dir.path() / "c", false), ScenarioError);
  EXPECT_FALSE(fs::exists(dir.path() / "c"));
  EXPECT_THROW(merge_study_stores({dir.path() / "none.sqlite"}, dir.path() / "c", false), ScenarioError);
}

TEST(RunStudy, WhatIsNoStoreIsRefusedAndLeftAlone) {
  const TemporaryDirectory dir;
  std::ofstream(study_store(dir.path())) << "my thesis";
  EXPECT_THROW(run_in(dir.path(), small_study()), ScenarioError);
  std::ifstream file(study_store(dir.path()));
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), "my thesis");
}

TEST(StoreLocks, NameTheHolderAndEndWithIt) {
  const TemporaryDirectory dir;
  const fs::path store = study_store(dir.path());
  int to_parent[2];
  ASSERT_EQ(::pipe(to_parent), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const study::StoreLock lock(store);
    const ssize_t told = ::write(to_parent[1], "x", 1);
    ::pause();
    ::_exit(told == 1 ? 0 : 1);
  }
  char byte = 0;
  ASSERT_EQ(::read(to_parent[0], &byte, 1), 1);
  try {
    const study::StoreLock second(store);
    ADD_FAILURE() << "two holders";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("process " + std::to_string(child)), std::string::npos) << error.what();
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(study::StoreLock{store});
  EXPECT_FALSE(fs::exists(store.string() + ".lock"));
}

/// How often this thread has given up the processor voluntarily, which other programs do not affect.
long sleeps() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

TEST(StoreLocks, OfAHolderThatLivesAreToldAtOnce) {
  const TemporaryDirectory dir;
  const fs::path store = run_in(dir.path(), small_study()).store;
  int to_parent[2];
  ASSERT_EQ(::pipe(to_parent), 0);
  const pid_t child = ::fork();
  if (child == 0) {  // not this program: one that has locked the whole file
    study::sqlite::Connection other(store.string(), study::sqlite::Connection::Mode::write);
    other.execute("BEGIN EXCLUSIVE");
    const ssize_t told = ::write(to_parent[1], "x", 1);
    ::pause();
    ::_exit(told == 1 ? 0 : 1);
  }
  char byte = 0;
  ASSERT_EQ(::read(to_parent[0], &byte, 1), 1);
  for (const bool writes : {false, true}) {
    const long before = sleeps();
    try {
      writes ? static_cast<void>(run_in(dir.path(), small_study())) : static_cast<void>(study_json(store));
      ADD_FAILURE() << "a locked store was used";
    } catch (const ScenarioError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("is in use by"), std::string::npos) << what;
      EXPECT_NE(what.find("process " + std::to_string(child)), std::string::npos) << what;
    }
    // SQLite's waiting time of ten seconds would be more than a hundred short sleeps.
    EXPECT_LT(sleeps() - before, 50);
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST(Figures, AreHeldAgainstTheResults) {
  const TemporaryDirectory dir;
  const auto report = run_in(dir.path(), small_study(R"(, "figures": [
      {"figure": "/points_failed", "value": 7, "tolerance": 0.5, "origin": "counting"},
      {"figure": "/points_failed", "value": 8, "tolerance": 0.5, "origin": "miscounting"},
      {"figure": "/nowhere", "value": 8, "tolerance": 0.5, "origin": ""}])"));
  const Json figures = testing::parse_json(study_json(report.store)).at("figures");
  EXPECT_TRUE(figures.at(0).at("met").get<bool>());
  EXPECT_FALSE(figures.at(1).at("met").get<bool>());
  EXPECT_FALSE(figures.at(2).at("met").get<bool>());
  EXPECT_TRUE(figures.at(2).at("computed").is_null());
}

TEST(Messages, ComeBackAsTheyWere) {
  using namespace study;
  const Chunk chunk = {{3, {{true, 0, 0}, {false, 7, 0.1}}}, {1ULL << 52, {}}};
  const Chunk back = chunk_from(to_message(chunk));
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].settings[1].level, 7U);
  EXPECT_EQ(back[0].settings[1].fraction, 0.1);
  EXPECT_TRUE(back[0].settings[0].at_base);
  EXPECT_EQ(back[1].number, 1ULL << 52);
  PointResult result{5, {1e-300, std::string("a,\n")}, "completed", "", "ff", {Value(), -0.0}};
  const auto results = results_from(to_message({result}));
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].axis_values, result.axis_values);
  EXPECT_EQ(results[0].values[0], Value());
  EXPECT_TRUE(std::signbit(std::get<double>(results[0].values[1])));
  EXPECT_THROW(chunk_from(std::string_view(to_message(chunk)).substr(0, 30)), std::runtime_error);
}

TEST(Cells, AreQuotedWhereCsvNeedsIt) {
  using study::csv_cell;
  EXPECT_EQ(csv_cell(0.1), "0.1");
  EXPECT_EQ(csv_cell(std::string("a,\"b\"")), "\"a,\"\"b\"\"\"");
  EXPECT_EQ(csv_cell({}), "");
}

TEST(Cells, AreNoFormulas) {
  using study::csv_cell;
  const auto cell = [](const char* word) { return csv_cell(std::string(word)); };
  EXPECT_EQ(cell("=1+1"), "\"'=1+1\"");
  EXPECT_EQ(cell("+cmd|' /C calc'!A0"), "\"'+cmd|' /C calc'!A0\"");
  EXPECT_EQ(cell("-2+3"), "\"'-2+3\"");
  EXPECT_EQ(cell("@SUM(A1)"), "\"'@SUM(A1)\"");
  EXPECT_EQ(cell("\t=1"), "\"'\t=1\"");
  EXPECT_EQ(cell("\r=1"), "\"'\r=1\"");
  EXPECT_EQ(csv_cell(-1.5), "-1.5");
  EXPECT_EQ(cell("-1.5"), "-1.5");
  EXPECT_EQ(cell("a=b"), "a=b");
  EXPECT_EQ(cell("a\xE2\x80\x8B"
                 "b"),
            "a\\u200bb");
}

}  // namespace
}  // namespace earthtop
