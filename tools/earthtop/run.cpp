// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/run.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "command_line.hpp"
#include "earthtop/results/results.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress_line.hpp"
#include "scenario_operand.hpp"
#include "screen.hpp"
#include "summary_text.hpp"
#include "text/number_words.hpp"
#include "text/shell_word.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct RunArguments {
  std::string scenario;  // a file, or "-"
  std::optional<std::string> out;
  bool force = false;
  bool json = false;
  bool quiet = false;
  bool with_all = false;
  bool no_step_limit = false;
  bool partial = false;
  unsigned jobs = 0;
  std::vector<std::string> sets;
};

int interrupted(const RunArguments& arguments, const std::string& where) {
  return report_errors("",
                       {{0, 0, "", fmt::format("interrupted {}; nothing was written; the same command starts again", where)}},
                       arguments.json, interrupted_status());
}

/// Whether --set changed the prediction, and not only how it is computed or reported.
bool is_another_scene(Scenario scenario, const ScenarioSource& source) {
  const auto original = examine_scenario(source).scene;
  if (!original) return true;
  const Scenario& before = original->scenario();
  scenario.name = before.name;
  scenario.numerics = before.numerics;
  scenario.precision = before.precision;
  scenario.ledger = before.ledger;
  scenario.output_step_s = before.output_step_s;
  scenario.threshold_rad = before.threshold_rad;
  return identity_json(scenario) != original->identity();
}

struct RequestedScene {
  Scene scene;
  bool is_changed;  ///< the file says something else
};

RequestedScene read_scene(const RunArguments& arguments) {
  const ScenarioSource source = scenario_of(arguments.scenario);
  ScenarioReport report = examine_scenario(source, split_sets(arguments.sets));
  if (!report.scene) throw ScenarioError(std::move(report.errors), source.file);
  if (!arguments.quiet) report_warnings(source.file, report.warnings);
  const bool is_changed = !arguments.sets.empty() && is_another_scene(*report.scenario, source);
  if (!arguments.no_step_limit) return {*std::move(report.scene), is_changed};
  report.scenario->numerics.stops_beyond_estimate = false;
  return {resolve(*std::move(report.scenario)), is_changed};
}

/// Reports a run that was interrupted and leaves nothing, and whether --partial would have kept its rows.
int report_nothing_kept(const RunResult& result, const RunArguments& arguments) {
  if (!result.solution_is_whole)
    return interrupted(
        arguments, fmt::format("at t = {} of {}", time_text(result.reached_s), time_text(result.scene.scenario().duration_s)));
  const char* message =
      "interrupted when the motion was complete, but not the bounds on its error or its verdict; nothing was written; the same "
      "command starts again; with --partial an interrupted run keeps the rows";
  return report_errors("", {{0, 0, "", message}}, arguments.json, interrupted_status());
}

struct WrittenRun {
  RunResult result;
  bool is_written = true;
  bool was_interrupted = false;  ///< before the results were written
  std::string summary = {};      ///< as it was written
};

