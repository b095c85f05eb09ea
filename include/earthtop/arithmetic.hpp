// SPDX-License-Identifier: GPL-3.0-or-later
/// What every digit rests on: IEEE 754 arithmetic as the standard has it, in the machine's present state and in the compiled
/// code.
#pragma once

#include <stdexcept>
#include <string>

namespace earthtop {

/// The processor computes otherwise than the digits need. Says how.
class ArithmeticError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What is wrong with the arithmetic: rounding not to nearest, subnormal numbers flushed to zero, products contracted into
/// sums, sums reassociated, NaN or signed zeros not kept. Empty where nothing is. The first two are the thread's state, which a
/// library loaded beside may have changed; the others how earthtop was compiled.
std::string arithmetic_faults();

/// @throws ArithmeticError where `arithmetic_faults` finds any
void require_ieee_arithmetic();

}  // namespace earthtop
