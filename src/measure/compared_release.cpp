// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/compared_release.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "measure/measured_motion.hpp"

namespace earthtop::measure {
namespace {

/// The scenario's overrides, and those that extend it to the last measured time, if that is later than its end. The data that the
/// scenario reads for its duration (a table of a platform's motion) are then checked up to that time.
Overrides with_duration(const MeasuredRelease& given, const Scenario& scenario) {
  Overrides overrides = given.overrides;
  const double last_s = last_time_s(given.measurement);
  if (last_s <= scenario.duration_s) return overrides;
  overrides.emplace_back("/motion/duration_s", fmt::format("{}", last_s));
  overrides.emplace_back("/motion/output_step_s", fmt::format("{}", last_s));
  return overrides;
}

Scene scene_as_given(const MeasuredRelease& given) {
  if (given.measurement.values.empty()) throw ScenarioError("", "no measured value");
  Scene scene = parse_scene(given.source, given.overrides);
  if (scene.scenario().effects.automatic)
    throw ScenarioError("/effects", "the choice of effects is left to the program; to compare with a measurement, name them");
  return scene;
}

/// Each name once: those of all releases, then those of each, then those of this one.
std::vector<std::string> names_of(const MeasuredRelease& given, const MeasurementOptions& options) {
  std::vector<std::string> names = options.shared;
  const auto add = [&](const std::vector<std::string>& more) {
    const std::vector<std::string> before = names;
    for (const std::string& name : more)
      if (std::ranges::find(before, name) == before.end()) names.push_back(name);
  };
  add(options.estimates);
  add(given.estimates);
  return names;
}

}  // namespace

ComparedRelease::ComparedRelease(const MeasuredRelease& given, const MeasurementOptions& options)
    : ComparedRelease(given, scene_as_given(given), options) {}

ComparedRelease::ComparedRelease(const MeasuredRelease& given, const Scene& as_given, const MeasurementOptions& options)
    : given_(&given),
      name_(as_given.scenario().name),
      sha256_(as_given.sha256()),
      overrides_(with_duration(given, as_given.scenario())),
      scene_(parse_scene(given.source, overrides_)),
      names_(names_of(given, options)),
      inputs_(given.source, overrides_, scene_, names_) {}

EstimatedInputs ComparedRelease::inputs_of(const std::vector<std::string>& names, std::size_t most) const {
  return {given_->source, overrides_, scene_, names, most};
}

MeasurementReport ComparedRelease::begun_report() const {
  MeasurementReport report;
  report.scenario_name = name_;
  report.scenario_sha256 = sha256_;
  report.file = measurement().file;
  report.rows = measurement().rows;
  report.notes = measurement().notes;
  std::map<MeasuredQuantity, std::uint64_t> counts;
  for (const MeasuredValue& value : measurement().values) ++counts[value.quantity];
  report.quantities.assign(counts.begin(), counts.end());
  return report;
}

}  // namespace earthtop::measure
