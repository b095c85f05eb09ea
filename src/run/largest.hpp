// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the largest value of a quantity along a motion, from looks that resolve the motion and a polynomial through the nearest of them.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace earthtop {

/// A largest value, and when it is taken.
struct Largest {
  double t_s = 0;
  double value = 0;
  double error = 0;         ///< estimate of the error of `value`; 0 where a look shows it
  std::size_t nearest = 0;  ///< number of the nearest look
  double amplified = 1;  ///< how often an error of the looks is in `value`, at most: more than once near the end of the looks
};

/// The largest value of a function that is known at evenly spaced times (s).
///   Between its looks the function is the polynomial through the sixteen nearest ones, whose derivative vanishes at the largest value.
///   The error is the change that the last two of them make.
/// @param values  NaN where the function is not defined: no polynomial leads across
/// @returns nothing where no value is a number
std::optional<Largest> largest_of(std::span<const double> times_s, std::span<const double> values);

/// The first time (s) at which such a function passes a level from below; nothing where it does not.
std::optional<double> first_passing(std::span<const double> times_s, std::span<const double> values, double level);

}  // namespace earthtop
