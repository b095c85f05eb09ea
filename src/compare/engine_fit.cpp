// SPDX-License-Identifier: GPL-3.0-or-later
// Fits a scenario's numbers to another program's file, as to a measurement whose errors are all alike.
#include <cmath>

#include "compare/mapping.hpp"
#include "compare/row_source.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"
#include "earthtop/measure/measurement.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {
namespace compare {
namespace {

constexpr double kWeight_rad = 1e-6;  // the standard error that each angle is given; only ratios of weights matter

Measurement read_engine(const std::string& csv, const Mapping& mapping, double fastest_rate) {
  using enum MeasuredQuantity;
  const auto rows = open_mapped_csv(csv, mapping);
  const std::size_t first_axis = *trajectory_table().find("axis_L_x"), first_rate = *trajectory_table().find("w_LB_B_x_rad_s");
  Measurement measurement;
  measurement.file = csv;
  Row row;
  while (rows->next(row)) {
    ++measurement.rows;
    if (!std::isfinite(row.t_s) || row.t_s < 0) continue;
    const auto has = [&](std::size_t first) {
      return row.kind[first] == CellKind::number && row.kind[first + 1] == CellKind::number &&
             row.kind[first + 2] == CellKind::number;
    };
    if (rows->has_column(first_axis) && has(first_axis)) {
      const double* n = row.value.data() + first_axis;
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      if (!(length > 0)) continue;
      MeasuredValue& value = measurement.values.emplace_back();
      value.quantity = MeasuredQuantity::axis, value.t_s = row.t_s, value.standard_error = kWeight_rad;
      value.axis_L = {n[0] / length, n[1] / length, n[2] / length}, value.line = measurement.rows;
    }
    if (rows->has_column(first_rate) && has(first_rate))
      for (const auto& [quantity, i] : {std::pair(w_LB_B_x, 0U), {w_LB_B_y, 1U}, {w_LB_B_z, 2U}}) {
        MeasuredValue& value = measurement.values.emplace_back();
        value.quantity = quantity, value.t_s = row.t_s, value.value = row.value[first_rate + i];
        value.standard_error = kWeight_rad * fastest_rate, value.line = measurement.rows;
      }
  }
  if (measurement.values.empty()) throw ScenarioError("", printable(csv) + " has no row to which anything could be fitted");
  return measurement;
}

}  // namespace
}  // namespace compare

EngineFit fit_to_engine(const ScenarioSource& source, const Overrides& overrides, const std::string& csv,
                        const std::string& mapping, const std::vector<std::string>& estimates, const Watch& watch) {
  using namespace compare;
  const Scene scene = parse_scene(source, overrides);
  const Measurement measurement = read_engine(csv, read_mapping(mapping), scene.fastest_rate_rad_s());
  MeasurementOptions options;
  options.estimates = estimates;
  const MeasurementReport report = compare_with_measurement(source, overrides, measurement, options, watch);
  EngineFit fit;
  fit.scenario = report.scenario_name, fit.file = csv, fit.rows = measurement.rows, fit.reason = report.fit_reason;
  fit.interrupted = report.status == RunStatus::interrupted || report.fit == FitOutcome::interrupted;
  if (report.status != RunStatus::completed && fit.reason.empty())
    fit.reason = "the motion of the scenario ends before the last row";
  const auto rms = [&](const ChiSquared& chi) {
    return kWeight_rad * std::sqrt(chi.value / static_cast<double>(std::max<std::size_t>(report.residuals.size(), 1)));
  };
  fit.given_rms_rad = rms(report.as_given);
  if (report.fitted) fit.fitted_rms_rad = rms(*report.fitted);
  for (const ParameterEstimate& estimate : report.estimates)
    fit.numbers.push_back({estimate.name, estimate.unit, estimate.start, estimate.estimate});
  return fit;
}

}  // namespace earthtop
