// SPDX-License-Identifier: GPL-3.0-or-later
/// How much an error that lasts has to do with the one before it.
#pragma once

#include <cmath>

#include "earthtop/elementary.hpp"

namespace earthtop::measure {

/// Two errors of an Ornstein-Uhlenbeck process, in their standard deviation: the later one is rho times the earlier one, and
/// something new whose standard deviation is `fresh`.
struct ErrorMemory {
  double rho = 0;    ///< exp(-dt / tau)
  double fresh = 1;  ///< sqrt(1 - rho^2)
};

/// @param elapsed_s  dt, at least 0 (s)   @param correlation_time_s  tau, above 0 (s)
inline ErrorMemory error_memory(double elapsed_s, double correlation_time_s) {
  const double parts = elapsed_s / correlation_time_s;
  return {real::exp(-parts), std::sqrt(-real::expm1(-2 * parts))};
}

}  // namespace earthtop::measure
