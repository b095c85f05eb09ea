// SPDX-License-Identifier: GPL-3.0-or-later
/// The problem of least squares whose residuals are those of a measurement against a scenario's varied motion.
#pragma once

#include <cstdint>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/watch.hpp"
#include "measure/estimated_inputs.hpp"
#include "measure/weighted_fit.hpp"

namespace earthtop::measure {

/// The predictions that a problem has asked for.
struct Trials {
  std::int64_t& predictions;  ///< is counted up
  double part = 0;            ///< the part that each prediction reports of the share that is left: their number is not known
  double share = 0;           ///< the share of the work that has been reported
  std::vector<MeasurementResidual> latest;  ///< of the last prediction
};

/// The problem without priors or whitening. A set of inputs has no prediction if it is out of range, if no such motion exists,
/// where an axis is vertical, or where the motion would take days. All arguments must live as long as the problem is used.
/// @param residuals  of the scenario's own motion   @param times_s  of the measurement
FitProblem prediction_problem(const EstimatedInputs& inputs, const Measurement& measurement,
                              const std::vector<MeasurementResidual>& residuals, const std::vector<double>& times_s,
                              const Watch& watch, Trials& trials);

}  // namespace earthtop::measure
