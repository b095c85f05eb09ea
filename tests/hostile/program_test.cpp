// SPDX-License-Identifier: GPL-3.0-or-later
// Gives hostile texts to the program and measures it from outside: exit status 2, place and remedy on standard error, nothing
// on standard output or on disk, less than 2 s of processor time and 256 MiB of memory each.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <regex>

#include "hostile/kinds.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::hostile_test {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
constexpr double kMostSeconds = 40, kMostMebibytes = 2048;  // builds that are not optimised, or keep what was freed
#else
constexpr double kMostSeconds = 2, kMostMebibytes = 256;  // as promised
#endif

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

double seconds(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

class Program : public ::testing::Test {
 protected:
  Program() { fs::current_path(dir_); }
  ~Program() override { fs::current_path("/"); }

  /// Status and cost of a run of the program on `scenario`; its streams are in "stdout" and "stderr".
  struct Cost {
    int status = -1;
    double seconds = 0, mebibytes = 0;  ///< processor time, which other programs do not affect (s); peak memory (MiB)
  };
  static Cost run(const std::string& scenario, const std::string& standard_input = "/dev/null") {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, standard_input.c_str(), O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "stdout", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, "stderr", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    std::string tool = EARTHTOP_TOOL, verb = "run", file = scenario;
    char* arguments[] = {tool.data(), verb.data(), file.data(), nullptr};
    pid_t child = 0;
    const int error = ::posix_spawn(&child, tool.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    Cost cost;
    int status = 0;
    rusage usage{};
    if (error != 0 || ::wait4(child, &status, 0, &usage) != child) return cost;
    cost.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    cost.seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    cost.mebibytes = static_cast<double>(usage.ru_maxrss) / 1024;
    return cost;
  }

  void expect_refused(const std::string& name, const std::string& scenario, const std::regex& first_line,
                      const std::string& standard_input = "/dev/null") {
    const Cost cost = run(scenario, standard_input);
    EXPECT_EQ(cost.status, 2) << name;
    EXPECT_LT(cost.seconds, kMostSeconds) << name;
    EXPECT_LT(cost.mebibytes, kMostMebibytes) << name;
    EXPECT_EQ(content("stdout"), "") << name;
    const std::string said = content("stderr");
    EXPECT_TRUE(std::regex_search(said.substr(0, std::min(said.find('\n'), said.size())), first_line)) << name << ": " << said;
    EXPECT_FALSE(fs::exists("out")) << name;
    longest_ = std::max(longest_, cost.seconds);
    largest_ = std::max(largest_, cost.mebibytes);
  }
  void expect_text_refused(const std::string& name, const std::string& text) {
    static const std::regex kPlaceAndRemedy(R"(^text\.json:[1-9]\d*:[1-9]\d*: error: .*(; | must ))");
    std::ofstream("text.json", std::ios::binary) << text;
    expect_refused(name, "text.json", kPlaceAndRemedy);
  }
  void TearDown() override {
    std::printf("the worst of them: %.3f s, %.1f MiB\n", longest_, largest_);
    RecordProperty("seconds", std::to_string(longest_));
    RecordProperty("MiB", std::to_string(largest_));
  }

  testing::TemporaryDirectory temporary_;
  const fs::path dir_ = temporary_.path();
  double longest_ = 0, largest_ = 0;
};

TEST_F(Program, RefusesEveryTextThatIsNoJson) {
  for (const Kind& kind : refused_kinds()) expect_text_refused(kind.name, kind.text);
}

TEST_F(Program, RefusesEveryMemberThatIsNoJson) {
  for (const Kind& kind : refused_kinds()) expect_text_refused(kind.name, as_member(kind.text));
}

std::string repeated(const std::string& unit, std::size_t bytes) {
  std::string text;
  text.reserve(bytes + unit.size());
  while (text.size() < bytes) text += unit;
  return text;
}

TEST_F(Program, RefusesTheLargestTextsWithinItsLimits) {
  const std::size_t most = (std::size_t{16} << 20) - 1000;
  std::string keys = "{", objects = "{\"body\": {\"solids\": [";
  for (int i = 0; i < 190'000; ++i) keys += fmt::format("\"mass_{}\": 1,\n", i);
  for (int i = 0; i < 60'000; ++i) objects += "{\"shape\": \"disk\", \"radius\": -1},";
  expect_text_refused("values", fmt::format("{{\"a\": [{}0]}}", repeated("0,", most)));
  expect_text_refused("comments", as_member(fmt::format("[{}0]", repeated("[],", most))));
  expect_text_refused("keys", keys + "\"z\": 1}");
  expect_text_refused("solids", objects + "{}]}}");
  expect_text_refused("a key", fmt::format("{{\"{}\": 1}}", repeated("k", most)));
  expect_text_refused("escapes", fmt::format("{{\"a\": \"{}\"}}", repeated("\\u00e9", most)));
  expect_text_refused("lines", repeated("\n", most));
  expect_text_refused("objects", repeated("{\"a\":", most));
}

TEST_F(Program, RefusesAGigabyteAtOnce) {
  std::ofstream("large.json").close();
  ASSERT_EQ(::truncate("large.json", off_t{1} << 30), 0);  // nothing but a size
  expect_refused("a file", "large.json", std::regex("^large\\.json: error: has more than 16 MiB.*; "));
  expect_refused("standard input", "-", std::regex("^<stdin>: error: has more than 16 MiB.*; "), "large.json");
  expect_refused("no end", "-", std::regex("^<stdin>: error: has more than 16 MiB.*; "), "/dev/zero");
  expect_refused("a device", "/dev/zero", std::regex("^/dev/zero: error: is not a regular file; "));
}

}  // namespace
}  // namespace earthtop::hostile_test
