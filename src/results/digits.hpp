// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of extended precision as decimal digits, without a locale.
#pragma once

#include <string>

#include "earthtop/integrate/options.hpp"
#include "earthtop/real.hpp"

namespace earthtop {

/// A number of a run in `precision`: float128 with 34 significant digits, correctly rounded from the exact value (ties to
/// even), zeros at the end left out; long double and double in the shortest form that reads back to the same bits. Empty where
/// the value is not finite.
std::string digits(float128 value, Precision precision);

}  // namespace earthtop
