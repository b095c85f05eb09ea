// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>

#include "earthtop/results/results.hpp"
#include "results/made_up_run.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;
using test::made_up_run;
using test::made_up_run_with_ledger;

class Write : public ::testing::Test {
 protected:
  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  static void put(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
  static std::set<std::string> names_in(const fs::path& dir) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(dir)) names.insert(entry.path().filename().string());
    return names;
  }

  /// The summary as `summary_json` makes it.
  std::string summary_without_checksums() const {
    const std::string text = read(dir_ / "summary.json");
    const std::size_t files = text.find(",\n  \"files\": {");
    return files == text.npos ? "no checksums" : text.substr(0, files) + "\n}\n";
  }

  testing::TemporaryDirectory temporary_;
  const fs::path root_ = temporary_.path();
  const fs::path dir_ = root_ / "out" / "made-up";
};

const std::set<std::string> kAll = {"trajectory.csv", "drift.svg", "timing.json", "summary.json"};

const std::set<std::string> kAllAndTorques = {"trajectory.csv", "torques.csv", "drift.svg", "timing.json", "summary.json"};

RunResult another_run() {
  RunResult result = made_up_run();
  result.scene = testing::changed(result.scene, [&](Scenario& s) { s.release.spin_rad_s = 201; });
  return result;
}

TEST_F(Write, MakesTheDirectoryAndEveryFile) {
  const RunResult result = made_up_run();
  write_results(result, dir_, false);
  EXPECT_EQ(names_in(dir_), kAll);
  EXPECT_EQ(read(dir_ / "trajectory.csv"), trajectory_csv(result));
  EXPECT_EQ(summary_without_checksums(), summary_json(result));
  EXPECT_EQ(read(dir_ / "drift.svg"), svg(drift_figure(result)));
}

// What is asked for is said of a run that nobody has made: the sizes are those of runs of 1e5 rows and more.
TEST_F(Write, SizesOfRunsAreSaidInAdvance) {
  Scenario scenario = made_up_run().scene.scenario();
  scenario.precision = Precision::bits53, scenario.ledger.reset(), scenario.contact.reset();
  scenario.duration_s = 2000, scenario.output_step_s = 1e-3;
  scenario.numerics.method = Method::rkf78;                           // whose rows are all held in memory
  const RunSize two_million_rows = expected_size(resolve(scenario));  // 2 GB of memory and 1.07 GB of files, as measured
  constexpr double kPromised = 1.5;                                   // factor, as `check` is documented
  constexpr double kScenarios = 0.1e9;                                // by which rows of scenarios differ in length
  EXPECT_GT(two_million_rows.memory_bytes, 2e9 / kPromised);
  EXPECT_LT(two_million_rows.memory_bytes, 2e9 * kPromised);
  EXPECT_NEAR(two_million_rows.file_bytes, 1.07e9, kScenarios);
  EXPECT_EQ(bytes_text(two_million_rows.file_bytes), "1.1 GB");
  scenario.numerics.method = Method::taylor;  // whose rows are made when they are written
  EXPECT_EQ(bytes_text(expected_size(resolve(scenario)).memory_bytes), "22 MB");
  EXPECT_EQ(expected_size(resolve(scenario)).file_bytes, two_million_rows.file_bytes);
  scenario.duration_s = 1e-3;
  EXPECT_EQ(bytes_text(expected_size(resolve(scenario)).file_bytes), "less than 0.1 MB");
  EXPECT_EQ(bytes_text(expected_size(resolve(scenario)).memory_bytes), "22 MB");
}

TEST_F(Write, ADirectoryIsNoFile) {
  std::filesystem::create_directories(dir_ / "there");
  try {
    write_file(dir_ / "there", "text");
    FAIL() << "a directory was written to";
  } catch (const ScenarioError& error) {
    EXPECT_NE(
        std::string(error.what()).find("is not the name of a file, or something other than a file has that name; give a file"),
        std::string::npos)
        << error.what();
  }
}

TEST_F(Write, SameScenarioIsOverwritten) {
  write_results(made_up_run(), dir_, false);
  RunResult again = made_up_run();
  again.notes = {"again"};
  EXPECT_NO_THROW(check_output_directory(dir_, again.scene, false));
  write_results(again, dir_, false);
  EXPECT_EQ(summary_without_checksums(), summary_json(again));
  EXPECT_EQ(names_in(dir_), kAll);
}

TEST_F(Write, AnotherScenarioIsRefusedUnlessForced) {
  const RunResult first = made_up_run();
  write_results(first, dir_, false);
  EXPECT_THROW(check_output_directory(dir_, another_run().scene, false), ScenarioError);
  EXPECT_THROW(write_results(another_run(), dir_, false), ScenarioError);
  EXPECT_EQ(summary_without_checksums(), summary_json(first));
  EXPECT_NO_THROW(check_output_directory(dir_, another_run().scene, true));
  write_results(another_run(), dir_, true);
  EXPECT_EQ(summary_without_checksums(), summary_json(another_run()));
}

