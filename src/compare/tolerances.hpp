// SPDX-License-Identifier: GPL-3.0-or-later
/// How much each quantity may differ by, and why so much.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compare/row.hpp"
#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// A tolerance is the largest of: absolute; relative x the quantity's scale; effect x the Earth's effect on it; bounds x the
/// sum of both error bounds.
struct Rule {
  double absolute = 0, relative = 0, effect = 0, bounds = 0;
  std::string source;  ///< "profile regression", or the file
  double times = 0;    ///< instead, where above 0: so many times larger or smaller at most
};

/// Whether two errors are of one size: neither is so many times the other, or both are small beside the largest one.
bool are_of_one_size(double a, double b, double times, double largest);

/// A tolerance with the part that it is.
struct Tolerance {
  double value = 0;
  std::string origin;
};

/// The part that does not change from row to row.
double fixed_part(const Rule& rule, double scale, double effect);
/// The most that error bounds may allow, however large they are said to be: the Earth's effect, or where there is none a tenth
/// of the quantity's size. Beyond it nothing would be compared.
double largest_for_bounds(double scale, double effect);
/// Everything together, in words.
Tolerance tolerance_of(const Rule& rule, double scale, double effect, double errors);

/// @param same_computation  the same scenario, numerics included, and a motion that does not magnify rounding: then both have
/// the same errors, and nothing but rounding should differ
/// @returns none where the profile does not compare it
std::optional<Rule> rule_of(const Measure& measure, const Tolerances& tolerances, bool same_computation, double effect);

/// What a figure of summary.json is, which says how much of it may change.
enum class FigureKind {
  word,            ///< equal or not
  drift_axis,      ///< has the error bound of the axis drift
  drift_tilt,      ///< the same, and what the attitudes' errors make of the drift's direction
  drift_azimuth,   ///< that at the axis's distance from the vertical
  azimuth_rate,    ///< the same, over the duration
  drift_attitude,  ///< has the error bound of the attitude drift
  attitude,        ///< has the error bound of the attitudes
  ratio,           ///< relative error of the axis drift
  error,           ///< an error or its bound: of its size counts the order of magnitude
  conserved,       ///< change of an invariant
  input,           ///< known to rounding
  derived,         ///< of several numbers, to some digits
  time             ///< of an event, or of a growth
};
std::optional<Rule> rule_of(const std::string& name, FigureKind kind, const Tolerances& tolerances, bool same_computation);

}  // namespace earthtop::compare
