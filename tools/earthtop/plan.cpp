// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/plan/plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>

#include "command_line.hpp"
#include "earthtop/measure/releases_file.hpp"
#include "earthtop/results/output_files.hpp"
#include "earthtop/run.hpp"
#include "input/file.hpp"
#include "interrupt.hpp"
#include "json_object.hpp"
#include "output.hpp"
#include "places.hpp"
#include "plan_text.hpp"
#include "progress_line.hpp"
#include "scenario_operand.hpp"
#include "screen.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct PlanArguments {
  std::string scenario;
  std::vector<std::string> others;  // scenarios of further releases
  std::vector<std::string> quantities, sigmas, estimates, nuisances, shared, design, sets;
  double every_s = 0, correlation_time_s = 0;
  double until_s = 0;  // 0: not given
  std::string svg, data;
  unsigned seed = 1;
  bool force = false, json = false, quiet = false;
};

MeasurementPlan plan_of(const PlanArguments& arguments) {
  if (arguments.quantities.size() != arguments.sigmas.size())
    throw ScenarioError("--sigma", fmt::format("{} for {} quantities; give each --measure its own, in the same order, e.g. "
                                               "--measure azimuth_deg --sigma 0.01",
                                               arguments.sigmas.size(), arguments.quantities.size()));
  MeasurementPlan plan;
  for (std::size_t i = 0; i < arguments.quantities.size(); ++i) {
    const std::string& text = arguments.sigmas[i];
    double sigma = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, sigma);
    if (error != std::errc() || last != end)
      throw ScenarioError("--sigma " + printable(text),
                          "is not a number; give a standard error in the quantity's unit, e.g. 0.01");
    plan.quantities.push_back(planned_quantity(arguments.quantities[i], sigma));
  }
  plan.every_s = arguments.every_s;
  if (arguments.until_s > 0) plan.until_s = arguments.until_s;
  plan.correlation_time_s = arguments.correlation_time_s;
  plan.estimates = arguments.estimates;
  plan.nuisances = arguments.nuisances;
  plan.shared = arguments.shared;
  return plan;
}

int status_of(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::determined: return kDone;
    case PlanOutcome::not_determined: return kNegative;
    default: return kNumericalFailure;
  }
}

void print_report(const PlanReport& report, const PlanArguments& arguments) {
  if (arguments.json)
    print(plan_json(report));
  else if (!arguments.quiet)
    print(plan_text(report, output_screen()));
}

/// The releases that are listed in a file, or named one after the other; empty for one scenario.
ListedReleases releases_of(const PlanArguments& arguments) {
  ListedReleases list;
  if (arguments.others.empty()) {
    if (!arguments.scenario.ends_with(".json") || input::type_of(arguments.scenario) != input::PathType::file) return list;
    const std::vector<std::string> keys = json_keys(read_scenario_source(arguments.scenario).text);
    return std::ranges::find(keys, "releases") == keys.end() ? list : read_releases(arguments.scenario);
  }
  list.releases.push_back({arguments.scenario, {}, {}, {}});
  for (const std::string& other : arguments.others) list.releases.push_back({other, {}, {}, {}});
  return list;
}