TEST_F(Write, WhatIsNotOursIsRefusedUnlessForced) {
  fs::create_directories(dir_);
  for (const char* text : {"", "{", "[]", "{\"provenance\":{}}", "{\"provenance\":{\"scenario_sha256\":1}}"}) {
    put(dir_ / "summary.json", text);
    try {
      check_output_directory(dir_, made_up_run().scene, false);
      FAIL() << "accepted: " << text;
    } catch (const ScenarioError& error) {
      EXPECT_NE(std::string(error.what()).find("summary.json was not written by earthtop"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(check_output_directory(dir_, made_up_run().scene, true)) << text;
  }
  fs::remove(dir_ / "summary.json");
  put(dir_ / "trajectory.csv", "mine\n");
  EXPECT_THROW(check_output_directory(dir_, made_up_run().scene, false), ScenarioError);
}

TEST_F(Write, LedgerIsWrittenWhereThereIsOne) {
  const RunResult result = made_up_run_with_ledger();
  write_results(result, dir_, false);
  EXPECT_EQ(names_in(dir_), kAllAndTorques);
  EXPECT_EQ(read(dir_ / "torques.csv"), torques_csv(result));
  EXPECT_NO_THROW(write_results(result, dir_, false));
}

TEST_F(Write, LedgerOfOlderResultsDoesNotStay) {
  write_results(made_up_run_with_ledger(), dir_, false);
  EXPECT_THROW(write_results(made_up_run(), dir_, false), ScenarioError);
  EXPECT_EQ(names_in(dir_), kAllAndTorques);
  write_results(made_up_run(), dir_, true);
  EXPECT_EQ(names_in(dir_), kAll);
  write_results(made_up_run_with_ledger(), dir_, true);
  EXPECT_EQ(names_in(dir_), kAllAndTorques);
}

TEST_F(Write, LedgerThatIsNotOursIsRefusedUnlessForced) {
  fs::create_directories(dir_);
  put(dir_ / "torques.csv", "mine\n");
  for (const RunResult& result : {made_up_run(), made_up_run_with_ledger()})
    EXPECT_THROW(write_results(result, dir_, false), ScenarioError);
  fs::remove(dir_ / "torques.csv");
  write_results(made_up_run(), dir_, false);
  put(dir_ / "torques.csv", "mine\n");  // beside results that have none
  EXPECT_THROW(check_output_directory(dir_, made_up_run().scene, false), ScenarioError);
  EXPECT_THROW(write_results(made_up_run(), dir_, false), ScenarioError);
  EXPECT_EQ(read(dir_ / "torques.csv"), "mine\n");
  write_results(made_up_run(), dir_, true);
  EXPECT_EQ(names_in(dir_), kAll);
  fs::create_directories(dir_ / "torques.csv");
  EXPECT_THROW(check_output_directory(dir_, made_up_run().scene, true), ScenarioError);
}

TEST_F(Write, OtherFilesInTheDirectoryAreNoObstacle) {
  fs::create_directories(dir_);
  put(dir_ / "notes.txt", "mine");
  write_results(made_up_run(), dir_, false);
  EXPECT_EQ(read(dir_ / "notes.txt"), "mine");
}

TEST_F(Write, WhatIsNoDirectoryIsRefusedEvenIfForced) {
  put(root_ / "file", "mine");
  for (const fs::path& path : {root_ / "file", root_ / "file" / "below", fs::path()}) {
    EXPECT_THROW(check_output_directory(path, made_up_run().scene, true), ScenarioError) << path;
    EXPECT_THROW(write_results(made_up_run(), path, true), ScenarioError) << path;
  }
  EXPECT_EQ(read(root_ / "file"), "mine");
  fs::create_directories(dir_ / "drift.svg");
  EXPECT_THROW(check_output_directory(dir_, made_up_run().scene, true), ScenarioError);
}

TEST_F(Write, CheckMakesNothing) {
  check_output_directory(dir_, made_up_run().scene, false);
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(Write, UnwritablePlaceIsAWriteError) {
  if (::geteuid() == 0) {
    // Permission bits do not stop root, but procfs refuses new directories.
    EXPECT_THROW(write_results(made_up_run(), "/proc/earthtop-out", false), WriteError);
    return;
  }
  fs::create_directories(dir_);
  fs::permissions(dir_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(check_output_directory(dir_, made_up_run().scene, false), WriteError);
  EXPECT_THROW(write_results(made_up_run(), dir_, false), WriteError);
  fs::permissions(dir_, fs::perms::owner_all);
  EXPECT_TRUE(fs::is_empty(dir_));
}

/// While it lives, files of this process cannot grow beyond `bytes`.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int);
};

TEST_F(Write, FailureInTheMiddleOfAFileLeavesTheOldResult) {
  const RunResult old = made_up_run(11);
  write_results(old, dir_, false);
  const std::string timing = read(dir_ / "timing.json");
  // Limits with no room for any file, and with room for the trajectory but not for the next file, so that different files fail.
  for (const std::size_t limit : {std::size_t{100}, std::size_t{4000}, trajectory_csv(another_run()).size() - 1}) {
    RunResult next = another_run();
    if (limit == 4000) next.rows.resize(2);
    try {
      const FileSizeLimit full(limit);
      write_results(next, dir_, true);
      FAIL() << "written in spite of the limit " << limit;
    } catch (const WriteError& error) {
      EXPECT_NE(std::string(error.what()).find(dir_.string()), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("too large"), std::string::npos) << error.what();
    }
    EXPECT_EQ(names_in(dir_), kAll);
    EXPECT_EQ(read(dir_ / "trajectory.csv"), trajectory_csv(old));
    EXPECT_EQ(summary_without_checksums(), summary_json(old));
    EXPECT_EQ(read(dir_ / "timing.json"), timing);
  }
}

TEST_F(Write, FailureLeavesTheOldLedger) {
  const RunResult old = made_up_run_with_ledger(11);
  write_results(old, dir_, false);
  RunResult next = made_up_run();  // has none; its summary.json does not fit
  next.rows.resize(2);
  try {
    const FileSizeLimit full(100);
    write_results(next, dir_, true);
    FAIL() << "written in spite of the limit";
  } catch (const WriteError&) {
  }
  EXPECT_EQ(names_in(dir_), kAllAndTorques);
  EXPECT_EQ(read(dir_ / "torques.csv"), torques_csv(old));
  EXPECT_EQ(summary_without_checksums(), summary_json(old));
}

}  // namespace
}  // namespace earthtop
