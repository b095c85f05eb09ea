// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/sensitivities.hpp"

#include <fmt/core.h>

#include <cmath>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/real.hpp"
#include "scene/input_derivatives.hpp"

namespace earthtop {
std::optional<SensitivityReport> assess_sensitivities(const RunResult& result, const Watch& watch) {
  const Scene& scene = result.modelled;
  const Scenario& scenario = scene.scenario();
  if (!scenario.sensitivities) return std::nullopt;
  SensitivityReport report;
  const DriftRow* row = last_reliable_row(result);
  report.at_s = row != nullptr ? row->t_s : 0;
  if (const auto reason = sensitivity_refusal(scene, report.at_s)) {
    report.unavailable = *reason;
    return report;
  }
  const InputDerivatives inputs = input_derivatives(scene);
  const DriftSensitivity drift =
      drift_sensitivity(scene.problem<double>(), inputs.by_scaled_input, report.at_s, kSensitivityTolerance, watch);
  if (drift.status != RunStatus::completed) {
    report.unavailable = fmt::format("their integration ended with {}", to_string(drift.status));
    return report;
  }
  for (std::size_t i = 0; i < kInputNames.size(); ++i) {
    const auto by_input = [&](const Differentiated& quantity) { return quantity.derivatives[i] / inputs.scales[i]; };
    InputSensitivity input{kInputNames[i],
                           inputs.values[i],
                           by_input(drift.axis),
                           by_input(drift.attitude),
                           by_input(drift.tilt),
                           std::nullopt,
                           0};
    if (drift.azimuth) input.azimuth_rad = by_input(*drift.azimuth);
    if (scenario.uncertainty) input.axis_error_rad = std::abs(input.axis_rad) * (*scenario.uncertainty)[i];
    report.axis_error_rad = real::hypot(report.axis_error_rad, input.axis_error_rad);
    report.inputs.push_back(input);
  }
  return report;
}

}  // namespace earthtop
