// SPDX-License-Identifier: GPL-3.0-or-later
/// Weighted nonlinear least squares for a few parameters, with a stated outcome where the data do not determine them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "measure/whitening.hpp"

namespace earthtop::measure {

/// The prior knowledge of a parameter is that it is its start, with a standard error.
struct FitPrior {
  std::size_t parameter = 0;
  double standard_error = 0;  ///< above 0, in the parameter's unit
};

/// A problem of weighted least squares. A residual is a measured angle minus the predicted one (rad).
struct FitProblem {
  std::vector<double> start;
  std::vector<double> scales;          ///< for each parameter, a size of which a thousandth is a small change
  std::vector<double> standard_error;  ///< for each residual (rad, rad/s, m or s)
  std::vector<double> size;            ///< for each residual, in its unit: what a radian is for an angle; empty: all are angles
  std::vector<double> period;          ///< for each residual, its jump when its angle passes a full turn (rad); 0: none
  Whitening whitening;                 ///< of the residuals divided by their standard errors
  std::vector<FitPrior> priors;        ///< each is a datum besides the residuals
  std::vector<double> from;            ///< where the search begins; empty: at `start`, about which priors are known
  std::vector<double> steps;           ///< first steps of the differences, in scales; empty: not known
  /// Whether the fit only shows the way to another: derivatives by differences to one side, and fewer digits of the minimum.
  bool rough = false;
  /// Computes the residuals. @returns whether there is a prediction for these parameters; if not, `residuals` has no meaning
  std::function<bool(const std::vector<double>& parameters, std::vector<double>& residuals)> residuals_at;
  std::function<bool()> stopped;
};

struct Fit {
  FitOutcome outcome = FitOutcome::not_converged;
  std::string reason;
  std::vector<std::size_t> undetermined;  ///< the parameters that the data do not determine, or cannot distinguish
  std::vector<double> parameters;         ///< where the search ended; empty if it could not begin
  std::vector<double> steps;              ///< of the differences, in scales
  double chi_squared = 0;                 ///< there, with that of the priors
  Eigen::MatrixXd covariance;             ///< of the parameters, from the stated standard errors; of a fit that has converged
  Eigen::MatrixXd jacobian;  ///< of such a fit: of the whitened residuals, priors below them, by parameters in scales
  int iterations = 0;
};

/// The error of a predicted angle that the prediction's arithmetic causes, roughly (rad); of other numbers in parts of their size.
inline constexpr double kPredictionError_rad = 1e-11;

/// Fits the parameters by GSL's trust region method (Levenberg-Marquardt) with central differences.
///
/// The step of a difference changes no residual by more than 1e-4 rad: at that size the prediction's own error is 1e-7 of the
/// difference, and the term of third order 1e-8 of it. No step is above a thousandth of the parameter's scale, so that for weak
/// influences, such as the Earth's, the first of these errors grows to about 1e-6. The estimate does not suffer from that,
/// since derivatives only lead to the least sum of squares; the standard error loses its sixth digit.
///
/// Before that, steps go along the derivatives at the start, as long as the sum of squares falls by at least half of what these
/// derivatives promise: such a step costs one motion.
///
/// A fit has converged if its next full step would be at most a thousandth of the standard errors; a rough one, a tenth.
Fit fit_weighted(const FitProblem& problem);

}  // namespace earthtop::measure
