// SPDX-License-Identifier: GPL-3.0-or-later
/// Derivatives of the numbers in a scene's equations of motion by the scene's inputs.
#pragma once

#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The derivatives of a scene's model and release by its inputs, in units of `scales`, in the model's natural units. All lists
/// have one element for each input that the scene has.
struct InputDerivatives {
  std::vector<std::size_t> inputs;  ///< places of the inputs in kInputs, ascending
  std::vector<ProblemDerivative> by_scaled_input;
  std::vector<double> values;  ///< values of the inputs
  std::vector<double> scales;  ///< size of each input, or of the quantity with which it is compared
};
/// Computes central differences, in 113 bits, of the formulas that lead from the inputs to the numbers of the equations.
/// Nothing is integrated.
InputDerivatives input_derivatives(const Scene& scene);

}  // namespace earthtop
