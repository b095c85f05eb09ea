// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/sensitivities.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/real.hpp"
#include "run/difference_sensitivities.hpp"
#include "scene/input_derivatives.hpp"
#include "scene/sensitivity_route.hpp"

namespace earthtop {
namespace {

/// The share of the distance between two integrations, the coarser of which has some hundred times the errors, that bounds the
/// errors of the finer.
constexpr double kShareOfDistance = 0.1;
/// Rounding of a derivative that rests on a sum of larger terms, as a share of the derivative by the input's scale, in units of
/// the drift.
constexpr double kDerivativeRounding = 1e-12;

/// Integrates the variational equations twice, and fills the report. @returns how they ended
RunStatus by_variations(const Scene& scene, const Watch& watch, SensitivityReport& report) {
  const InputDerivatives inputs = input_derivatives(scene);
  const auto integrated = [&](double tolerance, const Watch& part) {
    return drift_sensitivity(scene.problem_without_rows<double>(), inputs.by_scaled_input, report.at_s, tolerance, part);
  };
  const DriftSensitivity drift = integrated(kSensitivityTolerance, watch.part(0, 0.64));
  DriftSensitivity coarse;
  if (drift.status == RunStatus::completed) coarse = integrated(kCoarseSensitivityTolerance, watch.part(0.64, 1));
  const RunStatus status = drift.status == RunStatus::completed ? coarse.status : drift.status;
  if (status != RunStatus::completed) return status;
  for (std::size_t i = 0; i < inputs.inputs.size(); ++i) {
    const double scale = inputs.scales[i];
    const auto by_input = [&](const Differentiated& quantity) { return quantity.derivatives[i] / scale; };
    InputSensitivity entry;
    entry.name = kInputNames[inputs.inputs[i]], entry.value = inputs.values[i];
    entry.axis_rad = by_input(drift.axis), entry.attitude_rad = by_input(drift.attitude), entry.tilt_rad = by_input(drift.tilt);
    if (drift.azimuth) entry.azimuth_rad = by_input(*drift.azimuth);
    entry.axis_bound_rad = kShareOfDistance * std::abs(entry.axis_rad - by_input(coarse.axis)) +
                           kDerivativeRounding * (std::abs(entry.axis_rad) + drift.axis.value / scale);
    report.inputs.push_back(entry);
  }
  return status;
}

}  // namespace

std::optional<SensitivityReport> assess_sensitivities(const RunResult& result, const Watch& watch) {
  const Scene& scene = result.modelled;
  const Scenario& scenario = scene.scenario();
  if (!scenario.sensitivities) return std::nullopt;
  SensitivityReport report;
  const DriftRow* row = last_reliable_row(result);
  report.at_s = row != nullptr ? row->t_s : 0;
  const SensitivityPlan plan = plan_sensitivities(scene, report.at_s);
  if (!plan.refusal.empty()) {
    report.unavailable = plan.refusal;
    return report;
  }
  const bool varied = plan.route == SensitivityRoute::variations;
  const RunStatus status = varied ? by_variations(scene, watch, report) : RunStatus::step_underflow;
  if (status == RunStatus::step_limit || status == RunStatus::interrupted) {
    report.unavailable = fmt::format("their integration ended with {}", to_string(status));
  } else if (status != RunStatus::completed) {  // differences pass the corners that variations do not
    // There are none where the watch asks to stop, which ends the whole run.
    if (auto entries = difference_sensitivities(
            scene, report.at_s,
            {row->rotor ? row->rotor->drift_axis_bound_rad : row->drift_axis_bound_rad, row->drift_attitude_bound_rad}, watch))
      report.inputs = std::move(*entries);
  }
  if (!scenario.uncertainty) return report;
  for (InputSensitivity& input : report.inputs) {
    const auto place = std::ranges::find(kInputNames, input.name) - kInputNames.begin();
    const double error = (*scenario.uncertainty)[static_cast<std::size_t>(place)];
    if (input.unavailable.empty()) input.axis_error_rad = std::abs(input.axis_rad) * error;
    report.axis_error_rad = real::hypot(report.axis_error_rad, input.axis_error_rad);
    if (!input.unavailable.empty() && error > 0) report.without_derivative = input.name;
  }
  return report;
}

}  // namespace earthtop
