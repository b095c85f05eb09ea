// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <set>

#include "bench_text.hpp"
#include "command_line.hpp"
#include "earthtop/bench/comparison.hpp"
#include "earthtop/scenario/support.hpp"
#include "output.hpp"
#include "scenario_operand.hpp"
#include "screen.hpp"
#include "text/number_words.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct BenchArguments {
  std::vector<std::string> files;
  std::vector<std::string> sets;
  std::optional<std::string> out;
  std::string workload = "drift";
  std::optional<std::string> error;
  std::vector<std::string> methods;
  std::optional<double> duration_s;
  double limit_s = 1;
  double reference_s = 15;
  int repetitions = 5;
  bool force = false, json = false, quiet = false, brief = false;
};

template <class Enum>
Enum named(const std::string& name, std::initializer_list<Enum> values) {
  return *std::find_if(values.begin(), values.end(), [&](Enum value) { return to_string(value) == name; });
}

Workload workload_of(const BenchArguments& arguments) {
  return named(arguments.workload, {Workload::axis, Workload::motion, Workload::drift});
}

std::optional<ErrorKind> error_kind(const BenchArguments& arguments) {
  if (!arguments.error) return std::nullopt;
  return named(*arguments.error, {ErrorKind::axis, ErrorKind::attitude, ErrorKind::drift});
}

[[noreturn]] void refuse(std::string what) { throw ScenarioError(std::vector<Diagnostic>{{0, 0, "", std::move(what)}}); }

void check_arguments(const BenchArguments& arguments) {
  const std::optional<ErrorKind> kind = error_kind(arguments);
  const Workload workload = workload_of(arguments);
  if ((kind == ErrorKind::drift && workload != Workload::drift) || (kind == ErrorKind::attitude && workload == Workload::axis))
    refuse(fmt::format("--error {}: the workload \"{}\" has no such error; take another --workload", to_string(*kind),
                       to_string(workload)));
  const std::pair<const char*, double> seconds[] = {{"--duration", arguments.duration_s.value_or(1)},
                                                    {"--limit", arguments.limit_s},
                                                    {"--reference-limit", arguments.reference_s}};
  for (const auto& [option, value] : seconds)
    if (!(value > 0 && value <= 1e9)) refuse(fmt::format("{} {}: must be a number above 0 and at most 1e9 (s)", option, value));
  if (std::count(arguments.files.begin(), arguments.files.end(), "-") > 1) refuse("standard input (-) can be read only once");
}

/// Reads all scenarios. @throws ScenarioError with the errors of the first one that has any
std::vector<Scene> read_scenes(const BenchArguments& arguments) {
  const auto overrides = split_sets(arguments.sets);
  std::vector<Scene> scenes;
  std::set<std::string> names;
  for (const std::string& file : arguments.files) {
    const ScenarioSource source = scenario_of(file);
    ScenarioReport report = examine_scenario(source, overrides);
    if (!report.scene) throw ScenarioError(std::move(report.errors), source.file);
    if (!arguments.quiet) report_warnings(source.file, report.warnings);
    if (!names.insert(report.scenario->name).second)
      refuse(fmt::format("two scenarios are named \"{}\"; give them different names", report.scenario->name));
    scenes.push_back(*std::move(report.scene));
  }
  return scenes;
}

/// The scenario, shortened to the duration asked for; if none is, so far that a reference solution can be computed within the
/// reference limit.
Scene to_be_benched(const Scene& scene, const BenchArguments& arguments) {
  const Scenario& scenario = scene.scenario();
  if (!arguments.duration_s) {
    Scene shortened = shortened_for_reference(scene, arguments.reference_s);
    const double duration_s = shortened.scenario().duration_s;
    if (duration_s < scenario.duration_s && !arguments.quiet) {
      const auto [first, whole] = told_apart(duration_s, scenario.duration_s, 6);
      message(
          fmt::format("earthtop: {}: only the first {} s of {} s, because a longer reference would take more than {:g} s; "
                      "--duration or --reference-limit change this",
                      scenario.name, first, whole, arguments.reference_s));
    }
    return shortened;
  }
  Scenario shortened = scenario;
  shortened.duration_s = std::min(scenario.duration_s, *arguments.duration_s);
  shortened.output_step_s = std::min(scenario.output_step_s, shortened.duration_s);
  return resolve(std::move(shortened));
}

/// The standard contenders that were asked for. @throws ScenarioError if none of them fits
std::vector<Contender> contenders_of(const Scene& scene, const BenchArguments& arguments) {
  const Workload workload = workload_of(arguments);
  if (const std::string_view reason = scene.support().no_motion_alone; workload != Workload::drift && !reason.empty())
    refuse(fmt::format("--workload {}: {}", to_string(workload), reason));
  std::vector<Contender> all = standard_contenders(scene, workload);
  if (arguments.methods.empty()) return all;
  const auto is_asked = [&](const Contender& contender) {
    const std::string name(contender.peer ? contender.peer->word : to_string(contender.options.method));
    const auto has = [&](const std::string& method) {
      return std::find(arguments.methods.begin(), arguments.methods.end(), method) != arguments.methods.end();
    };
    return has(name) || (contender.is_auto && has("auto"));
  };
  std::erase_if(all, [&](const Contender& contender) { return !is_asked(contender); });
  std::string asked;
  for (const std::string& method : arguments.methods) asked += (asked.empty() ? "" : ",") + method;
  if (all.empty()) refuse(fmt::format("--methods {}: none of these fits \"{}\"", asked, scene.scenario().name));
  return all;
}

