// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "command_line.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/results/top_lines.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/scenario.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "scenario_operand.hpp"
#include "screen.hpp"
#include "verbs.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

struct CheckArguments {
  std::vector<std::string> files;
  std::vector<std::string> sets;
  bool json = false;
  bool quiet = false;
};

struct CheckedFile {
  std::string file;
  ExitStatus unread = kDone;  // the exit status if the file cannot be read
  ScenarioReport report;
};

CheckedFile check_file(const std::string& path, const std::vector<std::pair<std::string, std::string>>& overrides) {
  try {
    const ScenarioSource source = scenario_of(path);
    return {source.file, kDone, examine_scenario(source, overrides)};
  } catch (const ScenarioError& error) {
    return {error.file(), kRefused, {std::nullopt, error.diagnostics().size(), error.diagnostics()}};
  } catch (const ReadError& error) {
    return {error.file(), kWriteFailed, {std::nullopt, 1, {{0, 0, "", error.reason()}}}};
  }
}

std::string counted(std::size_t count, const char* noun) { return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s"); }

std::string verdict(const CheckedFile& checked) {
  const ScenarioReport& report = checked.report;
  std::string text = printable(checked.file) + ": ";
  if (checked.unread != kDone) {
    text += "cannot be read";
  } else if (!report.scenario) {
    text += counted(report.error_count, "error");
  } else {
    const Scenario& scenario = *report.scenario;
    text +=
        fmt::format("ok, \"{}\", {} rows, about {:.1g} steps", scenario.name,
                    output_times(scenario.duration_s, scenario.output_step_s).size(), report.scene->estimate().solution.steps);
    text += ", " + about_seconds(estimated_run_seconds(*report.scene));
  }
  if (!report.warnings.empty()) text += ", " + counted(report.warnings.size(), "warning");
  if (report.scene) {
    const RunSize size = expected_size(*report.scene);
    text += fmt::format("\n  {} of memory, {} of files", bytes_text(size.memory_bytes), bytes_text(size.file_bytes));
  }
  return text + '\n';
}

/// The figures of the scenario's top, an entry each.
std::string top_text(const Scene& scene, std::size_t width) {
  std::string text = "Your top\n";
  for (const auto& [label, line] : top_lines(scene.top())) text += wrapped_entry("  " + label, line, width, 19);
  return text;
}

void report_text(const std::vector<CheckedFile>& files, bool quiet) {
  for (const CheckedFile& checked : files) {
    report_errors(checked.file, checked.report.errors, false, kDone);
    if (quiet) continue;
    report_warnings(checked.file, checked.report.warnings);
    print(verdict(checked));
    if (files.size() == 1 && checked.report.scene) print(top_text(*checked.report.scene, output_screen().width));
  }
}

void report_json(const std::vector<CheckedFile>& files) {
  std::vector<JsonObject> list, errors, warnings;
  for (const CheckedFile& checked : files) {
    const auto& scenario = checked.report.scenario;
    JsonObject entry;
    entry.put("file", checked.file).put("valid", scenario.has_value());
    scenario ? entry.put("name", scenario->name) : entry.put_null("name");
    entry.put("errors", checked.report.error_count).put("warnings", checked.report.warnings.size());
    checked.report.scene ? entry.put_json("top", top_json(*checked.report.scene)) : entry.put_null("top");
    if (checked.report.scene) {
      const RunSize size = expected_size(*checked.report.scene);
      entry.put("seconds", estimated_run_seconds(*checked.report.scene));
      entry.put("memory_bytes", size.memory_bytes).put("file_bytes", size.file_bytes);
    } else {
      entry.put_null("seconds").put_null("memory_bytes").put_null("file_bytes");
    }
    list.push_back(std::move(entry));
    for (const Diagnostic& error : checked.report.errors) errors.push_back(diagnostic_json(checked.file, error));
    for (const Diagnostic& warning : checked.report.warnings) warnings.push_back(diagnostic_json(checked.file, warning));
  }
  JsonObject document;
  document.put("valid", errors.empty()).put("files", list).put("errors", errors).put("warnings", warnings);
  print_json(document);
}

int check_verb(const CheckArguments& arguments) {
  const auto overrides = split_sets(arguments.sets);
  std::vector<CheckedFile> files;
  for (const std::string& path : arguments.files) files.push_back(check_file(path, overrides));
  arguments.json ? report_json(files) : report_text(files, arguments.quiet);
  const auto any = [&](auto predicate) { return std::any_of(files.begin(), files.end(), predicate); };
  for (const ExitStatus status : {kWriteFailed, kRefused})
    if (any([&](const CheckedFile& checked) { return checked.unread == status; })) return status;
  return any([](const CheckedFile& checked) { return !checked.report.scenario; }) ? kNegative : kDone;
}

}  // namespace

Verb describe_check() {
  auto arguments = std::make_shared<CheckArguments>();
  Verb check("check", "list everything that is wrong in scenario files; run nothing",
             [arguments] { return check_verb(*arguments); });
  check.add("SCENARIO", &arguments->files, kScenarioOperands).required().json_file();
  check.add("--json", &arguments->json, "print what was found as one JSON document");
  check.add("--quiet", &arguments->quiet, "print nothing but errors");
  add_set_option(check, arguments->sets);
  check.describe(
      "Reads every file as run does. Lists everything that is wrong in it, each error with line, column and JSON pointer, and "
      "warns of values that are hardly what was meant. For a valid file it prints how many rows a run would have, how long "
      "it would take, and how much memory and disk; for a single one, it also prints the mass, the centre of mass and the "
      "moments of the top, how fast it "
      "precesses and nutates, and how its spin compares with the critical one.");
  check.example("earthtop check toy-top.json", "checks a file and prints the figures of its top");
  check.example("earthtop check *.json --quiet", "checks all files of a directory, and prints nothing but errors");
  check.example("earthtop check toy-top.json --set /release/spin_rpm=1800", "checks it with another spin");
  check.ends_with(kDone, "no file has an error; some may have warnings");
  check.ends_with(kNegative, "a file has errors");
  check.ends_with(kRefused, "the command line was refused, or a file is missing or cannot be opened");
  check.ends_with(kWriteFailed, "reading a file broke off, or writing to standard output failed");
  return check;
}

}  // namespace earthtop::tool
