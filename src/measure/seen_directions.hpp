// SPDX-License-Identifier: GPL-3.0-or-later
/// The directions in the space of parameters that data see, apart from those that are left to what is known beforehand.
#pragma once

#include <Eigen/Core>

namespace earthtop::measure {

/// With priors a direction that the data do not determine may count for as little as this part of the largest influence:
/// rounding is far below it.
inline constexpr double kLeastWithPriors = 1e-12;

/// The information of derivatives of normalised residuals on the parameters. Directions whose influence is below Influences::kLeast of the
/// largest are not seen: the derivatives along them are errors of differences, and count as 0.
struct SeenDirections {
  Eigen::MatrixXd rows;     ///< (seen directions by parameters) with the same information as the derivatives
  Eigen::MatrixXd unseen;   ///< (parameters by unseen directions) orthonormal, for parameters multiplied by `lengths`
  Eigen::VectorXd lengths;  ///< of the columns of the derivatives

  /// The derivatives (residuals by parameters) without what they say along the unseen directions.
  Eigen::MatrixXd seen_part(Eigen::MatrixXd J) const;
};

/// @param J  derivatives of normalised residuals (rows) by parameters
SeenDirections seen_directions(const Eigen::MatrixXd& J);

}  // namespace earthtop::measure
