// SPDX-License-Identifier: GPL-3.0-or-later
/// The Cramer-Rao bound of the estimated numbers, from planned values and what is known beforehand.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "plan/derivatives.hpp"

namespace earthtop::plan {

/// The knowledge of a number before any measurement.
struct InputPrior {
  std::size_t input = 0;
  double standard_error = 0;  ///< in the number's unit
};

/// The values that are measured, out of those with derivatives.
struct ValueChoice {
  std::size_t stride = 1;                                      ///< every `stride`-th row
  std::size_t rows = std::numeric_limits<std::size_t>::max();  ///< at most this many rows
  double sigma_factor = 1;                                     ///< multiplies the standard errors
  double correlation_time_s = 0;
  std::size_t quantities = std::numeric_limits<std::size_t>::max();  ///< the first ones of the plan's
};

struct Bound {
  std::vector<double> alone;              ///< standard errors of the numbers, each if all others were known
  Eigen::MatrixXd covariance;             ///< of the numbers, in their units; empty where not all are determined
  std::vector<std::size_t> undetermined;  ///< the numbers that are not, or that cannot be told apart
  std::vector<double> direction;          ///< the change that no value notices, of each number in its unit
  bool is_determined() const { return undetermined.empty(); }
  /// Standard error of a number; none where not all are determined.
  std::optional<double> standard_error(std::size_t input) const;
};

/// The derivatives of the chosen values by the numbers, and by the inputs that are taken as exact behind them; below them those of
/// the priors.
Eigen::MatrixXd derivatives_by_all(const Derivatives& derivatives, const std::vector<double>& scales,
                                   const std::vector<InputPrior>& priors, const ValueChoice& choice);

/// @param scales  of the numbers, for `derivatives`
Bound bound_of(const Derivatives& derivatives, const std::vector<double>& scales, const std::vector<InputPrior>& priors,
               const ValueChoice& choice);

}  // namespace earthtop::plan
