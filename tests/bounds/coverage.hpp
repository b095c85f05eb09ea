// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares the error bounds of a run with its true errors, computed in a wider arithmetic.
#pragma once

#include <algorithm>

#include "bounds/table_truth.hpp"
#include "earthtop/run.hpp"

namespace earthtop::testing {

/// The largest error up to the verdict's time, and the bound on it (rad).
struct BoundedError {
  double error = 0, bound = 0;
};

/// The truth is not exact either: where a gimbal holds a wheel that does not drift at all, it drifts by the rounding of 113 bits.
inline constexpr double kTruthError = 5e-24;  // rad

struct Coverage {
  Method method = Method::automatic;
  VerdictReport verdict;
  BoundedError axis, attitude;  ///< the drift's
  BoundedError states;          ///< the two attitudes' own
  BoundedError tip;             ///< the drift of a tip on a table (m)
  BoundedError event;           ///< time of an event on a table (s), that of the largest share of its bound
  double used = 0;              ///< largest ratio of an error to its bound, over all of these and all rows
  double drift = 0, tip_drift = 0;
  double round_off = 0;  ///< 1024 eps of the largest drift of the attitude, which no bound goes below (rad)
  int rows = 0;          ///< that were judged
  /// Whether the bound of the drift is close: no more than a hundred times what there is to bound, which is the error, the round-off
  /// of the drift, or the error of the truth. The attitude's bound is never below that of the axis.
  bool close() const {
    constexpr double kClose = 100;
    return attitude.bound <= kClose * std::max({axis.error, attitude.error, round_off, kTruthError});
  }
};

/// Compares the rows of a run that are marked as reliable, and its events, with the truth.
Coverage coverage_of(const RunResult& result, const TrueRun& truth);

/// The solution with which a run is compared: the same scene in 113 bits, or in 64 bits at the least tolerance. The rounding of
/// 64 bits is 2,048 times finer than a double's, and they take a hundredth of the time that 113 bits take. If an error comes
/// near its bound by this measure, 113 bits have to decide, because closed forms in unstable scenes are more exact than any
/// integration in 64 bits.
enum class Truth { bits113, bits64 };

/// Runs the scene, and computes the truth by extrapolation of the general model in body axes in float128; where that would take
/// minutes, in long double, by Taylor series if the scene has them. A run in the laboratory's axes on a table is compared with
/// equations in inertial axes; under the exact Coulomb law, up to the stop of its slip.
/// @throws std::runtime_error if either does not complete
Coverage bound_coverage(const Scenario& scenario, Truth truth = Truth::bits113);

}  // namespace earthtop::testing
