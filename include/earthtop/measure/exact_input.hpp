// SPDX-License-Identifier: GPL-3.0-or-later
/// The inputs of a scenario that a fit takes as exact, and what an error of each does to an estimate.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop {

/// An input that is not fitted. To first order, if its true value is larger than the scenario's by d, the estimate is larger by
/// shift * d.
struct ExactInput {
  std::string name;  ///< as `--estimate` takes it
  std::string unit;
  double value = 0;              ///< the scenario's
  std::optional<double> stated;  ///< its standard error, where the scenario's `uncertainty` has one
  double shift = 0;              ///< of the estimate, by unit of the input
  /// The length of the normalised residuals that an error of one unit leaves after the fit: its square adds to chi-squared.
  double misfit = 0;
  std::size_t release = 0;  ///< of several, the one whose input it is, counted from 1; 0: that of all

  /// The error of the input, without sign, that shifts an estimate by this standard error.
  double error_of_one_sigma(double standard_error) const { return standard_error / std::abs(shift); }
};

/// An error of an input: its true value minus the scenario's, in `unit`.
struct InputError {
  std::string name, unit;
  double error = 0;
  std::size_t release = 0;  ///< as of an exact input
};

/// "tilt_deg", or "tilt_deg of release 2"
std::string name_in_release(const std::string& name, std::size_t release);

/// The errors that shift the estimate by so much, each by itself, without adding more than this to chi-squared.
std::vector<InputError> errors_that_shift(const std::vector<ExactInput>& inputs, double by, double most_chi_squared);

}  // namespace earthtop
