// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/verify/verify.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <utility>

#include "command_line.hpp"
#include "earthtop/run.hpp"
#include "examples.hpp"
#include "input/file.hpp"
#include "interrupt.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "progress_line.hpp"
#include "screen.hpp"
#include "verbs.hpp"
#include "wrapped.hpp"

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
  for (const std::string& name : input::names_in(directory))
    if (const std::filesystem::path file = std::filesystem::path(directory) / name; file.extension() == ".json")
      files.push_back(file.string());
  if (files.empty()) throw ScenarioError(std::vector<Diagnostic>{{0, 0, "", "has no scenario file (*.json)"}}, directory);
  return files;
}

/// Reads all sources and checks that each states a criterion; nothing is run before all are known to be valid. @throws
/// ScenarioError, ReadError
std::vector<ScenarioSource> sources_of(const VerifyArguments& arguments) {
  std::vector<ScenarioSource> sources;
  if (arguments.files.empty())
    for (const Example& example : hard_cases())
      sources.push_back({fmt::format("{}.json", example.name), std::string(example.text)});
  for (const std::string& path : arguments.files) {
    if (path == "-" || input::type_of(path) != input::PathType::directory) {
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

constexpr std::size_t kNameWidth = 28, kCriterionWidth = 47;

/// The criterion in the table's first column; one that is too long has a line of its own.
std::string criterion_cell(const std::string& criterion) {
  const std::string cell = "  " + printable(criterion);
  const std::size_t columns = columns_of(cell);
  if (columns <= kCriterionWidth) return cell + std::string(kCriterionWidth - columns, ' ');
  return cell + '\n' + std::string(kCriterionWidth, ' ');
}

/// The lines of a criterion, below the name of its case.
std::string lines_of(const VerificationRow& row, std::size_t width) {
  const std::string cell = criterion_cell(row.criterion);
  if (row.outcome == VerificationOutcome::skipped) return cell + "  slow: judged with --slow\n";
  const std::string line =
      fmt::format("{} {:>8.1e} {:>7.0e} {:>7.2f}  {}\n", cell, row.error, row.bound, row.seconds, word(row.outcome));
  return row.remark.empty() ? line : line + wrapped("      " + printable(row.remark), width, 6) + '\n';
}

std::string head() {
  return fmt::format("{:<{}} {:>8} {:>7} {:>7}\n", "case, criterion", kCriterionWidth, "error", "bound", "cpu s");
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
  const std::size_t width = output_screen().width;
  for (const ScenarioSource& source : sources) {
    const Scenario scenario = parse_scenario(source);
    print(wrapped_entry(scenario.name, printable(scenario.title), width, kNameWidth + 2));
    for (const CriterionSpec& criterion : scenario.criteria)
      print(wrapped(fmt::format("  {}{}", criterion_text(criterion), criterion.slow ? " (slow)" : ""), width, 6) + '\n');
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
  std::string name;  // of the last case printed
  const std::size_t width = output_screen().width;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    verify(sources[i], {arguments.slow, parts.next(work[i])}, [&](const VerificationRow& row) {
      counts.include(row);
      if (arguments.json) {
        rows.push_back(json_of(row));
        return;
      }
      const std::string heading = std::exchange(name, row.name) == row.name ? "" : printable(row.name) + '\n';
      display.aside([&] { print(heading + lines_of(row, width)); });
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
  verify.add("--json", &arguments->json, "print the table, or the errors, as one JSON document");
  verify.add("--slow", &arguments->slow, "also judge criteria that take more than a minute");
  verify.add("--list", &arguments->list, "print the criteria; run nothing");
  verify.describe(
      "A criterion does not depend on the run that it judges: it is an invariant, a closed form, a published value, an "
      "equivalence, an exact zero, an order of convergence, a verdict or a refusal. Without an operand, verify judges the hard "
      "cases that are built into the program. For each criterion it prints the error and the bound that the error must not "
      "exceed.");
  verify.example("earthtop verify", "judges the hard cases");
  verify.example("earthtop verify --list", "prints what would be judged");
  verify.example("earthtop verify my-case.json cases/", "judges a file, and all files of a directory");
  verify.ends_with(kDone, "every criterion that was judged is met");
  verify.ends_with(kNegative, "a criterion is not met");
  verify.ends_with(kRefused, "the command line or a scenario was refused, or a scenario has no criteria; nothing was run");
  verify.ends_with(kWriteFailed, "reading a scenario broke off, or writing to standard output failed");
  return verify;
}

}  // namespace earthtop::tool
