// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/preparation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "measure/input_places.hpp"
#include "plan/planned_rows.hpp"

namespace earthtop::plan {

using measure::EstimatedInputs;

namespace {

using InputsOf = std::function<EstimatedInputs(const std::vector<std::string>&)>;

/// Adds a prior on an input, and the input if it is not estimated yet. @param why  is set to the reason of the first refusal
/// @returns whether the scenario has this input, and it can be estimated besides the others
bool add_prior(Numbers& numbers, const measure::InputPlace& place, double standard_error, const InputsOf& inputs_of,
               std::string& why) {
  try {
    const EstimatedInputs alone = inputs_of({std::string(place.estimated)}), asked = inputs_of(numbers.names);
    const measure::EstimatedInput& input = alone.list()[0];
    const auto same = std::find_if(asked.list().begin(), asked.list().end(), [&](const measure::EstimatedInput& candidate) {
      return candidate.pointer == input.pointer && candidate.combined == input.combined;
    });
    if (same == asked.list().end()) {
      std::vector<std::string> more = numbers.names;
      more.emplace_back(place.estimated);
      inputs_of(more);
      numbers.names = std::move(more);
    }
    numbers.priors.push_back({static_cast<std::size_t>(same - asked.list().begin()), standard_error * place.per_unit});
    return true;
  } catch (const ScenarioError& error) {
    const Diagnostic& first = error.diagnostics().front();
    constexpr std::string_view kOption = "--estimate ";  // nobody gave it: the scenario names the input
    std::string_view name = first.pointer;
    if (name.starts_with(kOption)) name.remove_prefix(kOption.size());
    if (why.empty()) why = fmt::format("{}{}{}", name, name.empty() ? "" : ": ", first.message);
    return false;
  }
}

/// Why a stated standard error is no datum. The latitude's and the rate's say how well a component of the rate is known.
std::string note_on_unused(std::string_view input, const std::vector<std::string>& names, const std::string& why) {
  const auto component = std::ranges::find_if(names, [](const std::string& name) { return name.starts_with("omega_"); });
  if (component != names.end() && (input == "latitude_deg" || input == "rotation_rate_rad_s"))
    return fmt::format("the stated uncertainty of {} says how well {} is known; it is no datum", input, *component);
  return fmt::format("the stated uncertainty of {} is not used: {}", input, why);
}

}  // namespace

Scene scene_to_measure(const ScenarioSource& source, const Overrides& overrides) {
  Scene scene = parse_scene(source, overrides);
  if (scene.scenario().effects.automatic)
    throw ScenarioError("/effects", "the choice of effects is left to the program; to plan a measurement, name them");
  return scene;
}

MeasurementPlan completed(MeasurementPlan plan, const Scene& scene) {
  if (plan.quantities.empty())
    throw ScenarioError("--measure", "missing; name what is measured, e.g. --measure azimuth_deg --sigma 0.01 --every 0.1");
  for (auto a = plan.quantities.begin(); a != plan.quantities.end(); ++a)
    for (auto b = plan.quantities.begin(); b != a; ++b)
      if (a->quantity == b->quantity)
        throw ScenarioError("--measure " + a->name, fmt::format("is measured already, as {}; keep one", b->name));
  if (!(plan.correlation_time_s >= 0) || !std::isfinite(plan.correlation_time_s))
    throw ScenarioError("--correlation-time", "must be a time of at least 0 (s)");
  if (!plan.until_s) plan.until_s = scene.scenario().duration_s;
  const auto is_estimate = [&](const std::string& name) {
    return std::ranges::find(plan.nuisances, name) == plan.nuisances.end();
  };
  if (plan.estimates.empty() && std::ranges::none_of(plan.shared, is_estimate))
    plan.estimates.emplace_back(scene.scenario().effects.applied.gimbal ? "omega_cos_latitude_rad_s"
                                                                        : "omega_sin_latitude_rad_s");
  count_rows(plan.every_s, *plan.until_s);
  return plan;
}

bool is_wanted(const std::string& name, const MeasurementPlan& plan) {
  const auto has = [&](const std::vector<std::string>& names) { return std::ranges::find(names, name) != names.end(); };
  return has(plan.estimates) || (has(plan.shared) && !has(plan.nuisances));
}

Numbers numbers_of(const ScenarioSource& source, const Overrides& overrides, const Scene& scene, const MeasurementPlan& plan) {
  Numbers numbers{plan.estimates, 0, {}, {}};
  for (const std::string& name : plan.shared)
    if (std::ranges::find(plan.estimates, name) == plan.estimates.end() && is_wanted(name, plan)) numbers.names.push_back(name);
  numbers.names.insert(numbers.names.end(), plan.nuisances.begin(), plan.nuisances.end());
  numbers.asked = numbers.names.size();
  const auto inputs_of = [&](const std::vector<std::string>& names) {
    return EstimatedInputs(source, overrides, scene, names, kMostNumbers);
  };
  inputs_of(numbers.names);  // refuses what cannot be estimated
  const Instrument instrument = scene.scenario().instrument.value_or(Instrument());
  for (std::size_t i = 0; i < kInstrumentInputs; ++i) {
    std::string why;
    const std::string_view input = kInstrument[i].pointer;
    if (instrument.standard_error[i] > 0 && !add_prior(numbers, {input, 1}, instrument.standard_error[i], inputs_of, why))
      numbers.notes.push_back(note_on_unused(input, numbers.names, why));
  }
  const auto& uncertainty = scene.scenario().uncertainty;
  for (std::size_t k = 0; uncertainty && k < kInputs.size(); ++k) {
    if (!((*uncertainty)[k] > 0)) continue;
    std::string why;
    bool is_used = false;
    for (const measure::InputPlace& place : measure::places_of(kInputs[k]))
      if (!is_used) is_used = add_prior(numbers, place, (*uncertainty)[k], inputs_of, why);
    if (!is_used) numbers.notes.push_back(note_on_unused(kInputNames[k], numbers.names, why));
  }
  return numbers;
}

std::vector<double> scales_of(const std::vector<measure::EstimatedInput>& inputs) {
  std::vector<double> scales;
  for (const measure::EstimatedInput& input : inputs) scales.push_back(input.scale);
  return scales;
}

}  // namespace earthtop::plan
