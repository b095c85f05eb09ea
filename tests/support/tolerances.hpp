// SPDX-License-Identifier: GPL-3.0-or-later
/// Tolerances computed from what limits a comparison. A comparison that nothing of these limits gets a number, and beside it a
/// comment that says why.
#pragma once

#include "earthtop/real.hpp"

namespace earthtop::testing {

/// So many roundings, each of half a unit in the last place, all in one direction: for two ways to compute the same number in
/// `T`, which would agree in exact arithmetic. Relative to the largest number that is rounded; of a sum that cancels, to its
/// terms. A share of one operation is for what other numbers in `T` are held against.
template <class T = double>
constexpr double rounding(double operations) {
  return operations * static_cast<double>(real::epsilon<T>()) / 2;
}

/// What an integration or a series leaves in which each step is held to this tolerance, if the errors of all steps add up. The
/// tolerance is that which was asked for, by its name.
constexpr double truncation(double tolerance, double steps = 1) { return steps * tolerance; }

/// Half a unit in the last of so many significant digits of a printed number of order `scale`: for values from the literature
/// and from other programs.
constexpr double reference(int digits, double scale = 1) {
  double half = 0.5 * scale;
  for (int i = 1; i < digits; ++i) half /= 10;
  return half;
}

static_assert(rounding(2) == 0x1p-52 && rounding<float128>(2) == 0x1p-112 && reference(3) == 0.005 && truncation(0.5, 4) == 2);

}  // namespace earthtop::testing
