// SPDX-License-Identifier: GPL-3.0-or-later
/// The problem of least squares whose residuals are those of measurements against their scenarios' varied motions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/watch.hpp"
#include "measure/joint_inputs.hpp"
#include "measure/weighted_fit.hpp"

namespace earthtop::measure {

/// The rows of a release, and the inputs of its scenario that vary.
struct VariedRelease {
  const EstimatedInputs* inputs = nullptr;
  const Measurement* measurement = nullptr;
  std::vector<MeasurementResidual> residuals = {};  ///< of the scenario's own motion
  /// The method for all motions, so that it is not chosen anew for each; where it does not fit one, that has its own. None: each has
  /// its own.
  std::optional<Method> method = {};
};

/// The predictions that a problem has asked for.
struct Trials {
  std::int64_t& predictions;  ///< is counted up
  double part = 0;            ///< the part that each prediction reports of the share that is left: their number is not known
  double share = 0;           ///< the share of the work that has been reported
};

/// The residuals of a release with these values of its inputs; none where a value is out of range, where no such motion exists,
/// where an axis is vertical, and where the motion would take days.
std::optional<std::vector<MeasurementResidual>> varied_residuals(const VariedRelease& release,
                                                                 const std::vector<double>& values, const Watch& watch,
                                                                 Trials& trials);

/// The problem without priors or whitening; its residuals are those of all releases, one after the other. A motion is not computed
/// again for values that its release had a few predictions before, as where another release's own number varies. All arguments must
/// live as long as the problem is used.
FitProblem prediction_problem(const JointInputs& inputs, const std::vector<VariedRelease>& releases, const Watch& watch,
                              Trials& trials);

/// A release whose motions all have the method that is the scenario's own. @param residuals  of the scenario's own motion
VariedRelease varied_release(const EstimatedInputs& inputs, const Measurement& measurement,
                             std::vector<MeasurementResidual> residuals);

}  // namespace earthtop::measure
