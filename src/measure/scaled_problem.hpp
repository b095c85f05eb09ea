// SPDX-License-Identifier: GPL-3.0-or-later
/// A fit's problem, scaled so that all numbers are near 1, with derivatives.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "measure/weighted_fit.hpp"

namespace earthtop::measure {

/// The problem in parameters divided by their scales, 1 at the start, and residuals divided by their standard errors and
/// whitened. Those of the priors follow those of the data.
class ScaledProblem {
 public:
  struct Stopped {};  ///< thrown if the work was asked to stop

  explicit ScaledProblem(const FitProblem& problem);

  std::size_t parameters() const { return problem_.start.size(); }
  std::size_t residuals() const { return problem_.standard_error.size() + problem_.priors.size(); }
  std::vector<double> unscaled(const std::vector<double>& u) const;
  std::vector<double> scaled(const std::vector<double>& x) const;

  /// Computes the scaled residuals f at the scaled parameters u. @returns whether there is a prediction
  bool evaluate(const std::vector<double>& u, Eigen::VectorXd& f);
  /// Derivatives of residuals (rows) by parameters. @returns whether there are predictions
  bool jacobian(const std::vector<double>& u, Eigen::MatrixXd& J);

  enum class StepFound { yes, no_influence, no_prediction };
  /// Sets the step of the finite differences by which a parameter's derivatives are computed.
  StepFound find_step(const std::vector<double>& u, std::size_t parameter);

  const std::vector<double>& steps() const { return steps_; }

  /// How well the step of a difference is chosen: a rough one takes fewer predictions, to one side, and has some three digits.
  enum class Step { fine, rough };
  /// Finds such a step, and the derivatives of the residuals by the parameter: whitened, and 0 for the priors of others.
  StepFound derivative(const std::vector<double>& u, std::size_t parameter, Step wanted, Eigen::VectorXd& column);

 private:
  bool predict(const std::vector<double>& u, Eigen::VectorXd& f);
  /// The residuals at a place from which differences are taken; null where there is no prediction.
  const Eigen::VectorXd* predicted_at(const std::vector<double>& u);
  bool differentiate(const std::vector<double>& u, std::size_t parameter, Eigen::VectorXd& derivative,
                     const Eigen::VectorXd* here);
  StepFound find_step(const std::vector<double>& u, std::size_t parameter, double within, Eigen::VectorXd& derivative,
                      const Eigen::VectorXd* here);
  Eigen::VectorXd with_priors(Eigen::VectorXd of_data, std::size_t parameter) const;
  double largest_change_rad(const Eigen::VectorXd& derivative, double step) const;

  const FitProblem& problem_;
  std::vector<double> steps_;
  std::vector<double> residuals_;
  std::vector<double> here_at_;           // the latest place of a whole set of residuals
  Eigen::VectorXd here_;                  // the data's residuals there, not whitened
  std::vector<double> columns_at_;        // the place at which steps were found
  std::vector<Eigen::VectorXd> columns_;  // of each parameter, the data's derivatives that its step gave there; empty: none
};

}  // namespace earthtop::measure
