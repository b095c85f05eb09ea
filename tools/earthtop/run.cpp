#include "earthtop/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include "earthtop/results/results.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress_line.hpp"
#include "summary_text.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct RunArguments {
  std::string scenario;  // a file, or "-"
  std::optional<std::string> out;
  bool force = false;
  bool json = false;
  bool quiet = false;
  bool no_step_limit = false;
  std::vector<std::string> sets;
};

int interrupted(const RunArguments& arguments, const std::string& where) {
  return report_errors(
      "", {{0, 0, "", fmt::format("interrupted {}; nothing was written, the same command starts it again", where)}},
      arguments.json, interrupted_status());
}

/// Whether --set changed what is predicted, and not only how it is computed or what is reported of it.
bool is_another_scene(Scenario scenario, const ScenarioSource& source) {
  const auto original = examine_scenario(source).scenario;
  if (!original) return true;
  scenario.name = original->name;
  scenario.numerics = original->numerics;
  scenario.precision = original->precision;
  scenario.ledger = original->ledger;
  scenario.output_step_s = original->output_step_s;
  scenario.threshold_rad = original->threshold_rad;
  return canonical_json(scenario) != canonical_json(*original);
}

struct RequestedScene {
  Scenario scenario;
  bool is_changed;  ///< the file says something else
};

RequestedScene read_scenario(const RunArguments& arguments) {
  const ScenarioSource source = read_scenario_source(arguments.scenario);
  ScenarioReport report = examine_scenario(source, split_sets(arguments.sets));
  if (!report.scenario) throw ScenarioError(std::move(report.errors), source.file);
  if (!arguments.quiet) report_warnings(source.file, report.warnings);
  report.scenario->numerics.stops_beyond_estimate = !arguments.no_step_limit;
  const bool is_changed = !arguments.sets.empty() && is_another_scene(*report.scenario, source);
  return {*std::move(report.scenario), is_changed};
}

RunResult run_watched(const Scenario& scenario, const RunArguments& arguments) {
  const ElapsedLine line(!arguments.quiet && !arguments.json, estimated_seconds(scenario));
  return run(scenario);
}

/// The drift over time in one line of a terminal.
std::string sparkline(const RunResult& result) {
  constexpr std::size_t kColumns = 48;
  constexpr std::array<const char*, 8> kLevels = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  double largest = 0;
  for (const DriftRow& row : result.rows) largest = std::max(largest, row.drift_axis_rad);
  if (!(largest > 0) || result.rows.size() < 2) return "";
  std::string line = "Drift       0 s ";
  const std::size_t columns = std::min(kColumns, result.rows.size());
  for (std::size_t i = 0; i < columns; ++i) {
    const DriftRow& row = result.rows[i * (result.rows.size() - 1) / (columns - 1)];
    line += kLevels[static_cast<std::size_t>(std::clamp(row.drift_axis_rad / largest * 8, 0.0, 7.0))];
  }
  return line + fmt::format(" {:g} s, the largest {:.3g} rad\n", result.rows.back().t_s, largest);
}

int run_verb(const RunArguments& arguments) try {
  const auto [scenario, is_changed] = read_scenario(arguments);
  const std::filesystem::path dir = arguments.out ? *arguments.out : "out/" + scenario.name;
  check_output_directory(dir, scenario, arguments.force);

  install_stop_handlers();
  const RunResult result = run_watched(scenario, arguments);
  if (result.status == RunStatus::interrupted)
    return interrupted(arguments, fmt::format("at t = {} s of {} s", result.reached_s, scenario.duration_s));
  write_results(result, dir, arguments.force);
  try {
    if (arguments.json)
      print(summary_json(result));
    else if (!arguments.quiet)
      print(summary_text(result, dir.string(), is_changed, wants_color()) +
            (is_lively_terminal(STDOUT_FILENO) ? sparkline(result) : ""));
  } catch (const WriteError& error) {
    throw WriteError(error.file(), fmt::format("{}; the results are whole, in {}", error.reason(), dir.string()));
  }
  if (result.status == RunStatus::completed && result.accuracy && !result.accuracy->reached()) {
    message(fmt::format("earthtop: error: the drift error asked for, {} rad, was not reached: it is {:.2g} rad",
                        result.accuracy->asked_rad, result.accuracy->reached_rad));
    return kNumericalFailure;
  }
  if (result.status == RunStatus::completed) return kDone;
  if (result.status == RunStatus::step_limit) {
    message(fmt::format(
        "earthtop: error: stopped ({}) at t = {} s of {} s: {}; the rows up to it are in {}; "
        "--no-step-limit goes on",
        to_string(result.status), result.reached_s, scenario.duration_s, why_limited(result), printable(dir.string())));
    return kNumericalFailure;
  }
  message(fmt::format("earthtop: error: numerical failure ({}) at t = {} s of {} s; the rows up to it are in {}",
                      to_string(result.status), result.reached_s, scenario.duration_s, printable(dir.string())));
  return kNumericalFailure;
} catch (const Interrupted&) {
  return interrupted(arguments, "before the results were in place");
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* run = app.add_subcommand("run", "predict a top's motion with and without the Earth's rotation, and its drift");
  run->add_option("SCENARIO", arguments->scenario, "scenario file (JSON); - is standard input")->required();
  run->add_option("--out", arguments->out, "directory of the results; default: out/<name>")->type_name("DIR");
  run->add_flag("--force", arguments->force, "overwrite the results of another scenario");
  run->add_flag("--json", arguments->json, "print the summary as one JSON document, errors too");
  run->add_flag("--quiet", arguments->quiet, "print nothing but errors (and what --json asks for)");
  run->add_flag("--no-step-limit", arguments->no_step_limit,
                "go on where the run takes more than ten times the steps estimated; without it, it stops there");
  add_set_option(*run, arguments->sets);
  run->callback([&action, arguments] { action = [arguments] { return run_verb(*arguments); }; });
}

}  // namespace earthtop::tool
