// SPDX-License-Identifier: GPL-3.0-or-later
/// Plans for shipped scenarios.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "earthtop/plan/plan.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {

inline ScenarioSource shipped(const std::string& name) {
  return read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + name + ".json");
}

/// @param quantities  each with its standard error
inline MeasurementPlan plan_for(const std::vector<std::pair<std::string, double>>& quantities, double every_s, double until_s,
                                std::vector<std::string> estimates = {}) {
  MeasurementPlan plan;
  for (const auto& [name, sigma] : quantities) plan.quantities.push_back(planned_quantity(name, sigma));
  plan.every_s = every_s;
  plan.until_s = until_s;
  plan.estimates = std::move(estimates);
  return plan;
}
inline MeasurementPlan plan_for(const std::string& quantity, double sigma, double every_s, double until_s,
                                std::vector<std::string> estimates = {}) {
  return plan_for({{quantity, sigma}}, every_s, until_s, std::move(estimates));
}

}  // namespace earthtop::testing
