// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planned_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "input/node.hpp"
#include "input/suggest.hpp"
#include "measure/quantities.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace plan {
namespace {

[[noreturn]] void refuse_quantity(const std::string& name) {
  std::vector<std::string> names;
  for (const measure::QuantityRow& row : measure::quantity_rows())
    for (const measure::MeasuredUnit& unit : measure::units_of(row.quantity))
      names.push_back(fmt::format("{}_{}", row.name, unit.name));
  const auto meant = input::suggest(name, std::vector<std::string_view>(names.begin(), names.end()));
  throw ScenarioError("--measure " + input::excerpt(name, 80),
                      fmt::format("unknown; allowed are {}; e.g. azimuth_deg{}", measure::quantities_in_words(),
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
  constexpr double kSame = 1e-9;
  std::size_t at = 0;
  std::map<MeasuredQuantity, double> latest_s;  // of the features
  for (std::size_t i = 0; i < measurement.values.size(); ++i) {
    MeasuredValue& value = measurement.values[i];
    while (motion.axes[at].t_s < value.t_s) ++at;
    const Vec3<double>& n_M = motion.axes[at].n_M;
    value.axis_L = {n_M[0], n_M[1], n_M[2]};
    const measure::QuantityRow& row = measure::row_of(value.quantity);
    const bool is_value = row.feature == measure::Feature::value;
    const double there = is_value ? motion.axes[at][value.quantity] : motion.features[i].value;
    if (!std::string_view(row.missing).empty() && std::isnan(there))
      throw ScenarioError("--measure", fmt::format("{}: {}{}, or measure something else", row.name,
                                                   is_value ? "" : fmt::format("at {:g} s, ", value.t_s), row.missing));
    if (is_value) continue;
    const measure::PredictedFeature& feature = motion.features[i];
    value.turns = feature.turns, value.extreme = feature.extreme;
    const auto [seen, is_new] = latest_s.try_emplace(value.quantity, feature.t_s);
    if (!is_new && row.feature != measure::Feature::period && !(feature.t_s > seen->second * (1 + kSame)))
      throw ScenarioError("--every",
                          fmt::format("two rows would measure the same {}, the one at {:.6g} s; take a longer one",
                                      row.feature == measure::Feature::turning ? "turning point" : "passage", feature.t_s));
    seen->second = feature.t_s;
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
  for (const measure::QuantityRow& row : measure::quantity_rows())
    for (const measure::MeasuredUnit& unit : measure::units_of(row.quantity)) {
      if (name != fmt::format("{}_{}", row.name, unit.name)) continue;
      if (!(standard_error > 0) || !std::isfinite(standard_error) || !std::isfinite(1 / standard_error))
        throw ScenarioError("--sigma", fmt::format("of {} must be above 0 ({})", name, unit.name));
      return {name, row.quantity, std::string(unit.name), unit.size, standard_error};
    }
  plan::refuse_quantity(name);
}

}  // namespace earthtop
