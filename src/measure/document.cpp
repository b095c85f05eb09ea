// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>

#include "earthtop/measure/measurement.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace measure {
namespace {

using Json = nlohmann::ordered_json;  // writes numbers that are not finite as null

Json or_nothing(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json chi_squared_json(const ChiSquared& chi_squared) {
  const auto freedom = chi_squared.degrees_of_freedom;
  return {{"value", chi_squared.value},
          {"degrees_of_freedom", freedom},
          {"per_degree_of_freedom", freedom > 0 ? Json(chi_squared.value / static_cast<double>(freedom)) : Json(nullptr)},
          {"p_value", or_nothing(chi_squared.p_value)}};
}

Json estimate_json(const ParameterEstimate& estimate) {
  return {{"name", estimate.name},
          {"unit", estimate.unit},
          {"start", estimate.start},
          {"estimate", or_nothing(estimate.estimate)},
          {"standard_error", or_nothing(estimate.standard_error)},
          {"standard_error_scaled", or_nothing(estimate.standard_error_scaled)}};
}

Json residual_json(const MeasurementResidual& residual) {
  return {{"t_s", residual.t_s},
          {"quantity", std::string(residual.quantity)},
          {"line", residual.line},
          {"measured_rad", residual.measured_rad},
          {"predicted_rad", residual.predicted_rad},
          {"residual_rad", residual.residual_rad},
          {"standard_error_rad", residual.standard_error_rad},
          {"normalised", residual.normalised()}};
}

}  // namespace
}  // namespace measure

std::string measurement_json(const MeasurementReport& report) {
  using namespace measure;
  Json quantities = Json::array(), estimates = Json::array(), residuals = Json::array();
  for (const auto& [quantity, values] : report.quantities)
    quantities.push_back({{"name", std::string(to_string(quantity))}, {"values", values}});
  for (const ParameterEstimate& estimate : report.estimates) estimates.push_back(estimate_json(estimate));
  for (const MeasurementResidual& residual : report.residuals) residuals.push_back(residual_json(residual));
  const Json document = {
      {"$schema", "earthtop-measurement-1.json"},
      {"scenario", {{"name", report.scenario_name}, {"sha256", report.scenario_sha256}}},
      {"file", report.file},
      {"rows", report.rows},
      {"quantities", quantities},
      {"agrees", report.agrees()},
      {"least_p_value", MeasurementReport::kLeastPValue},
      {"prediction",
       {{"status", std::string(to_string(report.status))},
        {"reached_s", report.reached_s},
        {"verdict", report.verdict ? Json(std::string(to_string(*report.verdict))) : Json(nullptr)}}},
      {"chi_squared",
       {{"as_given", chi_squared_json(report.as_given)},
        {"fitted", report.fitted ? chi_squared_json(*report.fitted) : Json(nullptr)}}},
      {"fit",
       {{"outcome", std::string(to_string(report.fit))},
        {"reason", report.fit_reason},
        {"iterations", report.iterations},
        {"predictions", report.predictions}}},
      {"estimates", estimates},
      {"correlation", report.correlation},
      {"largest_residual", report.largest ? residual_json(report.residuals[*report.largest]) : Json(nullptr)},
      {"residuals_of", report.fitted ? "fitted" : "as_given"},
      {"residuals", residuals},
      {"notes", report.notes}};
  return json_with_escapes(written_replacing(document, 2)) + '\n';
}

}  // namespace earthtop