int releases_verb(const PlanArguments& arguments, const ListedReleases& list) {
  if (!arguments.design.empty() || !arguments.data.empty())
    throw ScenarioError("", "--optimise and --write-data are for one release; plan each by itself for them");
  MeasurementPlan plan = plan_of(arguments);
  plan.estimates.insert(plan.estimates.end(), list.estimates.begin(), list.estimates.end());
  plan.shared.insert(plan.shared.end(), list.shared.begin(), list.shared.end());
  std::vector<PlannedRelease> releases;
  std::vector<std::string> inputs;
  for (const ListedRelease& listed : list.releases) {
    if (!listed.estimates.empty())
      throw ScenarioError("/releases", "\"estimate\" of single releases is not used by plan; name numbers for all releases");
    PlannedRelease& release =
        releases.emplace_back(PlannedRelease{read_scenario_source(listed.scenario), split_sets(arguments.sets)});
    for (auto& change : split_sets(listed.sets)) release.overrides.push_back(std::move(change));
    for (std::string& file : files_of(listed.scenario, parse_scenario(release.source, release.overrides)))
      inputs.push_back(std::move(file));
  }
  OutputFiles files({{OutputKind::plan_picture, arguments.svg, "--svg"}}, inputs, arguments.force);
  const OrderlyEnd orderly;
  Progress progress;
  const ProgressDisplay display(!arguments.quiet && !arguments.json, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  const PlanReport report = plan_releases(releases, plan, watch);
  if (report.outcome == PlanOutcome::interrupted || report.status == RunStatus::interrupted)
    return report_interruption(arguments.json);
  progress.reach(1);
  if (!arguments.svg.empty()) files.put(arguments.svg, svg(plan_figure(report)));
  files.commit();
  print_report(report, arguments);
  return status_of(report.outcome);
}

int plan_verb(const PlanArguments& arguments) {
  if (const ListedReleases list = releases_of(arguments); !list.releases.empty()) return releases_verb(arguments, list);
  const MeasurementPlan plan = plan_of(arguments);
  std::vector<DesignInput> design;
  for (const std::string& text : arguments.design) design.push_back(design_input(text));
  const ScenarioSource source = scenario_of(arguments.scenario);
  const auto overrides = split_sets(arguments.sets);
  OutputFiles files(
      {{OutputKind::plan_picture, arguments.svg, "--svg"}, {OutputKind::simulated_data, arguments.data, "--write-data"}},
      files_of(arguments.scenario, parse_scenario(source, overrides)), arguments.force);

  const OrderlyEnd orderly;
  Progress progress;
  const ProgressDisplay display(!arguments.quiet && !arguments.json, progress);
  const Watch watch(stop_flag(), display.is_shown() ? &progress : nullptr);
  const PlanReport report = plan_measurement(source, overrides, plan, design, watch);
  std::optional<std::string> data;
  const bool was_interrupted = report.outcome == PlanOutcome::interrupted || report.status == RunStatus::interrupted;
  const bool has_data = !arguments.data.empty() && report.status == RunStatus::completed;
  if (!was_interrupted && has_data)
    data = simulated_measurement(source, overrides, plan, arguments.seed, watch.with_progress(nullptr));
  if (was_interrupted || (has_data && !data)) return report_interruption(arguments.json);
  progress.reach(1);
  if (data) files.put(arguments.data, *data);
  if (!arguments.svg.empty()) files.put(arguments.svg, svg(plan_figure(report)));
  files.commit();
  print_report(report, arguments);
  if (!arguments.data.empty() && !has_data)
    message(fmt::format("{} is not written: {}", printable(arguments.data), report.reason));
  return status_of(report.outcome);
}

}  // namespace

