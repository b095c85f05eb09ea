#include "earthtop/study/run_study.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "earthtop/run.hpp"
#include "study/message.hpp"
#include "study/store_lock.hpp"
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

  // A part that is there already is not computed again.
  merge_study_stores({shards[0]}, dir.path() / "resumed", false);
  const auto resumed = run_in(dir.path() / "resumed", study);
  EXPECT_EQ(resumed.progress.before, 5U);
  EXPECT_EQ(resumed.progress.done, 16U);
  EXPECT_EQ(csv(resumed.store), expected);
}

TEST(RunStudy, APointIsWhatRunGives) {
  const TemporaryDirectory dir;
  const auto report = run_in(dir.path(), small_study());
  const Json document = Json::parse(study_json(report.store));
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
    return Json::parse(study_json(report.store)).at("points").at(0).at("scenario.motion.output_step_s").get<double>();
  };
  EXPECT_EQ(step_s(R"(, "collect": ["scenario.motion.output_step_s", "drift.axis_final_rad"])"), 0.5);  // release and end
  EXPECT_LT(step_s(R"(, "collect": ["scenario.motion.output_step_s", "drift.axis_max_rad"])"), 0.5);
  EXPECT_LT(step_s(R"(, "rows": "all", "collect": ["scenario.motion.output_step_s"])"), 0.5);
}

TEST(RunStudy, AQuantityThatDoesNotExistFailsItsPointsWithTheReason) {
  const TemporaryDirectory dir;
  const auto report = run_in(dir.path(), small_study(R"(, "collect": ["drift.no_such", "drift.secular.azimuth_rate_rad_s"])"));
  EXPECT_EQ(report.failed, 21U);
  const Json document = Json::parse(study_json(report.store));
  EXPECT_EQ(document.at("statuses").at("no_such_quantity"), 14);
  EXPECT_EQ(document.at("failures").at(0).at("reason"), "summary.json has no drift.no_such");
}

TEST(RunStudy, AnAccuracyThatIsNotReachedIsAFailureThatKeepsItsNumbers) {
  const TemporaryDirectory dir;
  const auto report = run_in(dir.path(), small_study(R"(, "design": {"kind": "one_at_a_time"})"));
  EXPECT_EQ(report.failed, 1U);
  const Study asking = parse_study({"asking.json", R"({"base": ")" + kBase + R"(", "set": {"/motion/duration_s": 0.5},
    "axes": [{"pointer": "/accuracy/drift_rad", "values": [1e-6, 1e-30]}]})"});
  const auto asked = run_in(dir.path() / "asking", asking);
  EXPECT_EQ(asked.failed, 1U);
  const Json document = Json::parse(study_json(asked.store));
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
  const Json document = Json::parse(study_json(again.store));
  EXPECT_EQ(document.at("title"), "Later");
  const Json &fit = document.at("fits").at(0), &points = document.at("points");
  // Two tilts at each of seven latitudes: the line goes through the means at ln 10 and ln 20.
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

TEST(Figures, AreHeldAgainstTheResults) {
  const TemporaryDirectory dir;
  const auto report = run_in(dir.path(), small_study(R"(, "figures": [
      {"figure": "/points_failed", "value": 7, "tolerance": 0.5, "origin": "counting"},
      {"figure": "/points_failed", "value": 8, "tolerance": 0.5, "origin": "miscounting"},
      {"figure": "/nowhere", "value": 8, "tolerance": 0.5, "origin": ""}])"));
  const Json figures = Json::parse(study_json(report.store)).at("figures");
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

}  // namespace
}  // namespace earthtop
