#include "earthtop/run.hpp"

#include <fmt/format.h>

#include <csignal>
#include <filesystem>

#include "earthtop/results/results.hpp"
#include "output.hpp"
#include "summary_text.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

volatile std::sig_atomic_t g_signal = 0;

extern "C" void stop_running(int signal) {
  g_signal = signal;
  request_interrupt();
}

/// The first SIGINT or SIGTERM asks the run to stop; the second one kills.
void install_stop_handlers() {
  struct sigaction action {};
  action.sa_handler = stop_running;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction old {};
    // A shell's background job has SIGINT ignored: it stays so.
    if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

std::vector<std::pair<std::string, std::string>> split_overrides(const std::vector<std::string>& sets) {
  std::vector<std::pair<std::string, std::string>> overrides;
  std::vector<Diagnostic> errors;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || !set.starts_with('/'))
      errors.push_back({0, 0, "", fmt::format("--set {}: is not /json/pointer=VALUE", set)});
    else
      overrides.emplace_back(set.substr(0, equals), set.substr(equals + 1));
  }
  if (!errors.empty()) throw ScenarioError(std::move(errors));
  return overrides;
}

}  // namespace

int run_verb(const RunArguments& arguments) {
  const auto overrides = split_overrides(arguments.sets);
  const Scenario scenario = parse_scenario(read_scenario_source(arguments.scenario), overrides);
  const std::filesystem::path dir = arguments.out ? *arguments.out : "out/" + scenario.name;
  check_output_directory(dir, scenario, arguments.force);

  install_stop_handlers();
  const RunResult result = run(scenario);
  if (result.status == RunStatus::interrupted) {
    const int signal = g_signal != 0 ? g_signal : SIGINT;
    return report_errors("",
                         {{0, 0, "",
                           fmt::format("interrupted at t = {} s of {} s; nothing was written, the same command starts it again",
                                       result.reached_s, scenario.duration_s)}},
                         arguments.json, 128 + signal);
  }
  write_results(result, dir, arguments.force);
  if (arguments.json)
    print(summary_json(result));
  else if (!arguments.quiet)
    print(summary_text(result, dir.string(), wants_color()));
  if (result.status == RunStatus::completed) return kDone;
  message(fmt::format("earthtop: error: numerical failure ({}) at t = {} s of {} s; the rows up to it are in {}",
                      to_string(result.status), result.reached_s, scenario.duration_s, dir.string()));
  return kNumericalFailure;
}

}  // namespace earthtop::tool