/// Runs and writes the results, with one progress display for both.
WrittenRun run_and_write(const Scene& scene, const std::filesystem::path& dir, const RunArguments& arguments) {
  const OrderlyEnd orderly(arguments.partial);
  Progress progress;
  const ProgressDisplay display(!arguments.quiet && !arguments.json, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  const double writing = writing_seconds(scene), share = writing / (writing + estimated_run_seconds(scene));
  WrittenRun run{earthtop::run(scene, {.watch = watch.part(0, 1 - share),
                                       .partial = arguments.partial,
                                       .jobs = arguments.jobs,
                                       .row_by_row = !arguments.partial})};
  run.was_interrupted = run.result.status == RunStatus::interrupted;
  run.is_written = !run.was_interrupted || is_partial(run.result);
  if (!run.is_written) return run;
  if (run.was_interrupted) lift_time_limit();
  try {
    run.summary = write_results(run.result, dir, arguments.force, watch.part(1 - share, 1, "writing"));
  } catch (const Interrupted&) {
    if (!arguments.partial) throw;
    run.was_interrupted = true;
    lift_time_limit();
    run.summary = write_results(run.result, dir, arguments.force);
  }
  if (!run.was_interrupted) progress.reach(1);
  return run;
}

/// The drift over time as a sparkline: one line of block characters, each as high as the largest drift in its part of the run.
/// @param width  columns of the line
std::string sparkline(const RunResult& result, std::size_t width) {
  constexpr std::size_t kLeast = 8, kMost = 48;
  constexpr std::array<const char*, 8> kLevels = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  const std::vector<DriftRow>& seen = result.looks.size() > 1 ? result.looks : result.rows;
  double largest = result.drift.axis_max_rad;
  for (const DriftRow& row : seen) largest = std::max(largest, row.drift_axis_rad);
  if (!(largest > 0) || seen.size() < 2) return "";
  std::string line = "Drift       0 s ";
  const std::string end = fmt::format(" {:g} s, the largest {:.3g} rad\n", seen.back().t_s, largest);
  const std::size_t room = width - std::min(width, line.size() + end.size() - 1);
  const std::size_t columns = std::min(std::clamp(room, kLeast, kMost), seen.size());
  for (std::size_t i = 0; i < columns; ++i) {
    double most = 0;
    for (std::size_t k = i * seen.size() / columns; k < (i + 1) * seen.size() / columns; ++k)
      most = std::max(most, seen[k].drift_axis_rad);
    line += kLevels[static_cast<std::size_t>(std::clamp(most / largest * 8, 0.0, 7.0))];
  }
  return line + end;
}

void print_text(const RunResult& result, const Written& where, bool is_changed, bool with_all) {
  const Screen screen = output_screen();
  const std::string line = is_lively_terminal(STDOUT_FILENO) ? sparkline(result, screen.width) : "";
  print((with_all ? summary_text : brief_text)(result, where, is_changed, screen, line));
}

/// The command of these arguments, with another directory.
std::string command_with_out(const RunArguments& arguments, const std::filesystem::path& dir) {
  std::string command = "earthtop run " + shell_word(arguments.scenario);
  for (const std::string& set : arguments.sets) command += " --set " + shell_word(set);
  return command + " --out " + shell_word(dir.string());
}

/// Where the results go: what was asked for, or the first directory of the scenario's name where nothing would be lost.
Written output_directory(const RunArguments& arguments, const Scene& scene) {
  const std::string usual = "out/" + scene.scenario().name, dir = arguments.out.value_or(usual);
  if (!arguments.out && !arguments.force) {
    const std::string free = free_output_directory(usual, scene).string();
    return {free, free == usual ? "" : usual};
  }
  try {
    check_output_directory(dir, scene, arguments.force);
  } catch (const ScenarioError& error) {
    if (std::error_code unseen; arguments.force || !std::filesystem::is_directory(dir, unseen)) throw;
    std::vector<Diagnostic> refusal = error.diagnostics();
    refusal.back().message += "; for example: " + command_with_out(arguments, free_output_directory(dir, scene));
    throw ScenarioError(std::move(refusal), error.file());
  }
  return {dir, ""};
}

int run_verb(const RunArguments& arguments) try {
  const auto [scene, is_changed] = read_scene(arguments);
  const Scenario& scenario = scene.scenario();
  const Written where = output_directory(arguments, scene);
  const std::filesystem::path dir = where.directory;

  const auto [result, is_written, was_interrupted, summary] = run_and_write(scene, dir, arguments);
  if (!is_written) return report_nothing_kept(result, arguments);
  if (was_interrupted)
    message(fmt::format(
        "earthtop: error: interrupted; {}, in {}",
        is_partial(result) ? "the rows are whole, but without error bounds and verdict" : "but the results are whole",
        printable(dir.string())));
  try {
    if (arguments.json)
      print(summary);
    else if (!arguments.quiet)
      print_text(result, where, is_changed, arguments.with_all);
    if ((arguments.json || arguments.quiet) && !where.taken.empty())
      message(fmt::format("note: the results are in {}, as {} holds other results", printable(where.directory),
                          printable(where.taken)));
  } catch (const WriteError& error) {
    throw WriteError(error.file(), fmt::format("{}; the results are whole, in {}", error.reason(), dir.string()));
  }
  if (was_interrupted) return interrupted_status();
  if (result.status == RunStatus::completed && result.accuracy && !result.accuracy->reached()) {
    message(fmt::format("earthtop: error: the drift error asked for, {} rad, was not reached: its bound is {} rad",
                        result.accuracy->asked_rad,
                        told_apart(result.accuracy->reached_rad, result.accuracy->asked_rad, 2).first));
    return kNumericalFailure;
  }
  if (result.status == RunStatus::completed) return kDone;
  if (result.status == RunStatus::step_limit) {
    message(fmt::format("earthtop: error: stopped ({}) at t = {} of {}: {}; the rows up to it are in {}{}",
                        to_string(result.status), time_text(result.reached_s), time_text(scenario.duration_s),
                        why_limited(result), printable(dir.string()),
                        stopped_beyond_estimate(result) ? "; --no-step-limit goes on" : ""));
    return kNumericalFailure;
  }
  message(fmt::format("earthtop: error: numerical failure ({}) at t = {} of {}; the rows up to it are in {}",
                      to_string(result.status), time_text(result.reached_s), time_text(scenario.duration_s),
                      printable(dir.string())));
  return kNumericalFailure;
} catch (const Interrupted&) {
  return interrupted(arguments, "before the results were in place");
}

}  // namespace

