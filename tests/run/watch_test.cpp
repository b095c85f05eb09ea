// SPDX-License-Identifier: GPL-3.0-or-later
// Progress and interruption of runs: the share never falls, and a run that is stopped on its way keeps what it should.
#include "earthtop/watch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>
#include <thread>

#include "earthtop/compare/compare.hpp"
#include "earthtop/report/report.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;

TEST(Progress, NeverFalls) {
  Progress progress;
  const Watch watch(nullptr, &progress);
  watch.part(0.5, 1, "second half").reach(0.5);
  EXPECT_EQ(progress.share(), 0.75);
  EXPECT_STREQ(progress.phase(), "second half");
  watch.part(0, 0.5).reach(1);
  EXPECT_EQ(progress.share(), 0.75);
  watch.reach(2);
  EXPECT_EQ(progress.share(), 1);
}

TEST(Progress, PartsHaveTheShareOfTheirCost) {
  Progress progress;
  const Watch watch(nullptr, &progress);
  Parts parts(watch.part(0, 0.5), 4);
  parts.next(1).reach(1);
  EXPECT_EQ(progress.share(), 0.125);
  const Watch second = parts.next(3, "the rest");
  EXPECT_EQ(progress.share(), 0.125);
  second.reach(0.5);
  EXPECT_EQ(progress.share(), 0.3125);
  second.part(0.5, 1).reach(1);
  EXPECT_EQ(progress.share(), 0.5);
  Parts nothing(watch, 0);
  nothing.next(0, "not shown").reach(0.5);
  EXPECT_STREQ(progress.phase(), "the rest");
}

Scenario body() {
  ScenarioSource source = read_scenario_source(EARTHTOP_SCENARIOS "/asymmetric-top.json");
  return parse_scenario(source, {{"/motion/duration_s", "60"}, {"/motion/output_step_s", "0.5"}});
}

/// A run that is asked to stop as soon as it enters a phase; nothing if the phase was always over before the request came.
std::optional<RunResult> stopped_in(std::string_view phase, const Scenario& scenario, bool partial) {
  // On a busy machine the watcher may sleep through a phase, hence many attempts; mostly the first one succeeds.
  for (int attempt = 0; attempt < 200; ++attempt) {
    std::atomic<bool> stop = false, over = false;
    Progress progress;
    std::thread watcher([&] {
      while (!over && progress.phase() != phase) std::this_thread::yield();
      stop = true;
    });
    RunResult result = run(scenario, {Watch(&stop, &progress), partial});
    over = true;
    watcher.join();
    if (result.status == RunStatus::interrupted) return result;
  }
  return std::nullopt;
}

TEST(Interrupted, IsNotWholeWhereTheSolutionWasCutShort) {
  const auto result = stopped_in("solution", body(), true);
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->solution_is_whole);
  EXPECT_TRUE(result->rows.empty());
  EXPECT_FALSE(is_partial(*result));
  EXPECT_EQ(result->verdict.verdict, Verdict::unassessed);
}

TEST(Interrupted, HasNoRowsUnlessTheyAreAskedFor) {
  const auto result = stopped_in("error bound", body(), false);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->solution_is_whole);
  EXPECT_TRUE(result->rows.empty());
  EXPECT_EQ(result->verdict.verdict, Verdict::unassessed);
}

/// The lines of a CSV text, each split into cells.
std::vector<std::vector<std::string>> cells(const std::string& text) {
  std::vector<std::vector<std::string>> lines;
  std::string cell;
  lines.emplace_back();
  for (const char c : text) {
    if (c != ',' && c != '\n') {
      cell += c;
      continue;
    }
    lines.back().push_back(std::exchange(cell, ""));
    if (c == '\n') lines.emplace_back();
  }
  lines.pop_back();
  return lines;
}

TEST(Partial, HasTheRowsOfTheWholeRunWithoutBoundsAndVerdict) {
  const RunResult whole = run(body());
  ASSERT_EQ(whole.status, RunStatus::completed);
  for (const char* phase : {"error bound", "growth of disturbances"}) {
    const auto result = stopped_in(phase, body(), true);
    ASSERT_TRUE(result) << phase;
    EXPECT_TRUE(is_partial(*result));
    EXPECT_EQ(result->notes.back(),
              "partial: interrupted before error bounds and verdict were computed; run the scenario again for them");
    const auto expected = cells(trajectory_csv(whole)), found = cells(trajectory_csv(*result));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t row = 1; row < found.size(); ++row)
      for (std::size_t column = 0; column < found[0].size(); ++column) {
        const std::string& name = found[0][column];
        if (name.ends_with("bound_rad"))
          EXPECT_EQ(found[row][column], "") << name;
        else if (name == "drift_reliable")
          EXPECT_EQ(found[row][column], "0");
        else
          EXPECT_EQ(found[row][column], expected[row][column]) << name;
      }
    const auto summary = testing::parse_json(summary_json(*result));
    EXPECT_EQ(summary.at("outcome").at("status"), "interrupted");
    EXPECT_EQ(summary.at("outcome").at("reached_s"), 60);
    EXPECT_EQ(summary.at("drift").at("verdict"), "unassessed");
    EXPECT_TRUE(summary.at("drift").at("axis_bound_rad").is_null());
    EXPECT_TRUE(summary.at("drift").at("reliable").at("axis_rad").is_null());
    EXPECT_TRUE(summary.at("attitude_bound_rad").is_null());
    EXPECT_EQ(summary.at("drift").at("axis_final_rad"), whole.drift.axis_final_rad);
  }
}

TEST(Partial, IsRefusedByCompareAndShownByReport) {
  const auto result = stopped_in("error bound", body(), true);
  ASSERT_TRUE(result);
  const fs::path dir = fs::temp_directory_path() / fmt::format("earthtop-partial-{}", ::getpid());
  write_results(*result, dir, false);
  try {
    compare_results(dir, dir, {});
    ADD_FAILURE() << "not refused";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("is a partial result"), std::string::npos) << error.what();
  }
  EXPECT_NE(make_report(dir.string()).html.find("unassessed"), std::string::npos);
  const RunResult whole = run(body());
  write_results(whole, dir, false);  // the same scenario's: no --force
  EXPECT_TRUE(compare_results(dir, dir, {}).passed());
  fs::remove_all(dir);
}

}  // namespace
}  // namespace earthtop
