// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/collect.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "earthtop/results/provenance.hpp"
#include "results/summary_section.hpp"
#include "scene/examine.hpp"
#include "study/json_text.hpp"

namespace earthtop::study {
namespace {

/// The value that a dotted path leads to; null if this run has no such member. The reader of the study file has already checked
/// that some run may have it.
Json follow(const Json& root, const std::vector<std::string>& steps) {
  const Json* at = &root;
  for (const std::string& step : steps) {
    if (at->is_array()) {
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
      if (error != std::errc() || end != step.data() + step.size() || index >= at->size()) return Json();
      at = &(*at)[index];
    } else {
      const auto member = at->is_object() ? at->find(step) : at->end();
      if (!at->is_object() || member == at->end()) return Json();
      at = &*member;
    }
  }
  return *at;
}

}  // namespace

std::string first_message(const ScenarioReport& report) {
  if (report.errors.empty()) return "refused";
  const Diagnostic& first = report.errors.front();
  std::string text = printable(fmt::format("{}: {}", first.pointer, first.message));
  if (report.error_count > 1) text += fmt::format(" (and {} more)", report.error_count - 1);
  return text;
}

bool is_known_at_the_end(std::string_view path) {
  constexpr std::array<std::string_view, 17> kPaths = {"name",
                                                       "title",
                                                       "outcome.status",
                                                       "outcome.reached_s",
                                                       "drift.axis_final_rad",
                                                       "drift.axis_bound_rad",
                                                       "drift.attitude_final_rad",
                                                       "drift.attitude_bound_rad",
                                                       "drift.spin_final_rad",
                                                       "drift.azimuth_final_rad",
                                                       "drift.tilt_final_rad",
                                                       "drift.axis_final_over_earth_angle",
                                                       "drift.verdict",
                                                       "drift.threshold_time_s",
                                                       "drift.threshold_time_bound_s",
                                                       "drift.threshold_crossing",
                                                       "attitude_bound_rad"};
  if (std::find(kPaths.begin(), kPaths.end(), path) != kPaths.end()) return true;
  for (const std::string_view front :
       {"matching_rule.", "motion.axis_final_L.", "motion.reference_axis_final_L.", "growth_of_disturbances.", "effects.",
        "selection.", "accuracy.", "scenario.", "provenance.", "sensitivities.", "uncertainty."})
    if (path.starts_with(front)) return true;
  return false;
}

Collector::Collector(const Study& study) : study_(study), base_(study.base, study.set) {
  paths_.reserve(study.quantities.size());
  for (const StudyQuantity& quantity : study.quantities) {
    std::vector<std::string> steps(1);
    for (const char c : quantity.path) {
      if (c == '.')
        steps.emplace_back();
      else
        steps.back() += c;
    }
    Path path{steps.front(), {}};
    path.steps.assign(steps.begin() + 1, steps.end());
    paths_.push_back(std::move(path));
  }
  sensitivities_ = !study.needed_rows_only || std::any_of(paths_.begin(), paths_.end(), [](const Path& path) {
    return path.section == "sensitivities" || path.section == "uncertainty" || path.section == "scenario";
  });
  ends_only_ = study.needed_rows_only && std::all_of(study.quantities.begin(), study.quantities.end(),
                                                     [](const auto& quantity) { return is_known_at_the_end(quantity.path); });
}

ScenarioReport Collector::examine(const std::vector<input::TreeChange>& changes) const {
  ScenarioReport report = earthtop::examine(base_, changes);
  if (!report.scenario) return report;
  Scenario& scenario = *report.scenario;
  scenario.numerics.stops_beyond_estimate = study_.limits.stops_beyond_estimate;
  if (ends_only_) scenario.output_step_s = scenario.duration_s;
  if (!sensitivities_) {
    scenario.sensitivities = false;
    scenario.uncertainty.reset();
  }
  if (!(scenario == report.scene->scenario())) report.scene = resolve(scenario);
  return report;
}

std::optional<Scene> Collector::scene(const std::vector<input::TreeChange>& changes, std::string& refusal) const {
  ScenarioReport report = examine(changes);
  if (!report.scene) refusal = first_message(report);
  return std::move(report.scene);
}

void Collector::collect(const BatchOutcome& outcome, PointResult& point) const {
  point.values.assign(paths_.size(), {});
  if (!outcome.result) {
    point.status = "refused";
    point.reason = outcome.refusal;
    return;
  }
  const RunResult& result = *outcome.result;
  point.status = to_string(result.status);
  if (result.status != RunStatus::completed)
    point.reason = fmt::format("{} at t = {} s of {} s", point.status, result.reached_s, result.scene.scenario().duration_s);
  if (point.status == "completed" && result.accuracy && !result.accuracy->reached()) {
    point.status = "accuracy_not_reached";
    point.reason = fmt::format("the drift error asked for, {} rad, was not reached: it is {:.2g} rad",
                               result.accuracy->asked_rad, result.accuracy->reached_rad);
  }
  point.scenario_sha256 = result.scene.sha256();
  std::string made;
  std::optional<Json> section;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (i == 0 || made != paths_[i].section) section = summary_section(result, made = paths_[i].section);
    if (section) point.values[i] = value_of(follow(*section, paths_[i].steps));
  }
}

}  // namespace earthtop::study