Verb describe_run() {
  auto arguments = std::make_shared<RunArguments>();
  Verb run("run", "predict a top's motion with and without the Earth's rotation, and how far the two drift apart",
           [arguments] { return run_verb(*arguments); });
  run.add("SCENARIO", &arguments->scenario, kScenarioOperand).required().json_file();
  run.add("--out", &arguments->out,
          "directory for the results; default: out/<name>, or out/<name>-2 and so on where that has others")
      .called("DIR");
  run.add("--force", &arguments->force, "overwrite the results of another scenario");
  run.add("--partial", &arguments->partial,
          "if the run is interrupted when only error bounds and verdict are missing, write the rows without them");
  run.add("--json", &arguments->json, "print the summary, or the errors, as one JSON document");
  run.add("--long", &arguments->with_all, "print everything that is known of the run");
  run.add("--quiet", &arguments->quiet, "print nothing but errors (and what --json asks for)");
  run.add("--no-step-limit", &arguments->no_step_limit,
          "continue beyond ten times the estimated number of steps, where a run would otherwise stop");
  arguments->jobs = std::thread::hardware_concurrency() > 1 ? 2 : 1;
  run.add("--jobs", &arguments->jobs,
          "number of threads: with two, the error bounds are computed at the same time as the motion; default: 2, or 1 on a "
          "single core")
      .called("N")
      .within(1, 4096);
  add_set_option(run, arguments->sets);
  run.describe(
      "Integrates the top's motion in the laboratory that turns with the Earth, and also the motion that is predicted without "
      "the Earth's rotation. The difference between the two is the drift; it is reported with a bound on its error and a "
      "verdict on how far it can be trusted. The directory receives trajectory.csv, summary.json, timing.json and drift.svg, "
      "and torques.csv if the scenario asks for a ledger. These files are replaced together or not at all. The results of "
      "another scenario are overwritten only with --force. Standard output shows what drifts, how surely that is known and "
      "why; with "
      "--long everything, and with --json the "
      "content of summary.json.");
  run.example("earthtop run toy-top.json", "predicts the motion and writes it to out/toy-top");
  run.example("earthtop run toy-top.json --set /site/latitude_deg=60 --out north", "the same at another latitude");
  run.example("earthtop example foucault-pendulum | earthtop run -", "takes the scenario from standard input");
  run.example("earthtop run toy-top.json --json > summary.json", "prints the summary as JSON, for other programs");
  run.ends_with(kDone, "the run is complete and its results are written, whatever the verdict on the drift");
  run.ends_with(kRefused,
                "the command line or the scenario was refused, or the directory holds the results of another scenario; nothing "
                "was written");
  run.ends_with(kNumericalFailure,
                "the run stopped early, by a numerical failure or at its limit of steps, and the rows before that are kept; or "
                "the accuracy asked for was not reached; or memory or threads ran out");
  run.ends_with(kWriteFailed,
                "writing failed, or reading the scenario broke off; if only standard output failed, the results are whole");
  run.ends_with(
      kInterrupted,
      "interrupted by SIGHUP, SIGINT or SIGTERM; nothing was written, or with --partial the rows, if they were whole");
  return run;
}

}  // namespace earthtop::tool
