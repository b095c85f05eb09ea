// SPDX-License-Identifier: GPL-3.0-or-later
/// What the equations of a scene read of its inputs, differentiated.
#pragma once

#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// The derivatives of a scene's model and release by its inputs, in units of `scales`, in the model's natural units.
struct InputDerivatives {
  std::vector<ProblemDerivative> by_scaled_input;
  std::array<double, kInputNames.size()> values;  ///< of the inputs
  std::array<double, kInputNames.size()> scales;  ///< the size of an input, or of what it is measured against
};
/// Differences in 113 bits, of the formulas that lead from the inputs to the numbers of the equations. Nothing is integrated.
InputDerivatives input_derivatives(const Scenario& scenario, const NaturalUnits& units);

}  // namespace earthtop
