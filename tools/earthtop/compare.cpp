// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/compare/compare.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "command_line.hpp"
#include "compare_text.hpp"
#include "earthtop/measure/measurement.hpp"
#include "earthtop/measure/releases_file.hpp"
#include "earthtop/results/output_files.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scenario/reference.hpp"
#include "input/file.hpp"
#include "interrupt.hpp"
#include "json_object.hpp"
#include "measurement_text.hpp"
#include "output.hpp"
#include "places.hpp"
#include "progress_line.hpp"
#include "screen.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct CompareArguments {
  std::string reference;
  std::vector<std::string> others;
  std::string candidate;  // the only one of the others, but for several releases
  std::string profile, tolerances, mapping, junit, svg, reason;
  std::vector<std::string> may_change;
  std::vector<std::string> estimates, shared, sets;  // for a measurement, as are the next four
  std::string fitted;
  std::optional<double> correlation_time_s;
  std::vector<std::string> columns, sigmas;
  double time_offset_s = 0;
  bool priors = false, free_start = false, force = false;
  std::optional<double> until_s;
  double steps_ratio = 0, seconds_ratio = 0;  // 0: not given
  bool may_lack_rows = false, update = false;
  bool json = false, quiet = false, all = false;
};

CompareOptions options_of(const CompareArguments& arguments) {
  CompareOptions options;
  if (!arguments.tolerances.empty()) options.tolerances = read_tolerances(arguments.tolerances);
  for (const Profile profile : {Profile::bitwise, Profile::regression, Profile::physics})
    if (arguments.profile == to_string(profile)) options.tolerances.profile = profile;
  if (arguments.steps_ratio > 0) options.tolerances.steps_ratio = arguments.steps_ratio;
  if (arguments.seconds_ratio > 0) options.tolerances.seconds_ratio = arguments.seconds_ratio;
  options.mapping = arguments.mapping;
  for (const std::string& key : arguments.may_change) options.may_change.push_back(scenario_pointer(key));
  options.may_lack_rows = arguments.may_lack_rows;
  options.until_s = arguments.until_s;
  options.with_curves = arguments.json || !arguments.svg.empty();
  return options;
}

int update_verb(const CompareArguments& arguments) try {
  const OrderlyEnd orderly;
  std::vector<std::string> unchanged;
  const std::vector<std::string> written =
      update_reference(arguments.reference, arguments.candidate, arguments.reason, Watch(stop_flag()), &unchanged);
  if (arguments.json)
    print_json(JsonObject().put("written", written).put("unchanged", unchanged).put("reason", arguments.reason));
  else if (!arguments.quiet) {
    for (const std::string& path : written) print(fmt::format("new reference: {}\n", printable(path)));
    for (const std::string& path : unchanged) print(fmt::format("unchanged: {}\n", printable(path)));
  }
  return kDone;
} catch (const Interrupted&) {
  return report_interruption(arguments.json);
}

/// Whether a JSON file has one of these keys.
bool has_a_key(const std::string& path, const std::vector<std::string_view>& wanted) {
  if (!path.ends_with(".json") || input::type_of(path) != input::PathType::file) return false;
  const std::vector<std::string> keys = json_keys(read_scenario_source(path).text);
  return std::any_of(keys.begin(), keys.end(),
                     [&](const std::string& key) { return std::ranges::find(wanted, key) != wanted.end(); });
}

/// Whether a path leads to a scenario, with which measurements are compared, and not to a compact reference.
bool is_scenario(const std::string& path) { return path == "-" || has_a_key(path, {"body", "release", "motion"}); }

MeasurementOptions measurement_options(const CompareArguments& arguments) {
  MeasurementOptions options;
  options.estimates = arguments.estimates;
  if (arguments.free_start) options.estimates = with_free_start_estimates(std::move(options.estimates));
  options.shared = arguments.shared;
  options.priors = arguments.priors;
  options.correlation_time_s = arguments.correlation_time_s.value_or(0);
  if (arguments.json || !arguments.svg.empty()) options.curve_points = MeasurementOptions::kCurvePoints;
  return options;
}

/// A scenario and its changes as they are compared: with a free start the changes are in the text.
std::pair<ScenarioSource, Overrides> given(const std::string& scenario, Overrides overrides, bool free_start) {
  ScenarioSource source = read_scenario_source(scenario);
  if (!free_start) return {std::move(source), std::move(overrides)};
  return {with_free_start(source, overrides), {}};
}

