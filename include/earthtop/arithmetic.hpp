// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks that the processor and the compiled code do IEEE 754 arithmetic as the standard prescribes: every digit of every
/// result relies on it.
#pragma once

#include <cfenv>
#include <stdexcept>
#include <string>

namespace earthtop {

/// The arithmetic is not IEEE 754 arithmetic as the results need it; `what()` says in which respect.
class ArithmeticError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// While it lives, no floating-point exception traps in the thread. In the end the thread's environment is as it was before,
/// flags included.
class NoTraps {
 public:
  NoTraps();
  ~NoTraps();
  NoTraps(const NoTraps&) = delete;
  NoTraps& operator=(const NoTraps&) = delete;

 private:
  std::fenv_t before_{};
};

/// Lists what is wrong with the arithmetic: floating-point exceptions trapped, rounding not to nearest, long double rounded to
/// fewer digits (x87's precision control), subnormal numbers flushed to zero, products contracted into sums, sums reassociated,
/// NaN or signed zeros not kept. Empty if nothing is wrong. The first four belong to the state of the calling thread, which
/// another library in the same process may have changed; the others to how earthtop was compiled.
std::string arithmetic_faults();

/// @throws ArithmeticError if `arithmetic_faults` finds any fault
void require_ieee_arithmetic();

}  // namespace earthtop
