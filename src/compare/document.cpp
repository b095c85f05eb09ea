// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "compare/conclusion.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/results/provenance.hpp"
#include "results/seal.hpp"

namespace earthtop {
namespace compare {
namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }
Json number_or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

Json quantity_json(const QuantityVerdict& quantity) {
  Json json = {{"name", quantity.name},
               {"passed", quantity.passed},
               {"reason", text_or_null(quantity.reason)},
               {"compared", quantity.compared},
               {"largest_difference", quantity.largest},
               {"where", text_or_null(quantity.where)},
               {"at_s", number_or_null(quantity.at_s)},
               {"tolerance", quantity.tolerance},
               {"tolerance_origin", quantity.origin},
               {"share_used", quantity.share},
               {"violations", quantity.violations},
               {"first_violation", text_or_null(quantity.first_violation)},
               {"first_violation_s", number_or_null(quantity.first_violation_s)},
               {"change", to_string(quantity.change)},
               {"error_bounds_sum", number_or_null(quantity.errors)},
               {"interpolation_error", number_or_null(quantity.interpolation_error)}};
  if (!quantity.curve.t_s.empty())
    json["curve"] = {
        {"t_s", quantity.curve.t_s}, {"difference", quantity.curve.difference}, {"tolerance", quantity.curve.tolerance}};
  return json;
}

Json pair_json(const PairReport& pair) {
  Json findings = Json::array(), left_out = Json::array(), quantities = Json::array(), cost = Json::array();
  std::vector<std::string> notes = pair.notes;
  notes.insert(notes.end(), pair.unverified.begin(), pair.unverified.end());
  for (const CompareFinding& finding : pair.findings) findings.push_back({{"kind", finding.kind}, {"text", finding.text}});
  for (const LeftOut& one : pair.left_out) left_out.push_back({{"name", one.name}, {"why", one.why}});
  for (const QuantityVerdict& quantity : pair.quantities) quantities.push_back(quantity_json(quantity));
  for (const CostRatio& ratio : pair.cost)
    cost.push_back({{"name", ratio.name},
                    {"reference", ratio.reference},
                    {"new", ratio.candidate},
                    {"ratio", ratio.reference > 0 ? Json(ratio.candidate / ratio.reference) : Json()},
                    {"limit", number_or_null(ratio.limit)},
                    {"passed", ratio.passed()}});
  return {{"name", text_or_null(pair.name)},
          {"reference", text_or_null(pair.reference)},
          {"new", text_or_null(pair.candidate)},
          {"verdict", !pair.refusal.empty() ? "refused"
                      : pair.passed()       ? "same"
                                            : "differs"},
          {"conclusion", conclusion_of(pair)},
          {"refusal", text_or_null(pair.refusal)},
          {"findings", std::move(findings)},
          {"notes", std::move(notes)},
          {"hints", pair.hints},
          {"rows_compared", pair.rows},
          {"rows_of_reference", pair.span.of},
          {"compared_from_s", pair.rows > 0 && !pair.span.are_points ? Json(pair.span.from_s) : Json()},
          {"compared_to_s", pair.rows > 0 && !pair.span.are_points ? Json(pair.span.to_s) : Json()},
          {"compared_until_s", number_or_null(pair.until_s)},
          {"common_end_s", pair.common_end ? Json(pair.common_end->t_s) : Json()},
          {"left_out", std::move(left_out)},
          {"quantities", std::move(quantities)},
          {"cost", std::move(cost)}};
}

}  // namespace
}  // namespace compare

std::string engine_fit_json(const EngineFit& fit) {
  using compare::Json;
  Json numbers = Json::array();
  for (const EngineFit::Number& number : fit.numbers)
    numbers.push_back({{"name", number.name},
                       {"unit", number.unit},
                       {"scenario", number.given},
                       {"estimate", compare::number_or_null(number.estimate)}});
  const Json document = {{"$schema", "earthtop-engine-fit-1.json"},
                         {"scenario", fit.scenario},
                         {"file", fit.file},
                         {"rows", fit.rows},
                         {"rms_given_rad", fit.given_rms_rad},
                         {"rms_fitted_rad", compare::number_or_null(fit.fitted_rms_rad)},
                         {"reason", compare::text_or_null(fit.reason)},
                         {"estimates", std::move(numbers)}};
  return sealed_document(document);
}

std::string comparison_json(const CompareReport& report) {
  using compare::Json;
  Json pairs = Json::array();
  for (const PairReport& pair : report.pairs) pairs.push_back(compare::pair_json(pair));
  const Json document = {{"$schema", "earthtop-comparison-1.json"},
                         {"reference", report.reference},
                         {"new", report.candidate},
                         {"verdict", report.refused()  ? "refused"
                                     : report.passed() ? "same"
                                                       : "differs"},
                         {"conclusion", comparison_conclusion(report)},
                         {"profile", to_string(report.profile)},
                         {"tolerances_file", compare::text_or_null(report.tolerances_file)},
                         {"program", {{"version", build_info().version}, {"commit", build_info().commit}}},
                         {"pairs", std::move(pairs)}};
  return sealed_document(document);
}

}  // namespace earthtop
