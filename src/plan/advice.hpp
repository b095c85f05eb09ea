// SPDX-License-Identifier: GPL-3.0-or-later
/// The advice says what would make the first estimate's standard error smaller, and what first.
#pragma once

#include "plan/bound.hpp"

namespace earthtop::plan {

/// How the derivatives' rows compare with the plan's.
struct Grid {
  std::size_t density = 1;  ///< this many times as many in the same time
  std::size_t extent = 1;   ///< they last this many times as long
  bool has_tilt = false;    ///< whether their last quantity is a tilt that the plan does not measure
};

/// Fills in variations, changes and advice of a report whose numbers are determined.
/// @param watch  may end the work early; what is left out then has no standard error
void compare_changes(PlanReport& report, const Derivatives& derivatives, const std::vector<double>& scales,
                     const std::vector<InputPrior>& priors, const Grid& grid, const Bound& bound, const Watch& watch);

}  // namespace earthtop::plan
