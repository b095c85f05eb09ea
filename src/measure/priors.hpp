// SPDX-License-Identifier: GPL-3.0-or-later
/// The standard errors that a scenario's `uncertainty` block gives for the inputs that are estimated.
#pragma once

#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/scene/scene.hpp"
#include "measure/compared_release.hpp"
#include "measure/joint_inputs.hpp"
#include "measure/weighted_fit.hpp"

namespace earthtop::measure {

/// The standard errors of the `uncertainty` block that are about estimated inputs, and why the others are not.
struct FoundPriors {
  std::vector<Prior> used;
  std::vector<FitPrior> of_fit;  ///< the same for the fit
  std::vector<UnusedPrior> unused;
};

/// @param inputs  those that are estimated of the scene
/// @throws ScenarioError where the scenario has no such block
FoundPriors find_priors(const Scene& scene, const std::vector<EstimatedInput>& inputs);

/// The same of several releases. What is known of a shared number is one datum, whichever scenarios state it: the first's.
/// @throws ScenarioError where no scenario has such a block
FoundPriors find_priors(const std::vector<ComparedRelease>& releases, const JointInputs& inputs);

}  // namespace earthtop::measure
