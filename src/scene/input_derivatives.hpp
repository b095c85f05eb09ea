// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers that the equations of a scene read, differentiated by the scene's inputs.
#pragma once

#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The derivatives of a scene's model and release by its inputs, in units of `scales`, in the model's natural units.
struct InputDerivatives {
  std::vector<ProblemDerivative> by_scaled_input;
  std::array<double, kInputNames.size()> values;  ///< of the inputs
  std::array<double, kInputNames.size()> scales;  ///< the size of an input, or of what it is measured against
};
/// Differences in 113 bits, of the formulas that lead from the inputs to the numbers of the equations. Nothing is integrated.
InputDerivatives input_derivatives(const Scene& scene);

/// The tolerance at which a run integrates the drift's derivatives.
inline constexpr double kSensitivityTolerance = 1e-11;
/// Why the drift's derivatives at a time (s) cannot be had; nothing where they can.
std::optional<std::string> sensitivity_refusal(const Scene& scene, double time_s);
/// The seconds that they take by so many inputs, followed from the release to a time (s).
double sensitivity_seconds(const Scene& scene, double time_s, double relative_tolerance, std::size_t inputs);

}  // namespace earthtop
