// SPDX-License-Identifier: GPL-3.0-or-later
/// Tolerances for the differences of quantities, with the reason for each.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compare/row.hpp"
#include "earthtop/compare/compare.hpp"
#include "results/figures.hpp"

namespace earthtop::compare {

/// A part of a quantity's size that rounding may change: thousands of roundings.
inline constexpr double kRoundingOfSize = 1e-12;
/// A part of the Earth's effect: a larger difference could hide the effect.
inline constexpr double kOfEffect = 1e-3;

/// A tolerance is the largest of: absolute; relative x the quantity's scale; effect x the Earth's effect on it; bounds x the
/// sum of both error bounds.
struct Rule {
  double absolute = 0, relative = 0, effect = 0, bounds = 0;
  std::string source;  ///< "profile regression", or the file
  double times = 0;    ///< if above 0, the only limit: the largest ratio of the two values, either way
  double beside = 0;   ///< x the size that a figure beside it states, as a lower limit: a value of zero has no size of its own
};

/// Whether two errors are of the same size: neither is more than `times` the other, or both are small beside `largest`.
bool are_of_one_size(double a, double b, double times, double largest);

/// A tolerance, and the part of its rule that decides it, in words.
struct Tolerance {
  double value = 0;
  std::string origin;
};

/// Writes the part of a tolerance that an interpolation adds.
std::string interpolation_words(double error);

/// The part of a tolerance that does not change from row to row: the largest of absolute, relative and effect.
double fixed_part(const Rule& rule, double scale, double effect);
/// The upper limit of a tolerance from error bounds, however large the stated bounds are: the Earth's effect, or where there is
/// none a tenth of the quantity's size. A larger tolerance would let every difference pass.
double largest_for_bounds(double scale, double effect);
/// The tolerance with all its parts, and its origin in words.
Tolerance tolerance_of(const Rule& rule, double scale, double effect, double errors);

/// The rule for a measure of the rows.
/// @param same_computation  whether the scenarios agree, numerics included, and the motion does not magnify rounding: then both
/// have the same errors, and only rounding should differ   @param effect  the Earth's effect on the measure, in its unit
/// @returns none where the profile does not compare the measure
std::optional<Rule> rule_of(const Measure& measure, const Tolerances& tolerances, bool same_computation, double effect);

/// Whether figures of this kind are compared at all.
constexpr bool is_compared(FigureKind kind) { return kind != FigureKind::not_compared && kind != FigureKind::cost; }
/// Whether figures of this kind are angles modulo 2 pi.
constexpr bool is_angle(FigureKind kind) { return kind == FigureKind::drift_azimuth || kind == FigureKind::drift_spin; }

std::optional<Rule> rule_of(const std::string& name, FigureKind kind, const Tolerances& tolerances, bool same_computation);

}  // namespace earthtop::compare
