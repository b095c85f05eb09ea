// SPDX-License-Identifier: GPL-3.0-or-later
/// A plan with its defaults filled in, and what is estimated with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "earthtop/plan/plan.hpp"
#include "earthtop/scene/scene.hpp"
#include "measure/estimated_inputs.hpp"
#include "plan/bound.hpp"

namespace earthtop::plan {

/// The scenario that a plan is for. @throws ScenarioError for one with which no measurement can be compared
Scene scene_to_measure(const ScenarioSource& source, const Overrides& overrides);

/// Fills in the end of the plan and its estimates. @throws ScenarioError for quantities that are missing or named twice
MeasurementPlan completed(MeasurementPlan plan, const Scene& scene);

/// The numbers that are fitted: estimates, nuisances, and inputs whose standard error the scenario states.
struct Numbers {
  std::vector<std::string> names;
  std::size_t asked = 0;  ///< the number of names, the first ones, that the plan has
  std::vector<InputPrior> priors;
  std::vector<std::string> notes;  ///< stated standard errors that are not used, and why
};
/// @throws ScenarioError for names that cannot be estimated
Numbers numbers_of(const ScenarioSource& source, const Overrides& overrides, const Scene& scene, const MeasurementPlan& plan);

/// Whether a number is wanted, and not only fitted because it is not known.
bool is_wanted(const std::string& name, const MeasurementPlan& plan);

inline constexpr std::size_t kMostNumbers = 12;

std::vector<double> scales_of(const std::vector<measure::EstimatedInput>& inputs);

}  // namespace earthtop::plan
