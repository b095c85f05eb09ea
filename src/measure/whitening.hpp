// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors that are correlated in time, made independent.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "earthtop/measure/measurement.hpp"
#include "measure/error_memory.hpp"

namespace earthtop::measure {

/// The errors of one quantity, in their standard errors, follow an Ornstein-Uhlenbeck process: two of them are correlated by
/// rho = exp(-dt / tau), and given the latest one, those before it say nothing more. What is new in an error e_k is therefore
/// (e_k - rho_k e_(k-1)) / sqrt(1 - rho_k^2), and these are independent and of variance 1, whatever the distances of the rows.
class Whitening {
 public:
  Whitening() = default;  ///< of independent errors: changes nothing
  /// @param residuals  in the order of time; those of the same quantity are one series   @param tau_s  above 0 (s)
  /// @throws ScenarioError, with the row's line in `file`, where a quantity has two values at one time: their errors would be
  /// the same
  Whitening(const std::vector<MeasurementResidual>& residuals, double tau_s, const std::string& file);

  /// Adds the residuals of another release behind these: their errors are independent of these.
  void append(const Whitening& other);

  /// Whitens residuals in their standard errors. An azimuth's whole turns are chosen so that what is new in it is at most half
  /// a turn; where errors are independent, this is the residual nearest to 0.
  void whiten(Eigen::VectorXd& normalised) const;
  /// Whitens derivatives of such residuals, which have no turns.
  void whiten_derivative(Eigen::VectorXd& derivative) const;

 private:
  /// How a value depends on the one before it in its series.
  struct Link {
    std::optional<std::size_t> before;
    ErrorMemory memory = {};
    double period = 0;  // a whole turn in standard errors; 0: none
  };
  std::vector<Link> links_;  // empty for independent errors
};

}  // namespace earthtop::measure
