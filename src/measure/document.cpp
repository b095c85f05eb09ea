// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/document.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "measure/finding_json.hpp"
#include "measure/quantities.hpp"
#include "results/seal.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace measure {
namespace {

using Json = nlohmann::ordered_json;  // writes numbers that are not finite as null

Json chi_squared_json(const ChiSquared& chi_squared) {
  const auto freedom = chi_squared.degrees_of_freedom;
  return {{"value", chi_squared.value},
          {"degrees_of_freedom", freedom},
          {"per_degree_of_freedom", freedom > 0 ? Json(chi_squared.value / static_cast<double>(freedom)) : Json(nullptr)},
          {"p_value", or_nothing(chi_squared.p_value)},
          {"of_priors", chi_squared.of_priors}};
}

Json estimate_json(const ParameterEstimate& estimate, bool by_scatter) {
  Json json = {{"name", estimate.name},
               {"unit", estimate.unit},
               {"start", estimate.start},
               {"estimate", or_nothing(estimate.estimate)},
               {"standard_error", or_nothing(estimate.standard_error)},
               {"standard_error_scaled", or_nothing(estimate.standard_error_scaled)},
               {"sentence", estimate_sentence(estimate, by_scatter)},
               {"finding", finding_json(estimate.finding)},
               {"exact", exact_json(estimate.exact, estimate.said_error(by_scatter))}};
  put_release(json, estimate.release);
  return json;
}

Json hint_json(const FitHint& hint) {
  Json values = Json::array();
  for (const FitHint::Value& v : hint.values) {
    values.push_back({{"name", v.name}, {"unit", v.unit}, {"value", v.value}, {"standard_error", v.standard_error}});
    put_release(values.back(), v.release);
  }
  return {{"inputs", values}, {"chi_squared", hint.chi_squared}, {"sentence", hint_sentence(hint)}};
}

Json prior_json(const Prior& prior) {
  Json json = {{"name", prior.name},
               {"input", prior.input},
               {"unit", prior.unit},
               {"mean", prior.mean},
               {"standard_error", prior.standard_error},
               {"pull", or_nothing(prior.pull)}};
  put_release(json, prior.release);
  return json;
}

/// The numbers of a residual, whose keys have the unit.
struct ResidualNumber {
  std::string_view stem;
  double MeasurementResidual::*member;
  std::string key(std::string_view quantity) const { return fmt::format("{}_{}", stem, unit_of(row_of(quantity).dimension)); }
};
constexpr ResidualNumber kResidualNumbers[] = {{"measured", &MeasurementResidual::measured},
                                               {"predicted", &MeasurementResidual::predicted},
                                               {"residual", &MeasurementResidual::residual},
                                               {"standard_error", &MeasurementResidual::standard_error}};

Json residual_json(const MeasurementResidual& residual) {
  Json json = {{"t_s", residual.t_s},
               {"quantity", std::string(residual.quantity)},
               {"line", residual.line},
               {"normalised", residual.normalised()}};
  for (const ResidualNumber& number : kResidualNumbers) json[number.key(residual.quantity)] = residual.*number.member;
  if (residual.whitened) json["whitened"] = *residual.whitened;
  return json;
}

/// The name of a quantity's column in a curve.
std::string curve_column(const QuantityRow& row) { return fmt::format("{}_{}", row.name, unit_of(row.dimension)); }
bool is_in_curves(const QuantityRow& row) { return row.feature == Feature::value && row.quantity != MeasuredQuantity::axis; }

Json curve_json(const std::vector<CurvePoint>& curve, bool is_mean) {
  if (curve.empty()) return nullptr;
  Json json = {{"mean", is_mean}};
  Json& times = json["t_s"] = Json::array();
  for (const CurvePoint& point : curve) times.push_back(point.t_s);
  for (const QuantityRow& row : quantity_rows()) {
    const auto known = [&](const CurvePoint& point) { return std::isfinite(shown(point, row)); };
    if (!is_in_curves(row) || std::none_of(curve.begin(), curve.end(), known)) continue;
    Json& values = json[curve_column(row)] = Json::array();
    for (const CurvePoint& point : curve) values.push_back(shown(point, row));
  }
  return json;
}

Json quantities_json(const MeasurementReport& report) {
  Json quantities = Json::array();
  for (const auto& [quantity, values] : report.quantities)
    quantities.push_back({{"name", std::string(to_string(quantity))}, {"values", values}});
  return quantities;
}

Json chi_squared_json(const FitReport& report) {
  return {{"as_given", chi_squared_json(report.as_given)},
          {"fitted", report.fitted ? chi_squared_json(*report.fitted) : Json(nullptr)}};
}

/// The parts of a document that are about one release.
void put_release_of(Json& document, const MeasurementReport& report) {
  document["scenario"] = {{"name", report.scenario_name}, {"sha256", report.scenario_sha256}};
  document["file"] = report.file;
  document["rows"] = report.rows;
  document["quantities"] = quantities_json(report);
}
void put_prediction(Json& document, const MeasurementReport& report) {
  document["prediction"] = {{"status", std::string(to_string(report.status))},
                            {"reached_s", report.reached_s},
                            {"verdict", report.verdict ? Json(std::string(to_string(*report.verdict))) : Json(nullptr)}};
}
void put_rows(Json& document, const MeasurementReport& report) {
  Json residuals = Json::array();
  for (const MeasurementResidual& residual : report.residuals) residuals.push_back(residual_json(residual));
  document["largest_residual"] = report.largest ? residual_json(report.residuals[*report.largest]) : Json(nullptr);
  document["residuals_of"] = report.fitted ? "fitted" : "as_given";
  document["residuals"] = residuals;
  document["curve"] = curve_json(report.curve, report.curve_is_mean);
  document["notes"] = report.notes;
}

Json quotation_json(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

void put_fit(Json& document, const FitReport& report) {
  Json estimates = Json::array(), hints = Json::array(), priors = Json::array(), unused_priors = Json::array();
  for (const ParameterEstimate& estimate : report.estimates)
    estimates.push_back(estimate_json(estimate, report.scatters_more()));
  for (const FitHint& hint : report.hints) hints.push_back(hint_json(hint));
  for (const Prior& prior : report.priors) priors.push_back(prior_json(prior));
  for (const UnusedPrior& prior : report.unused_priors)
    unused_priors.push_back({{"name", prior.name}, {"reason", prior.reason}});
  document["chi_squared"] = chi_squared_json(report);
  document["fit"] = {{"outcome", std::string(to_string(report.fit))},
                     {"reason", report.fit_reason},
                     {"iterations", report.iterations},
                     {"predictions", report.predictions},
                     {"spans", report.search.spans},
                     {"attempts", report.search.attempts},
                     {"minima", report.search.minima}};
  document["estimates"] = estimates;
  document["correlation"] = report.correlation;
  document["hints"] = hints;
  document["priors"] = priors;
  document["unused_priors"] = unused_priors;
  document["correlation_time_s"] = report.correlation_time_s > 0 ? Json(report.correlation_time_s) : Json(nullptr);
}

double number_or_nan(const Json& json) {
  return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string_view quantity_named(const std::string& name) {
  const std::string_view known = residual_quantity(name);
  if (known.empty()) refuse_value("not a measured quantity: " + name);
  return known;
}

}  // namespace

MeasurementReport measurement_of(const Json& document) {
  MeasurementReport report;
  report.scenario_name = document.at("scenario").at("name").get<std::string>();
  report.file = document.at("file").get<std::string>();
  report.rows = count_in(document.at("rows"));
  report.correlation_time_s = document.value("correlation_time_s", Json(0)).is_number()
                                  ? document.value("correlation_time_s", Json(0)).get<double>()
                                  : 0;
  if (document.at("residuals_of") == "fitted") report.fitted.emplace();
  for (const Json& json : document.at("residuals")) {
    MeasurementResidual residual;
    residual.t_s = json.at("t_s").get<double>();
    residual.line = count_in(json.at("line"));
    residual.quantity = quantity_named(json.at("quantity").get<std::string>());
    for (const ResidualNumber& number : kResidualNumbers)
      residual.*number.member = number_or_nan(json.at(number.key(residual.quantity)));
    if (json.contains("whitened")) residual.whitened = number_or_nan(json.at("whitened"));
    report.residuals.push_back(residual);
  }
  const Json curve = document.value("curve", Json());
  if (!curve.is_object()) return report;
  report.curve_is_mean = curve.value("mean", false);
  for (const Json& t_s : curve.at("t_s")) {
    CurvePoint point{number_or_nan(t_s)};
    for (const QuantityRow& row : quantity_rows()) {
      if (!is_in_curves(row)) continue;
      const std::string column = curve_column(row);
      if (curve.contains(column))
        show(point, row, number_or_nan(curve.at(column).at(report.curve.size())));
      else if (row.shown)
        show(point, row, std::numeric_limits<double>::quiet_NaN());
    }
    report.curve.push_back(std::move(point));
  }
  return report;
}

}  // namespace measure

std::string measurement_json(const MeasurementReport& report) {
  using namespace measure;
  Json document = {{"$schema", "earthtop-measurement-1.json"}};
  put_release_of(document, report);
  document["agrees"] = report.agrees();
  document["least_p_value"] = FitReport::kLeastPValue;
  put_prediction(document, report);
  put_fit(document, report);
  document["quotation"] = quotation_json(quotation(report));
  put_rows(document, report);
  return sealed_document(document);
}

std::string releases_json(const ReleasesReport& report) {
  using namespace measure;
  Json document = {
      {"$schema", "earthtop-releases-1.json"}, {"agrees", report.agrees()}, {"least_p_value", FitReport::kLeastPValue}};
  put_fit(document, report);
  document["quotation"] = quotation_json(quotation(report));
  document["notes"] = report.notes;
  document["releases"] = Json::array();
  for (const MeasurementReport& release : report.releases) {
    Json of_release = Json::object();
    put_release_of(of_release, release);
    put_prediction(of_release, release);
    of_release["chi_squared"] = chi_squared_json(static_cast<const FitReport&>(release));
    put_rows(of_release, release);
    document["releases"].push_back(std::move(of_release));
  }
  return sealed_document(document);
}

}  // namespace earthtop