MeasurementReport measure_watched(const ScenarioSource& source, const Overrides& overrides, const Measurement& measurement,
                                  const CompareArguments& arguments) {
  const OrderlyEnd orderly;
  Progress progress;
  const ProgressDisplay display(!arguments.quiet && !arguments.json, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  MeasurementReport report = compare_with_measurement(source, overrides, measurement, measurement_options(arguments), watch);
  if (!watch.asks_to_stop()) progress.reach(1);
  return report;
}

/// Checks before the work that the fitted scenario can be written. @throws ScenarioError
void require_place_for_scenario(const ScenarioSource& source, const Overrides& overrides, const CompareArguments& arguments) {
  if (arguments.fitted.empty()) return;
  if (arguments.estimates.empty() && !arguments.free_start)
    throw ScenarioError("", "--write-scenario writes estimates into the scenario; name them with --estimate");
  require_writable_scenario(source, overrides, arguments.fitted);
}

/// Refuses options that belong to the comparison of results.
void require_options_of_a_measurement(const CompareArguments& arguments) {
  const bool other_options = !arguments.profile.empty() || !arguments.tolerances.empty() || !arguments.mapping.empty() ||
                             !arguments.junit.empty() || !arguments.may_change.empty() || arguments.steps_ratio > 0 ||
                             arguments.seconds_ratio > 0 || arguments.may_lack_rows || arguments.until_s;
  if (other_options)
    throw ScenarioError(
        "",
        "a measurement is compared with a scenario by its own standard errors: the only options are then --columns, --sigma, "
        "--time-offset, --estimate, --shared, --priors, --free-start, --correlation-time, --write-scenario, --force, --set, "
        "--svg, --json and --quiet");
  if (arguments.correlation_time_s && !(*arguments.correlation_time_s > 0))
    throw ScenarioError("", "--correlation-time must be above 0 (s); leave it out where errors are independent");
}

int status_of(RunStatus status, bool agrees) {
  if (status != RunStatus::completed) return kNumericalFailure;
  return agrees ? kDone : kNegative;
}

/// How a measurement is to be read. @param listed  what a list of releases says of it, which goes first
MeasurementFormat format_of(const CompareArguments& arguments, MeasurementFormat listed = {}) {
  listed.columns.insert(listed.columns.end(), arguments.columns.begin(), arguments.columns.end());
  listed.sigmas.insert(listed.sigmas.end(), arguments.sigmas.begin(), arguments.sigmas.end());
  listed.time_offset_s += arguments.time_offset_s;
  return listed;
}

/// Several releases, from the command line or from a list.
int releases_verb(const CompareArguments& arguments, const ListedReleases& list) {
  require_options_of_a_measurement(arguments);
  if (!arguments.fitted.empty() || !arguments.svg.empty())
    throw ScenarioError("",
                        "--write-scenario and --svg are for one release; for several, keep what --json prints, and make a page "
                        "of it with earthtop report");
  MeasurementOptions options = measurement_options(arguments);
  options.estimates.insert(options.estimates.end(), list.estimates.begin(), list.estimates.end());
  options.shared.insert(options.shared.end(), list.shared.begin(), list.shared.end());
  std::vector<MeasuredRelease> releases;
  for (const ListedRelease& listed : list.releases) {
    if (listed.measurement.empty())
      throw ScenarioError("/releases",
                          fmt::format("the release of {} has no measurement; add \"measurement\"", listed.scenario));
    Overrides overrides = split_sets(arguments.sets);
    for (auto& change : split_sets(listed.sets)) overrides.push_back(std::move(change));
    auto [source, changes] = given(listed.scenario, std::move(overrides), arguments.free_start);
    releases.push_back({std::move(source), std::move(changes),
                        read_measurement(listed.measurement, format_of(arguments, listed.format)), listed.estimates});
  }
  const OrderlyEnd orderly;
  Progress progress;
  const ProgressDisplay display(!arguments.quiet && !arguments.json, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  const ReleasesReport report = compare_releases(releases, options, watch);
  if (report.status() == RunStatus::interrupted || report.fit == FitOutcome::interrupted)
    return report_interruption(arguments.json);
  progress.reach(1);
  if (arguments.json)
    print(releases_json(report));
  else if (!arguments.quiet)
    print(releases_text(report, output_screen()));
  return status_of(report.status(), report.agrees());
}

/// Scenarios and measurements as the command line names them, in turns.
ListedReleases listed_in_turns(const CompareArguments& arguments) {
  std::vector<std::string> paths = {arguments.reference};
  paths.insert(paths.end(), arguments.others.begin(), arguments.others.end());
  if (paths.size() % 2 != 0)
    throw ScenarioError("", fmt::format("{} files; several releases are named by a scenario and a CSV file each, in turns: "
                                        "earthtop compare A.json a.csv B.json b.csv",
                                        paths.size()));
  ListedReleases list;
  for (std::size_t i = 0; i < paths.size(); i += 2) list.releases.push_back({paths[i], paths[i + 1], {}, {}});
  return list;
}

/// Fits a scenario's numbers to another program's file.
int engine_verb(const CompareArguments& arguments) {
  CompareArguments others = arguments;
  others.mapping.clear();
  require_options_of_a_measurement(others);
  if (!arguments.columns.empty() || !arguments.sigmas.empty() || arguments.time_offset_s != 0 || arguments.priors ||
      arguments.free_start || arguments.correlation_time_s || !arguments.shared.empty() || !arguments.fitted.empty() ||
      !arguments.svg.empty())
    throw ScenarioError("",
                        "a file with a --mapping is another program's, which states no standard errors: beside it there may be "
                        "--estimate, --set, --json and --quiet");
  const OrderlyEnd orderly;
  Progress progress;
  const ProgressDisplay display(!arguments.quiet && !arguments.json, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  const EngineFit fit = fit_to_engine(read_scenario_source(arguments.reference), split_sets(arguments.sets),
                                      arguments.candidate, arguments.mapping, arguments.estimates, watch);
  if (fit.interrupted) return report_interruption(arguments.json);
  progress.reach(1);
  if (arguments.json)
    print(engine_fit_json(fit));
  else if (!arguments.quiet)
    print(engine_fit_text(fit, output_screen()));
  return fit.reason.empty() ? kDone : kNegative;
}

int measurement_verb(const CompareArguments& arguments) {
  if (!arguments.mapping.empty()) return engine_verb(arguments);
  require_options_of_a_measurement(arguments);
  const auto [source, overrides] = given(arguments.reference, split_sets(arguments.sets), arguments.free_start);
  std::vector<std::string> inputs = files_of(arguments.reference, parse_scenario(source, overrides));
  inputs.push_back(arguments.candidate);
  OutputFiles files(
      {{OutputKind::scenario, arguments.fitted, "--write-scenario"}, {OutputKind::measurement_picture, arguments.svg, "--svg"}},
      inputs, arguments.force);
  require_place_for_scenario(source, overrides, arguments);
  const Measurement measurement = read_measurement(arguments.candidate, format_of(arguments));
  const MeasurementReport report = measure_watched(source, overrides, measurement, arguments);
  if (report.status == RunStatus::interrupted || report.fit == FitOutcome::interrupted)
    return report_interruption(arguments.json);
  if (!arguments.fitted.empty() && report.fitted)
    files.put(arguments.fitted, fitted_scenario(source, overrides, report, arguments.fitted));
  if (!arguments.svg.empty()) files.put(arguments.svg, svg(measurement_figure(report)));
  files.commit();
  if (arguments.json)
    print(measurement_json(report));
  else if (!arguments.quiet)
    print(measurement_text(report, output_screen()));
  if (!arguments.fitted.empty() && !report.fitted)
    message(fmt::format("{} is not written: there is no fit", printable(arguments.fitted)));
  else if (!arguments.fitted.empty() && !arguments.quiet && !arguments.json)
    print(fmt::format("\nWritten     {}\n", printable(arguments.fitted)));
  return status_of(report.status, report.agrees());
}

CompareReport compare_watched(const CompareArguments& arguments) {
  CompareOptions options = options_of(arguments);
  Progress progress;
  const ProgressDisplay display(!arguments.quiet && !arguments.json, progress);
  options.watch = Watch(nullptr, &progress).part(0, 1, "rows");
  CompareReport report = compare_results(arguments.reference, arguments.candidate, options);
  progress.reach(1);
  return report;
}

int compare_verb(CompareArguments& arguments) {
  const bool is_list = arguments.others.empty() && !arguments.update && has_a_key(arguments.reference, {"releases"});
  if (is_list) return releases_verb(arguments, read_releases(arguments.reference));
  if (arguments.others.empty()) throw UsageError("NEW is required", "earthtop compare");
  const bool measured = !arguments.update && is_scenario(arguments.reference);
  if (measured && arguments.others.size() > 1) return releases_verb(arguments, listed_in_turns(arguments));
  if (arguments.others.size() > 1)
    throw UsageError(fmt::format("{} is one too many: only releases are more than two files", printable(arguments.others[1])),
                     "earthtop compare");
  arguments.candidate = arguments.others.front();
  if (arguments.update) return update_verb(arguments);
  if (measured) return measurement_verb(arguments);
  if (!arguments.shared.empty())
    throw ScenarioError("", "--shared belongs to several releases, each a scenario and a CSV file");
  if (!arguments.estimates.empty() || !arguments.sets.empty())
    throw ScenarioError("", "--estimate and --set belong to a measurement, where REFERENCE is a scenario and NEW a CSV file");
  if (!arguments.fitted.empty() || arguments.correlation_time_s || arguments.priors || arguments.free_start ||
      !arguments.columns.empty() || !arguments.sigmas.empty() || arguments.time_offset_s != 0)
    throw ScenarioError("",
                        "--write-scenario, --correlation-time, --priors, --free-start, --columns, --sigma and --time-offset "
                        "belong to a measurement, where REFERENCE is a "
                        "scenario and NEW a CSV file");
  if (!arguments.reason.empty()) throw ScenarioError("", "--reason belongs to --update, which writes a new reference");
  OutputFiles files(
      {{OutputKind::verdicts, arguments.junit, "--junit"}, {OutputKind::comparison_picture, arguments.svg, "--svg"}},
      {arguments.reference, arguments.candidate, arguments.mapping, arguments.tolerances}, arguments.force);
  const CompareReport report = compare_watched(arguments);
  if (!arguments.junit.empty()) files.put(arguments.junit, comparison_junit(report));
  if (!arguments.svg.empty()) files.put(arguments.svg, svg(comparison_figure(report)));
  files.commit();
  if (!arguments.quiet) print_notes(report.unverified());
  if (arguments.json)
    print(comparison_json(report));
  else if (!arguments.quiet)
    print(compare_text(report, arguments.all, output_screen()));
  if (report.refused()) return kRefused;
  return report.passed() ? kDone : kNegative;
}

}  // namespace

Verb describe_compare() {
  auto arguments = std::make_shared<CompareArguments>();
  CompareArguments& a = *arguments;
  Verb compare("compare", "find what changed between two results, directories of results, studies or CSV files",
               [arguments] { return compare_verb(*arguments); });
  compare
      .add("REFERENCE", &a.reference,
           "results, a compact reference, a study's store, a CSV file, or a directory of several; or a scenario, for a "
           "measurement; or a release list (earthtop schema --releases)")
      .required();
  compare.add("NEW", &a.others,
              "what is compared with it; for a scenario, a CSV file with measured values and standard errors; further releases "
              "follow, each a scenario and a CSV file");
  compare
      .add("--estimate", &a.estimates,
           "for a measurement: fit this number of the scenario, e.g. omega_sin_latitude_rad_s or /release/spin_rad_s; may be "
           "repeated")
      .called("NAME")
      .with_commas();
  compare
      .add("--shared", &a.shared,
           "for several releases: fit this number, too, as one for all of them, e.g. gravity_m_s2; each release has its own "
           "value "
           "of the other estimates; may be repeated")
      .called("NAME")
      .with_commas();
  compare
      .add("--columns", &a.columns,
           "for a measurement: what a column of the file is, e.g. phi=azimuth_deg or phi=azimuth_deg:mathematical; may be "
           "repeated")
      .called("NAME=COLUMN")
      .with_commas();
  compare
      .add("--sigma", &a.sigmas,
           "for a measurement without a column of standard errors: that of each value of a quantity, e.g. azimuth_deg=0.2; may "
           "be "
           "repeated")
      .called("QUANTITY_UNIT=S")
      .with_commas();
  compare
      .add("--time-offset", &a.time_offset_s,
           "for a measurement: the time that its clock shows at the release (s); rows before it are left out")
      .called("T")
      .within(-1e9, 1e9);
  compare.add("--priors", &a.priors,
              "for a measurement: use what the scenario's uncertainty block says of the estimated numbers as prior knowledge");
  compare
      .add("--correlation-time", &a.correlation_time_s,
           "for a measurement: errors of a quantity are not independent, but correlated by exp(-dt/T); T in s")
      .called("T");
  compare.add(
      "--free-start", &a.free_start,
      "for a measurement that begins after the release: the motion starts at the first row, with estimated attitude and rates");
  compare.add("--write-scenario", &a.fitted, "for a measurement: write the scenario with the estimates in it").called("FILE");
  compare.add("--force", &a.force, "also overwrite files that earthtop did not write, or that have been changed since");
  add_set_option(compare, a.sets);
  compare
      .add("--profile", &a.profile,
           "what may differ: regression (default): as much as both error bounds and rounding explain; bitwise: nothing; "
           "physics: a thousandth of the Earth's effect")
      .called("NAME")
      .one_of({"bitwise", "regression", "physics"});
  compare.add("--tolerances", &a.tolerances, "a file with tolerances of single quantities (earthtop schema --tolerances)")
      .called("FILE");
  compare
      .add("--mapping", &a.mapping,
           "a file that says what another program's CSV columns are (earthtop schema --mapping); with a scenario, --estimate "
           "fits "
           "its numbers to that file")
      .called("FILE");
  compare.add("--allow-change", &a.may_change, "a scenario key in which the two may differ, e.g. /numerics; / for all")
      .called("POINTER");
  compare.add("--allow-missing", &a.may_lack_rows,
              "do not count rows, points and results that only the reference has as differences");
  compare.add("--until", &a.until_s, "for a CSV file: compare rows up to this time (s); the file may end there").called("T");
  compare.add("--max-steps-ratio", &a.steps_ratio, "fail if the steps or evaluations grow by more than this factor")
      .called("R")
      .within(1e-9, 1e9);
  compare.add("--max-seconds-ratio", &a.seconds_ratio, "fail if the wall time grows by more than this factor")
      .called("R")
      .within(1e-9, 1e9);
  compare.add("--junit", &a.junit, "write the verdicts as JUnit XML").called("FILE");
  compare.add("--svg", &a.svg, "write a picture: of the differences over time, or of a measurement and the model")
      .called("FILE");
  compare.add("--update", &a.update, "make NEW the reference; needs --reason")
      .without("--junit")
      .without("--svg")
      .without("--tolerances")
      .without("--profile")
      .without("--mapping");
  compare.add("--reason", &a.reason, "for --update: the reason, which the reference keeps").called("TEXT");
  compare.add("--all", &a.all, "also list what is the same: quantities and, among many results, those without a difference");
  compare.add("--json", &a.json, "print the verdicts, or the errors, as one JSON document");
  compare.add("--quiet", &a.quiet, "print nothing but errors (and what --json asks for)");
  compare.describe(
      "Says for each quantity whether it changed by more than both error bounds and rounding explain, or by more than another "
      "profile or a file of tolerances allows. If REFERENCE is a scenario, NEW is a measurement: a CSV file with values and "
      "standard errors. The answer is then whether the two agree and, with --estimate, the fitted numbers.");
  compare.example("earthtop compare old/toy-top new/toy-top", "compares two results");
  compare.example("earthtop compare references results --junit verdicts.xml",
                  "compares two directories and writes the verdicts for a build server");
  compare.example(
      "earthtop compare gyro.json measured.csv --estimate omega_sin_latitude_rad_s,spin_rad_s --write-scenario fitted.json",
      "fits the vertical part of the Earth's rotation and the spin to a measurement, and writes a scenario with them");
  compare.example(
      "earthtop compare one-way.json one.csv other-way.json other.csv --estimate spin_rad_s "
      "--shared omega_sin_latitude_rad_s,gravity_m_s2",
      "fits two releases at once: each has its own spin, both have the same gravity and the same Earth");
  compare.ends_with(kDone, "nothing differs; or measurement and scenario agree; or the new reference is written");
  compare.ends_with(kNegative, "something differs; or the measurement and the scenario do not agree, or there is no fit");
  compare.ends_with(kRefused,
                    "the command line or an input was refused, e.g. because it is empty or incomplete; nothing was written");
  compare.ends_with(kNumericalFailure,
                    "the motion of the scenario could not be computed to the last measured row; or memory ran out");
  compare.ends_with(kWriteFailed, "writing failed, or reading an input broke off");
  return compare;
}

}  // namespace earthtop::tool