/// A line on a terminal that is written over again and again.
std::function<void(const std::string&)> progress_of(const std::string& scenario, const BenchArguments& arguments) {
  if (arguments.quiet || ::isatty(STDERR_FILENO) != 1) return {};
  return [scenario](const std::string& what) { fmt::print(stderr, "\r\033[K{}: {}", printable(scenario), what); };
}

BenchReport bench_one(const Scene& scene, const BenchArguments& arguments) {
  BenchOptions options;
  options.compared = error_kind(arguments);
  options.repetitions = arguments.repetitions;
  options.most_seconds = arguments.limit_s;
  options.reference_seconds = arguments.reference_s;
  options.progress = progress_of(scene.scenario().name, arguments);
  BenchReport report = bench(scene, contenders_of(scene, arguments), options);
  if (options.progress) fmt::print(stderr, "\r\033[K");
  return report;
}

int bench_verb(const BenchArguments& arguments) {
  check_arguments(arguments);
  std::vector<Scene> scenes;
  std::vector<std::string> names;
  for (const Scene& scene : read_scenes(arguments)) {
    scenes.push_back(to_be_benched(scene, arguments));
    names.push_back(scene.scenario().name);
    scenes.back().require_affordable();
    contenders_of(scenes.back(), arguments);
  }
  if (arguments.out) check_bench_directory(*arguments.out, names, arguments.force);

  std::vector<BenchReport> reports;
  for (const Scene& scene : scenes) {
    reports.push_back(bench_one(scene, arguments));
    if (!arguments.json && !arguments.quiet)
      print((reports.size() > 1 ? "\n" : "") + bench_text(reports.back(), arguments.brief, output_screen().width));
  }
  if (arguments.out) write_bench(reports, *arguments.out, arguments.force);
  if (arguments.json) print(bench_json(reports));
  return kDone;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method method : methods_by(&MethodRow::place_in_bench)) names.emplace_back(to_string(method));
  for (const Peer& peer : peers_built()) names.emplace_back(peer.word);
  return names;
}

}  // namespace

Verb describe_bench() {
  auto arguments = std::make_shared<BenchArguments>();
  BenchArguments& a = *arguments;
  Verb bench("bench", "measure speed against error: every method, tolerance and precision",
             [arguments] { return bench_verb(*arguments); });
  bench.add("SCENARIO", &a.files, kScenarioOperands).required().json_file();
  bench.add("--out", &a.out, "directory in which to write NAME.csv and NAME.svg for each scenario").called("DIR");
  bench.add("--force", &a.force, "overwrite existing files");
  bench.add("--workload", &a.workload, "drift: both motions and the drift (default); motion: one motion; axis: only its axis")
      .called("WHAT")
      .one_of({"drift", "motion", "axis"});
  bench.add("--error", &a.error, "which error is compared; default: that of the workload")
      .called("WHICH")
      .one_of({"drift", "attitude", "axis"});
  bench.add("--methods", &a.methods, "only these methods, separated by commas; auto is the one that run would choose")
      .called("NAMES")
      .with_commas()
      .one_of(method_names());
  bench
      .add("--duration", &a.duration_s,
           "only the first S seconds of the motion; default: as long as the reference can be computed for")
      .called("S");
  bench.add("--repetitions", &a.repetitions, "how many times each contender is timed; default 5").called("N").within(1, 1000);
  bench.add("--limit", &a.limit_s, "stop a contender after S seconds; default 1").called("S");
  bench.add("--reference-limit", &a.reference_s, "the reference may take an estimated S seconds; default 15").called("S");
  bench.add("--brief", &a.brief, "print only the rows of the Pareto front and of auto");
  bench.add("--json", &a.json, "print everything, or the errors, as one JSON document");
  bench.add("--quiet", &a.quiet, "print nothing but errors (and what --json asks for)");
  add_set_option(bench, a.sets);
  bench.describe(
      "Times every method at several tolerances and in every precision that fits the scenario, and measures its error against "
      "a reference. The table marks the Pareto front: the contenders that no other one beats in both speed and error.");
  bench.example("earthtop bench toy-top.json --brief",
                "prints the contenders on the Pareto front, and the one that run would choose");
  bench.example("earthtop bench toy-top.json --methods auto,taylor --out bench",
                "compares taylor with the method that run would choose, and writes the table and a picture");
  bench.example("earthtop bench toy-top.json --duration 1 --json > bench.json", "writes a document, e.g. for earthtop report");
  bench.ends_with(kDone, "the contenders are timed, whether or not some were too slow or failed");
  bench.ends_with(kRefused, "the command line or a scenario was refused, or a file is in the way; nothing was written");
  bench.ends_with(kWriteFailed, "writing failed, or reading a scenario broke off");
  return bench;
}

}  // namespace earthtop::tool
