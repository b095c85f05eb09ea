// SPDX-License-Identifier: GPL-3.0-or-later
/// A run's bounds held against more bits.
#pragma once

#include "earthtop/run.hpp"

namespace earthtop::testing {

/// The largest error up to the verdict's time, and the bound on it (rad).
struct BoundedError {
  double error = 0, bound = 0;
  /// Neither the error is below a hundredth of its bound nor is it beyond what anybody asks for.
  bool tight() const { return error < 1e-13 || error > 0.01 * bound; }
};

struct Coverage {
  Method method = Method::automatic;
  VerdictReport verdict;
  BoundedError axis, attitude;  ///< of the drift
  BoundedError states;          ///< of both attitudes themselves
  double used = 0;              ///< largest share of its bound that an error takes, of all three and every row
  double drift = 0;
  bool tight() const { return axis.tight() && attitude.tight(); }
};

/// What a run is held against: the same scene in 113 bits; or in 64 bits at their least tolerance, whose rounding is 2,048
/// times finer than a double's, in a hundredth of the time. Where an error comes near its bound by these, 113 bits decide:
/// closed forms in unstable scenes are better than any integration in 64.
enum class Truth { bits113, bits64 };

/// The run and the truth: the same scene by extrapolation of the general model in body axes in float128, or, where that would
/// take minutes, in long double, by Taylor series where the scene has them.
/// @throws std::runtime_error where either does not complete
Coverage bound_coverage(const Scenario& scenario, Truth truth = Truth::bits113);

}  // namespace earthtop::testing
