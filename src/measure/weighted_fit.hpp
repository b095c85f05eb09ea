// SPDX-License-Identifier: GPL-3.0-or-later
/// Weighted nonlinear least squares of a few parameters, with an answer for everything that data may fail to say.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "earthtop/measure/measurement.hpp"

namespace earthtop::measure {

/// A problem of weighted least squares. A residual is a measured angle less the predicted one (rad).
struct FitProblem {
  std::vector<double> start;
  std::vector<double> scales;          ///< a change of a thousandth of it is small, of a parameter each
  std::vector<double> standard_error;  ///< of a residual each (rad)
  std::vector<double> period;          ///< what a residual may jump by where its angle goes round (rad); 0: it cannot
  /// @returns whether there is a prediction for these parameters; a false one leaves no residuals
  std::function<bool(const std::vector<double>& parameters, std::vector<double>& residuals)> residuals_at;
  std::function<bool()> stopped;
};

struct Fit {
  FitOutcome outcome = FitOutcome::not_converged;
  std::string reason;
  std::vector<std::size_t> undetermined;  ///< the parameters that the data do not tell, or not tell apart
  std::vector<double> parameters;
  Eigen::MatrixXd covariance;  ///< of the parameters, from the stated standard errors
  int iterations = 0;
};

/// The error of a predicted angle that the prediction's arithmetic causes, roughly (rad).
inline constexpr double kPredictionError_rad = 1e-11;

/// GSL's trust region (Levenberg-Marquardt) over central differences.
///
/// The step of a difference changes no residual by more than 1e-4 rad: there the prediction's own error is 1e-7 of the
/// difference, and a term of third order 1e-8 of it. No step is above a thousandth of the parameter's scale, so that for weak
/// influences, such as the Earth's, the former grows to some 1e-6: such derivatives cost the estimate nothing, since they only
/// lead to the least sum of squares, and its standard error its sixth digit.
///
/// Converged is a fit whose next full step would be a thousandth of the standard errors.
Fit fit_weighted(const FitProblem& problem);

}  // namespace earthtop::measure
