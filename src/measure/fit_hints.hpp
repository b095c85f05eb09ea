// SPDX-License-Identifier: GPL-3.0-or-later
/// Hints at what would mend a bad fit: numbers of the instrument and of the top that were not fitted, each tried in first order.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "measure/exact_inputs.hpp"

namespace earthtop::measure {

/// The fitted inputs and, behind them, all numbers of an instrument that can be fitted besides and that a measurement has to do with.
EstimatedInputs with_instrument(const Measurement& measurement, const ExactInputs& exact,
                                const ExactInputs::InputsOf& inputs_of);

/// The inputs that would take away at least half of what chi-squared has too much, each by itself; a turn of a release's mount about
/// East and North together. At most three.
/// @param J              derivatives of the normalised residuals, priors below them, by fitted and exact inputs, in their scales
/// @param of_instrument  what `with_instrument` gives   @param by_instrument  derivatives by those that are not fitted
std::vector<FitHint> hints_of(const ReleasesReport& report, const Eigen::MatrixXd& J, const JointExactInputs& exact,
                              const JointInputs& of_instrument, const Eigen::MatrixXd& by_instrument);

}  // namespace earthtop::measure
