// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "earthtop/results/results.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json effect_json(const EffectEntry& entry) {
  return {{"name", entry.name},
          {"modelled", entry.modelled},
          {"size_assumed", entry.assumed},
          {"enters_difference", entry.in_difference},
          {"torque_release_N_m", finite_or_null(entry.torque_release_N_m)},
          {"torque_largest_N_m", finite_or_null(entry.torque_largest_N_m)},
          {"displacement_rad", finite_or_null(entry.displacement_rad)},
          {"drift_rad", finite_or_null(entry.drift_rad)},
          {"drift_final_rad", finite_or_null(entry.drift_final_rad)},
          {"reason", entry.reason}};
}

Json input_json(const InputNeed& need) {
  return {{"name", need.name},
          {"value", need.value},
          {"displacement_per_unit_rad", need.displacement_per_unit_rad},
          {"drift_per_unit_rad", need.drift_per_unit_rad},
          {"hides_earth", finite_or_null(need.hides_earth)}};
}

Json run_json(const Scene& scene) {
  const MethodChoice& choice = scene.choice();
  return {{"method", to_string(choice.options.method)},
          {"observer", to_string(choice.options.observer)},
          {"reason", choice.reason},
          {"relative_tolerance", choice.options.relative_tolerance},
          {"estimated_steps", scene.estimate().solution.steps},
          {"estimated_seconds", scene.estimate().seconds.all()}};
}

}  // namespace

std::string budget_json(const Budget& budget, const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  Json effects = Json::array(), inputs = Json::array();
  for (const EffectEntry& entry : budget.effects) effects.push_back(effect_json(entry));
  for (const InputNeed& need : budget.inputs) inputs.push_back(input_json(need));
  Json document = {{"$schema", "earthtop-budget-1.json"},
                   {"name", scenario.name},
                   {"duration_s", scenario.duration_s},
                   {"followed_s", budget.followed_s},
                   {"earth_drift_rad", budget.earth_drift_rad},
                   {"matching_rule", matching_rule(scenario)},
                   {"effects", std::move(effects)},
                   {"inputs", std::move(inputs)},
                   {"inputs_unavailable", budget.inputs_unavailable},
                   {"warnings", budget.warnings},
                   {"run", run_json(scene)}};
  return json_with_escapes(written_replacing(document, 2)) + '\n';
}

std::string contact_explanation_json(const ContactExplanation& explained, const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  Json forces = Json::array(), inputs = Json::array();
  for (const ContactForceSize& size : explained.forces)
    forces.push_back({{"name", size.name},
                      {"modelled", size.modelled},
                      {"force_release_N", size.force_release_N},
                      {"force_largest_N", size.force_largest_N},
                      {"torque_release_N_m", size.torque_release_N_m},
                      {"torque_largest_N_m", size.torque_largest_N_m}});
  for (const ContactInputNeed& need : explained.inputs)
    inputs.push_back({{"name", need.input},
                      {"step", need.step},
                      {"axis_rad", need.axis_rad},
                      {"tip_m", need.tip_m},
                      {"steps_that_hide_earth_axis", finite_or_null(need.hides_axis)},
                      {"steps_that_hide_earth_tip", finite_or_null(need.hides_tip)}});
  const Json document = {{"$schema", "earthtop-contact-budget-1.json"},
                         {"name", scenario.name},
                         {"duration_s", scenario.duration_s},
                         {"followed_s", explained.followed_s},
                         {"ended_by", explained.ended_by},
                         {"ended_at_s", finite_or_null(explained.ended_at_s)},
                         {"earth_drift_rad", explained.drift_axis_rad},
                         {"earth_drift_tip_m", explained.drift_tip_m},
                         {"matching_rule", matching_rule(scenario)},
                         {"forces", std::move(forces)},
                         {"slip_relaxation_1_s", finite_or_null(explained.slip_relaxation_1_s)},
                         {"largest_friction_over_normal_force", finite_or_null(explained.largest_friction_ratio)},
                         {"inputs_at_s", explained.inputs_at_s},
                         {"inputs", std::move(inputs)},
                         {"run", run_json(scene)}};
  return json_with_escapes(written_replacing(document, 2)) + '\n';
}

}  // namespace earthtop
