// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/verify/verify.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>

#include "command_line.hpp"
#include "earthtop/run.hpp"
#include "examples.hpp"
#include "interrupt.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "progress_line.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct VerifyArguments {
  std::vector<std::string> files;  // files and directories; if empty, the hard cases inside the program
  bool json = false;
  bool slow = false;
  bool list = false;
};

/// The scenario files of a directory, in alphabetical order. @throws ScenarioError if there are none
std::vector<std::string> files_in(const std::string& directory) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  if (files.empty())
    throw ScenarioError(
        std::vector<Diagnostic>{
            {0, 0, "", error ? "cannot be read (" + error.message() + ")" : "has no scenario file (*.json)"}},
        directory);
  std::sort(files.begin(), files.end());
  return files;
}

/// Reads all sources and checks that each states a criterion; nothing is run before all are known to be sound. @throws
/// ScenarioError, ReadError
std::vector<ScenarioSource> sources_of(const VerifyArguments& arguments) {
  std::vector<ScenarioSource> sources;
  if (arguments.files.empty())
    for (const Example& example : hard_cases())
      sources.push_back({fmt::format("{}.json", example.name), std::string(example.text)});
  for (const std::string& path : arguments.files) {
    if (std::error_code unknown; !std::filesystem::is_directory(path, unknown)) {
      sources.push_back(read_scenario_source(path));
      continue;
    }
    for (const std::string& file : files_in(path)) sources.push_back(read_scenario_source(file));
  }
  for (const ScenarioSource& source : sources) parse_verifiable(source);
  return sources;
}

std::string_view word(VerificationOutcome outcome) {
  switch (outcome) {
    case VerificationOutcome::passed: return "pass";
    case VerificationOutcome::failed: return "FAIL";
    case VerificationOutcome::skipped: break;
  }
  return "skipped";
}

constexpr std::size_t kNameWidth = 28, kCriterionWidth = 66;

/// The name of a case and of its criterion in columns; if they are too long, the line is broken after them.
std::string left_part(const std::string& name, const std::string& criterion) {
  std::string line = fmt::format("{:<{}}  {:<{}}", printable(name), kNameWidth, printable(criterion), kCriterionWidth);
  if (line.size() > kNameWidth + 2 + kCriterionWidth) line += fmt::format("\n{:{}}", "", kNameWidth + 2 + kCriterionWidth);
  return line;
}

std::string line_of(const VerificationRow& row) {
  std::string line = left_part(row.name, row.criterion);
  if (row.outcome == VerificationOutcome::skipped) return fmt::format("{}  {:>27}  {}\n", line, "", "slow: with --slow");
  line += fmt::format("  {:>8.1e}  {:>7.0e}  {:>6.2f}  {}\n", row.error, row.bound, row.seconds, word(row.outcome));
  return row.remark.empty() ? line : fmt::format("{}{:{}}  {}\n", line, "", kNameWidth, printable(row.remark));
}

std::string head() {
  return fmt::format("{}  {:>8}  {:>7}  {:>6}\n", left_part("case", "criterion"), "error", "bound", "cpu s");
}

JsonObject json_of(const VerificationRow& row) {
  const bool judged = row.outcome != VerificationOutcome::skipped;
  JsonObject object;
  object.put("case", row.name).put("criterion", row.criterion).put("why", row.why);
  object.put("outcome", word(row.outcome) == "FAIL" ? "fail" : word(row.outcome));
  judged ? object.put("error", row.error) : object.put_null("error");
  object.put("bound", row.bound);
  judged ? object.put("cpu_s", row.seconds) : object.put_null("cpu_s");
  object.put("remark", row.remark);
  return object;
}

struct Counts {
  std::size_t passed = 0, failed = 0, skipped = 0;
  double seconds = 0;
  void include(const VerificationRow& row) {
    ++(row.outcome == VerificationOutcome::passed ? passed : row.outcome == VerificationOutcome::failed ? failed : skipped);
    seconds += row.seconds;
  }
};

std::string sum_of(const Counts& counts) {
  const std::string skipped = counts.skipped > 0 ? fmt::format(", {} slow ones skipped (--slow)", counts.skipped) : "";
  return fmt::format("{} criteria met, {} not met{}; {:.1f} s of processor time\n", counts.passed, counts.failed, skipped,
                     counts.seconds);
}

int list_criteria(const std::vector<ScenarioSource>& sources) {
  for (const ScenarioSource& source : sources) {
    const Scenario scenario = parse_scenario(source);
    print(fmt::format("{:<{}}  {}\n", scenario.name, kNameWidth, printable(scenario.title)));
    for (const CriterionSpec& criterion : scenario.criteria)
      print(fmt::format("  {}{}\n", criterion_text(criterion), criterion.slow ? " (slow)" : ""));
  }
  return kDone;
}

int verify_verb(const VerifyArguments& arguments) {
  const auto sources = sources_of(arguments);
  if (arguments.list) return list_criteria(sources);
  const OrderlyEnd orderly;
  if (!arguments.json) print(head());
  Progress progress;
  ProgressDisplay display(!arguments.json, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  std::vector<double> work(sources.size());
  if (display.is_shown())
    std::transform(sources.begin(), sources.end(), work.begin(), [&](const ScenarioSource& source) {
      return verification_work(source, {arguments.slow, {}});
    });
  Parts parts(watch, std::accumulate(work.begin(), work.end(), 0.0));
  Counts counts;
  std::vector<JsonObject> rows;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    verify(sources[i], {arguments.slow, parts.next(work[i])}, [&](const VerificationRow& row) {
      counts.include(row);
      if (arguments.json)
        rows.push_back(json_of(row));
      else
        display.aside([&] { print(line_of(row)); });
    });
    if (watch.asks_to_stop())
      return report_errors("", {{0, 0, "", "interrupted; the same command starts again"}}, arguments.json,
                           interrupted_status());
  }
  progress.reach(1);
  if (arguments.json)
    print_json(JsonObject()
                   .put("passed", counts.passed)
                   .put("failed", counts.failed)
                   .put("skipped", counts.skipped)
                   .put("rows", rows));
  else
    display.aside([&] { print(sum_of(counts)); });
  return counts.failed == 0 ? kDone : kNegative;
}

}  // namespace

Verb describe_verify() {
  auto arguments = std::make_shared<VerifyArguments>();
  Verb verify("verify", "run scenarios and judge them by their criteria; the hard cases by default",
              [arguments] { return verify_verb(*arguments); });
  verify.add("SCENARIO", &arguments->files, "scenario files (JSON) with criteria, or directories of them").json_file();
  verify.add("--json", &arguments->json, "print the table as one JSON document, errors too");
  verify.add("--slow", &arguments->slow, "judge criteria, too, that take over a minute");
  verify.add("--list", &arguments->list, "print the criteria; run nothing");
  verify.describe(
      "A criterion owes nothing to the run that it judges: it is an invariant, a closed form, a published "
      "value, an equivalence, an exact zero, an order of convergence, a verdict or a refusal. Without an "
      "operand the hard cases are judged, which are inside the program. The exit status is 1 where a criterion "
      "is not met.");
  verify.example("earthtop verify", "judges the hard cases");
  verify.example("earthtop verify --list", "prints what would be judged");
  verify.example("earthtop verify my.json scenarios/hard", "judges a file and a directory");
  return verify;
}

}  // namespace earthtop::tool
