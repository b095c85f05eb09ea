// SPDX-License-Identifier: GPL-3.0-or-later
/// Conversion of numbers of extended precision to decimal text, independent of the locale.
#pragma once

#include <string>

#include "earthtop/integrate/options.hpp"
#include "earthtop/real.hpp"

namespace earthtop {

/// The decimal text of a number from a run in `precision`: for float128 34 significant digits, correctly rounded from the exact
/// value (ties to even), zeros at the end left out; for float80 and double the shortest form that reads back to the same
/// bits. Empty where the value is not finite.
std::string digits(float128 value, Precision precision);

}  // namespace earthtop
