// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/collect.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "earthtop/results/provenance.hpp"
#include "results/figures.hpp"
#include "scene/examine.hpp"
#include "study/json_text.hpp"
#include "text/number_words.hpp"

namespace earthtop::study {
std::string first_message(const ScenarioReport& report) {
  if (report.errors.empty()) return "refused";
  const Diagnostic& first = report.errors.front();
  std::string text = printable(fmt::format("{}: {}", first.pointer, first.message));
  if (report.error_count > 1) text += fmt::format(" (and {} more)", report.error_count - 1);
  return text;
}

Collector::Collector(const Study& study) : study_(study), base_(study.base, study.set) {
  sensitivities_ =
      !study.needed_rows_only || std::any_of(study.quantities.begin(), study.quantities.end(), [](const auto& quantity) {
        const std::string section = quantity.path.substr(0, quantity.path.find('.'));
        return section == "sensitivities" || section == "uncertainty" || section == "scenario";
      });
  between_ = std::any_of(study.quantities.begin(), study.quantities.end(), [](const auto& quantity) {
    const SummaryMember* const member = find_member(quantity.path);
    return member != nullptr && member->scope == FigureScope::motion;
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
  point.values.assign(study_.quantities.size(), {});
  if (!outcome.result) {
    point.status = "refused";
    point.reason = outcome.refusal;
    return;
  }
  const RunResult& result = *outcome.result;
  point.status = to_string(result.status);
  if (result.status != RunStatus::completed)
    point.reason = fmt::format("{} at t = {} of {}", point.status, time_text(result.reached_s),
                               time_text(result.scene.scenario().duration_s));
  if (point.status == "completed" && result.accuracy && !result.accuracy->reached()) {
    point.status = "accuracy_not_reached";
    point.reason =
        fmt::format("the drift error asked for, {} rad, was not reached: its bound is {} rad", result.accuracy->asked_rad,
                    told_apart(result.accuracy->reached_rad, result.accuracy->asked_rad, 2).first);
  }
  point.scenario_sha256 = result.scene.sha256();
  for (std::size_t i = 0; i < study_.quantities.size(); ++i)
    point.values[i] = value_of(summary_part(result, study_.quantities[i].path));
}

}  // namespace earthtop::study
