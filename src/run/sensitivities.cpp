// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/sensitivities.hpp"

#include <fmt/core.h>

#include <cmath>

#include "earthtop/real.hpp"
#include "scenario/input_derivatives.hpp"
#include "scenario/pace.hpp"
#include "scenario/problem.hpp"

namespace earthtop {
namespace {

constexpr double kTolerance = 1e-11;      // of the derivatives' integration
constexpr double kAffordablePhase = 2e6;  // rad; minutes: a toy top's minute, 1.5e4 rad, takes two seconds

std::optional<std::string> no_sensitivities(const Scenario& scenario, double time_s) {
  if (scenario.effects.applied.coulomb_N_m != 0) return "dry friction has no derivative where a motion comes to rest";
  if (scenario.rotation_rate_rad_s == 0) return "the Earth does not turn: there is no drift";
  if (time_s == 0) return "no row of the drift is reliable";
  const double phase = std::max(fastest_rate_rad_s(scenario), pace_of(scenario).damping / scenario.duration_s) * time_s;
  if (phase > kAffordablePhase)
    return fmt::format("{:.1e} rad of the fastest rate would take minutes; at most {:.0e} are done", phase, kAffordablePhase);
  return std::nullopt;
}

}  // namespace

std::optional<double> sensitivity_tolerance(const Scenario& scenario) {
  if (!scenario.sensitivities || no_sensitivities(scenario, scenario.duration_s)) return std::nullopt;
  return kTolerance;
}

std::optional<SensitivityReport> assess_sensitivities(const RunResult& result, const Watch& watch) {
  const Scenario& scenario = result.scenario;
  if (!scenario.sensitivities) return std::nullopt;
  SensitivityReport report;
  const DriftRow* row = last_reliable_row(result);
  report.at_s = row != nullptr ? row->t_s : 0;
  if (const auto reason = no_sensitivities(scenario, report.at_s)) {
    report.unavailable = *reason;
    return report;
  }
  const auto problem = make_problem<double>(scenario);
  const InputDerivatives inputs = input_derivatives(scenario, problem.units);
  const DriftSensitivity drift = drift_sensitivity(problem, inputs.by_scaled_input, report.at_s, kTolerance, watch);
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
