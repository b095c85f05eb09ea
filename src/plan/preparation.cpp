// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/preparation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "plan/planned_rows.hpp"

namespace earthtop::plan {

using measure::EstimatedInputs;

Scene scene_to_measure(const ScenarioSource& source, const Overrides& overrides) {
  Scene scene = parse_scene(source, overrides);
  if (scene.scenario().effects.automatic)
    throw ScenarioError("/effects", "the choice of effects is left to the program; name those to plan a measurement with");
  if (scene.scenario().contact)
    throw ScenarioError("/contact", "a measurement is planned for the motion of a top on a fixed pivot only");
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
  if (plan.estimates.empty())
    plan.estimates.emplace_back(scene.scenario().effects.applied.gimbal ? "omega_cos_latitude_rad_s"
                                                                        : "omega_sin_latitude_rad_s");
  count_rows(plan.every_s, *plan.until_s);
  return plan;
}

Numbers numbers_of(const ScenarioSource& source, const Overrides& overrides, const Scene& scene, const MeasurementPlan& plan) {
  Numbers numbers{plan.estimates, {}, {}};
  numbers.names.insert(numbers.names.end(), plan.nuisances.begin(), plan.nuisances.end());
  const auto inputs_of = [&](const std::vector<std::string>& names) {
    return EstimatedInputs(source, overrides, scene, names, kMostNumbers);
  };
  inputs_of(numbers.names);  // refuses what cannot be estimated
  const auto& uncertainty = scene.scenario().uncertainty;
  for (std::size_t k = 0; uncertainty && k < kInputNames.size(); ++k) {
    const std::string name(kInputNames[k]);
    const double standard_error = (*uncertainty)[k];
    if (!(standard_error > 0)) continue;
    try {
      const EstimatedInputs alone = inputs_of({name});
      const EstimatedInputs asked = inputs_of(numbers.names);
      const measure::EstimatedInput& input = alone.list()[0];
      const auto same = std::find_if(asked.list().begin(), asked.list().end(), [&](const measure::EstimatedInput& candidate) {
        return candidate.pointer == input.pointer && candidate.combined == input.combined;
      });
      if (same != asked.list().end()) {
        numbers.priors.push_back({static_cast<std::size_t>(same - asked.list().begin()), standard_error});
        continue;
      }
      std::vector<std::string> more = numbers.names;
      more.push_back(name);
      inputs_of(more);
      numbers.names = std::move(more);
      numbers.priors.push_back({numbers.names.size() - 1, standard_error});
    } catch (const ScenarioError& error) {
      const Diagnostic& why = error.diagnostics().front();
      numbers.notes.push_back(fmt::format("the stated uncertainty of {} is not used: {}{}{}", name, why.pointer,
                                          why.pointer.empty() ? "" : ": ", why.message));
    }
  }
  return numbers;
}

std::vector<double> scales_of(const EstimatedInputs& inputs) {
  std::vector<double> scales;
  for (const measure::EstimatedInput& input : inputs.list()) scales.push_back(input.scale);
  return scales;
}

}  // namespace earthtop::plan
