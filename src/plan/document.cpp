// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "earthtop/plan/plan.hpp"
#include "measure/finding_json.hpp"
#include "results/seal.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace plan {
namespace {

using Json = nlohmann::ordered_json;  // writes numbers that are not finite as null

Json estimate_json(const PlannedEstimate& estimate) {
  Json json = {{"name", estimate.name},
               {"unit", estimate.unit},
               {"value", estimate.value},
               {"nuisance", estimate.is_nuisance},
               {"prior", or_nothing(estimate.prior)},
               {"standard_error", or_nothing(estimate.standard_error)},
               {"significance", or_nothing(estimate.significance())},
               {"standard_error_alone", or_nothing(estimate.standard_error_alone)},
               {"finding", measure::finding_json(estimate.finding)},
               {"exact", measure::exact_json(estimate.exact, estimate.standard_error)}};
  measure::put_release(json, estimate.release);
  return json;
}

Json variation_json(const PlanVariation& variation) {
  const bool has_input = !variation.input.empty();
  return {{"change", std::string(to_string(variation.change))},
          {"factor", variation.factor},
          {"input", has_input ? Json(variation.input) : Json(nullptr)},
          {"input_standard_error", has_input ? Json(variation.input_error) : Json(nullptr)},
          {"rows", variation.rows},
          {"standard_error", or_nothing(variation.standard_error)}};
}

Json optimum_json(const PlanOptimum& optimum) {
  Json choices = Json::array();
  for (const DesignChoice& choice : optimum.choices)
    choices.push_back({{"pointer", choice.input.pointer},
                       {"low", choice.input.low},
                       {"high", choice.input.high},
                       {"given", choice.given},
                       {"best", choice.best},
                       {"at_limit", choice.is_at_limit}});
  return {{"choices", choices},   {"standard_error", optimum.standard_error}, {"significance", optimum.significance},
          {"rows", optimum.rows}, {"evaluations", optimum.evaluations},       {"avoided", optimum.avoided}};
}

}  // namespace
}  // namespace plan

std::string plan_json(const PlanReport& report) {
  using namespace plan;
  Json quantities = Json::array(), estimates = Json::array(), variations = Json::array(), changes = Json::array(),
       undetermined = Json::array();
  for (const PlannedQuantity& quantity : report.plan.quantities)
    quantities.push_back({{"name", quantity.name}, {"standard_error", quantity.standard_error}, {"unit", quantity.unit}});
  for (const PlannedEstimate& estimate : report.estimates) estimates.push_back(estimate_json(estimate));
  for (const PlanVariation& variation : report.variations) variations.push_back(variation_json(variation));
  for (const PlanVariation& change : report.changes) changes.push_back(variation_json(change));
  for (const auto& [name, change] : report.undetermined) undetermined.push_back({{"name", name}, {"change", change}});
  Json document = {{"$schema", "earthtop-plan-1.json"},
                   {"scenario", {{"name", report.scenario_name}, {"sha256", report.scenario_sha256}}},
                   {"plan",
                    {{"quantities", quantities},
                     {"every_s", report.plan.every_s},
                     {"until_s", or_nothing(report.plan.until_s)},
                     {"correlation_time_s", report.plan.correlation_time_s},
                     {"rows", report.rows},
                     {"values", report.values}}},
                   {"prediction",
                    {{"status", std::string(to_string(report.status))},
                     {"verdict", report.verdict ? Json(std::string(to_string(*report.verdict))) : Json(nullptr)},
                     {"motions", report.predictions}}},
                   {"outcome", std::string(to_string(report.outcome))},
                   {"reason", report.reason},
                   {"undetermined", undetermined},
                   {"estimates", estimates},
                   {"correlation", report.correlation},
                   {"variations", variations},
                   {"changes", changes},
                   {"advice", report.advice},
                   {"optimum", report.optimum ? optimum_json(*report.optimum) : Json(nullptr)},
                   {"notes", report.notes}};
  if (!report.releases.empty()) document["releases"] = Json::array();
  for (const ReleasePlan& release : report.releases)
    document["releases"].push_back({{"scenario", {{"name", release.scenario_name}, {"sha256", release.scenario_sha256}}},
                                    {"standard_error_alone", or_nothing(release.standard_error)}});
  return sealed_document(document);
}

}  // namespace earthtop
