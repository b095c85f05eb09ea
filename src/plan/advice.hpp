// SPDX-License-Identifier: GPL-3.0-or-later
/// What would make the first estimate's standard error smaller, and what first.
#pragma once

#include "plan/bound.hpp"

namespace earthtop::plan {

/// Fills in variations, changes and advice of a report whose numbers are determined.
/// @param density  the derivatives' rows are `density` times as many as the plan's   @param extent  and last so many times as
/// long   @param has_tilt  whether their last quantity is a tilt that the plan does not measure
struct Grid {
  std::size_t density = 1, extent = 1;
  bool has_tilt = false;
};
void compare_changes(PlanReport& report, const Derivatives& derivatives, const std::vector<double>& scales,
                     const std::vector<InputPrior>& priors, const Grid& grid, const Bound& bound);

}  // namespace earthtop::plan