Verb describe_plan() {
  auto arguments = std::make_shared<PlanArguments>();
  PlanArguments& a = *arguments;
  Verb plan("plan", "predict the standard errors of a measurement before anything is built",
            [arguments] { return plan_verb(*arguments); });
  plan.add("SCENARIO", &a.scenario,
           "scenario file (JSON) of the planned top, or the name of a scenario that comes with the program; - is standard "
           "input; or a "
           "release list (earthtop schema --releases)")
      .json_file()
      .required();
  plan.add("MORE", &a.others, "scenarios of further releases, which are measured alike and evaluated by one fit").json_file();
  plan.add("--measure", &a.quantities,
           "what is measured: a quantity of a measurement with its unit, as azimuth_deg, spin_rpm, w_IB_B_x_rad_s, "
           "azimuth_turning_deg or precession_period_s; may be repeated")
      .called("QUANTITY_UNIT")
      .required();
  plan.add("--sigma", &a.sigmas, "standard error of each value, in the quantity's unit; one for each --measure")
      .called("S")
      .required();
  plan.add("--every", &a.every_s, "time between rows (s)").called("T").within(1e-9, 1e9).required();
  plan.add("--until", &a.until_s, "time of the last row (s); default: the scenario's duration").called("U").within(1e-9, 1e9);
  plan.add("--correlation-time", &a.correlation_time_s,
           "errors of a quantity are correlated by exp(-dt/TAU), TAU in s; default 0: they are independent")
      .called("TAU")
      .within(0, 1e9);
  plan.add("--estimate", &a.estimates,
           "a number of the scenario to be estimated; default: omega_sin_latitude_rad_s, for a gyrocompass "
           "omega_cos_latitude_rad_s; may be repeated")
      .called("NAME")
      .with_commas();
  plan.add("--nuisance", &a.nuisances,
           "another unknown number, which would be fitted as well, e.g. spin_rad_s; may be repeated")
      .called("NAME")
      .with_commas();
  plan.add("--shared", &a.shared,
           "for several releases: this number is one for all of them, e.g. gravity_m_s2; it is estimated unless --nuisance "
           "names "
           "it, too; may be repeated")
      .called("NAME")
      .with_commas();
  plan.add("--optimise", &a.design,
           "choose this number within these limits so that the standard error of the first estimate is smallest; may be "
           "repeated")
      .called("KEY=LOW:HIGH");
  plan.add("--svg", &a.svg, "write a picture of the standard error against duration, rows and accuracy").called("FILE");
  plan.add("--write-data", &a.data, "write a simulated measurement: the scenario's motion with normally distributed errors")
      .called("FILE.csv");
  plan.add("--seed", &a.seed, "for --write-data: another seed gives other errors; default 1").called("N");
  plan.add("--force", &a.force, "also overwrite files that earthtop did not write, or that have been changed since");
  add_set_option(plan, a.sets);
  plan.add("--json", &a.json, "print the plan, or the errors, as one JSON document");
  plan.add("--quiet", &a.quiet, "print nothing but errors (and what --json asks for)");
  plan.describe(
      "Computes how well a planned measurement would determine numbers of the scenario: the Cramer-Rao bound, from the "
      "derivatives that compare --estimate uses. The scenario's uncertainty block says what is known beforehand. If the "
      "measurement would not determine the numbers, plan says which, or which combination of them, and what would help.");
  plan.example("earthtop plan gyro.json --measure azimuth_deg --sigma 0.01 --every 0.1 --until 60 --nuisance spin_rad_s",
               "predicts how well the Earth's rotation would be seen if the spin is unknown");
  plan.example(
      "earthtop plan gyro.json --measure tilt_deg --sigma 0.01 --every 0.1 --optimise /release/tilt_deg=5:60 "
      "--optimise /release/spin_rad_s=50:400",
      "finds the best tilt and spin");
  plan.example("earthtop plan gyro.json --measure azimuth_deg --sigma 0.01 --every 0.1 --write-data simulated.csv --seed 7",
               "writes simulated data, with which to try earthtop compare");
  plan.example(
      "earthtop plan one-way.json other-way.json --measure azimuth_deg --sigma 0.01 --every 0.1 --nuisance spin_rad_s "
      "--nuisance gravity_m_s2 --shared omega_sin_latitude_rad_s,gravity_m_s2",
      "predicts what a top tells that is spun both ways");
  plan.ends_with(kDone, "the measurement would determine the numbers");
  plan.ends_with(kNegative, "the measurement would not determine the numbers");
  plan.ends_with(kRefused, "the command line or the scenario was refused; nothing was written");
  plan.ends_with(kNumericalFailure, "the motion could not be computed; or memory ran out");
  plan.ends_with(kWriteFailed, "writing failed, or reading the scenario broke off");
  return plan;
}

}  // namespace earthtop::tool
