// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planned_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/node.hpp"
#include "input/suggest.hpp"
#include "measure/columns.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace plan {
namespace {

[[noreturn]] void refuse_quantity(const std::string& name) {
  std::vector<std::string> names;
  for (const MeasuredQuantity quantity : measure::kAllMeasured)
    for (const measure::MeasuredUnit& unit : measure::units_of(quantity))
      names.push_back(fmt::format("{}_{}", to_string(quantity), unit.name));
  const auto meant = input::suggest(name, std::vector<std::string_view>(names.begin(), names.end()));
  throw ScenarioError("--measure " + input::excerpt(name, 80),
                      fmt::format("unknown; allowed are azimuth, tilt, axis, drift_azimuth, drift_tilt, outer_angle and "
                                  "inner_angle, each with _rad, _deg "
                                  "or _arcsec, e.g. azimuth_deg; and rotor_rate_rad_s or rotor_rate_rpm{}",
                                  meant ? fmt::format("; did you mean {}?", *meant) : ""));
}

}  // namespace

std::size_t count_rows(double every_s, double until_s) {
  if (!(every_s > 0) || !std::isfinite(every_s)) throw ScenarioError("--every", "must be a time above 0 (s)");
  if (!(until_s > 0) || !std::isfinite(until_s)) throw ScenarioError("--until", "must be a time above 0 (s)");
  const double steps = std::floor(until_s / every_s * (1 + 1e-12) + 1e-9);
  if (steps < 1) {
    const auto [every, until] = told_apart(every_s, until_s, 6);
    throw ScenarioError("--every", fmt::format("{} s is longer than the measurement, {} s; take a shorter one", every, until));
  }
  if (steps + 1 > static_cast<double>(kMostRows))
    throw ScenarioError(
        "--every", fmt::format("{:g} s makes more than {} rows in {:g} s; take a longer one", every_s, kMostRows, until_s));
  return static_cast<std::size_t>(steps) + 1;
}

std::vector<double> planned_times(double every_s, std::size_t rows) {
  std::vector<double> times_s(rows);
  for (std::size_t k = 0; k < rows; ++k) times_s[k] = static_cast<double>(k) * every_s;
  return times_s;
}

Measurement empty_measurement(const std::vector<PlannedQuantity>& quantities, const std::vector<double>& times_s) {
  Measurement measurement;
  measurement.rows = times_s.size();
  measurement.values.reserve(times_s.size() * quantities.size());
  for (const double t_s : times_s)
    for (const PlannedQuantity& quantity : quantities)
      measurement.values.push_back({quantity.quantity, t_s, 0, {}, quantity.standard_error * quantity.unit_size, 0});
  return measurement;
}

void fill_in(Measurement& measurement, const measure::PredictedMotion& motion) {
  if (motion.end) throw ScenarioError("--until", measure::words_on_end(*motion.end) + "; end the measurement by then");
  std::size_t at = 0;
  for (MeasuredValue& value : measurement.values) {
    while (motion.axes[at].t_s < value.t_s) ++at;
    const Vec3<double>& n_M = motion.axes[at].n_M;
    value.axis_L = {n_M[0], n_M[1], n_M[2]};
    const measure::PartQuantity* part = measure::part_quantity(value.quantity);
    if (part != nullptr && !(motion.axes[at].*part->predicted))
      throw ScenarioError("--measure",
                          fmt::format("{}: {}, or measure something else", to_string(value.quantity), part->missing));
  }
  std::vector<MeasurementResidual> residuals;
  try {
    residuals = measure::residuals_of(measurement, motion);
  } catch (const ScenarioError&) {
    throw ScenarioError(
        "--measure", "the predicted axis is vertical at a planned time and has no azimuth then; measure axis_deg, or tilt_deg");
  }
  auto residual = residuals.begin();
  for (MeasuredValue& value : measurement.values) {
    value.value = residual->predicted;
    residual += value.quantity == MeasuredQuantity::axis ? 2 : 1;
  }
}

Overrides lasting(Overrides overrides, const Scenario& scenario, double until_s) {
  if (until_s <= scenario.duration_s) return overrides;
  overrides.emplace_back("/motion/duration_s", fmt::format("{}", until_s));
  overrides.emplace_back("/motion/output_step_s", fmt::format("{}", until_s));
  return overrides;
}

}  // namespace plan

PlannedQuantity planned_quantity(const std::string& name, double standard_error) {
  std::string quantity, unit;
  for (const MeasuredQuantity measured : measure::kAllMeasured)
    for (const measure::MeasuredUnit& one : measure::units_of(measured))
      if (name == fmt::format("{}_{}", to_string(measured), one.name)) quantity = to_string(measured), unit = one.name;
  if (quantity.empty()) plan::refuse_quantity(name);
  std::vector<std::string> header = {"t_s", name};
  if (quantity == to_string(MeasuredQuantity::axis)) header = {"t_s", "axis_L_x", "axis_L_y", "axis_L_z"};
  header.push_back(fmt::format("{}_se_{}", quantity, unit));
  const measure::MeasurementColumns columns = measure::measurement_columns(header);
  if (!(standard_error > 0) || !std::isfinite(standard_error) || !std::isfinite(1 / standard_error))
    throw ScenarioError("--sigma", fmt::format("of {} must be above 0 ({})", name, unit));
  return {name, columns.quantities[0].quantity, unit, columns.quantities[0].error_unit, standard_error};
}

}  // namespace earthtop
