// SPDX-License-Identifier: GPL-3.0-or-later
/// How much each quantity may differ by, and why so much.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compare/row.hpp"
#include "earthtop/compare/compare.hpp"
#include "results/figures.hpp"

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

/// Whether figures of this kind are compared at all.
constexpr bool is_compared(FigureKind kind) { return kind != FigureKind::not_compared && kind != FigureKind::cost; }
/// Whether they are angles modulo 2 pi.
constexpr bool is_angle(FigureKind kind) { return kind == FigureKind::drift_azimuth || kind == FigureKind::drift_spin; }

std::optional<Rule> rule_of(const std::string& name, FigureKind kind, const Tolerances& tolerances, bool same_computation);

}  // namespace earthtop::compare
