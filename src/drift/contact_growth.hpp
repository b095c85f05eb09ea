// SPDX-License-Identifier: GPL-3.0-or-later
/// How far small disturbances of a top on a table grow. Friction takes them away in the end, and the precession shears them apart
/// in proportion to the path of the axis; while a tippe top turns over, they grow far beyond that, and then come back.
#pragma once

#include <optional>

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Growth of the change of axis and spin (over the spin at release), of three disturbances of attitude and rates that belong to no
/// symmetry; the largest counts. Regular motions let it grow to 1 + s, where s is the path of the axis on the unit sphere, and less
/// than twice that (toy tops under every law: 1.7).
struct ContactGrowth {
  std::optional<double> above_s;  ///< when it first exceeded kRegularContactGrowth (1 + s); none if it did not
  std::optional<double> again_s;  ///< from when on it no longer did; none if it did so to the end
  double largest = 0;             ///< growth at most
  double largest_ratio = 0;       ///< the same over 1 + s
  double end_s = 0;               ///< time reached
  bool completed = false;
  StepCounters counters;
};

inline constexpr double kRegularContactGrowth = 4;
/// Growth matters to a few percent.
inline constexpr double kContactGrowthTolerance = 1e-7;

/// Along the non-rotating prediction, which the rotating motion stays next to.
/// @param problem  has a table   @param watch  may end the integration early
ContactGrowth contact_growth(const DriftProblem<double>& problem, double duration_s,
                             double relative_tolerance = kContactGrowthTolerance, const Watch& watch = {});

}  // namespace earthtop
