/// How the drift of a run changes with its inputs, and what their errors make of it.
#pragma once

#include <atomic>
#include <optional>

#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/run.hpp"

namespace earthtop {

/// The derivatives of a scene's model and release by its inputs, in units of `scales`, in the model's natural units.
struct InputDerivatives {
  std::array<ProblemDerivative, kInputs> by_scaled_input;
  std::array<double, kInputs> values;  ///< of the inputs
  std::array<double, kInputs> scales;  ///< the size of an input, or of what it is measured against
};
/// Differences in 113 bits, of the formulas that lead from the inputs to the numbers of the equations. Nothing is integrated.
InputDerivatives input_derivatives(const Scenario& scenario, const NaturalUnits& units);

/// The derivatives of the last reliable drift; none where the scenario does not ask for them.
std::optional<SensitivityReport> assess_sensitivities(const RunResult& result, const std::atomic<bool>& stop);

}  // namespace earthtop
