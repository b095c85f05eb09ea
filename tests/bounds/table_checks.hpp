// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks of runs on a table over random scenes beside those of the bounds against a wider arithmetic.
#pragma once

#include "drift/derivatives/contact_growth.hpp"
#include "earthtop/run.hpp"

namespace earthtop::testing {

/// The distance between two runs of a scene that integrate the laboratory's and the inertial equations, in double and by the default
/// method: the largest distance over the larger of the two bounds, over all rows that both mark as reliable.
struct Agreement {
  double axis = 0, attitude = 0, tip = 0;
  int rows = 0;
  double largest() const { return std::max({axis, attitude, tip}); }
};
Agreement agreement(const Scenario& scenario);

/// The growth of disturbances as the verdict estimates it, and that of changes of the start by 1e-6 rad, and as large a share of
/// the rate, in the same three directions, each followed in the non-rotating prediction.
struct GrowthCheck {
  ContactGrowth estimate;
  double largest = 0;        ///< followed
  double largest_ratio = 0;  ///< the same over 3 + the path of the axis
};
/// @param scenario  without the exact Coulomb law
GrowthCheck growth_check(const Scenario& scenario);

}  // namespace earthtop::testing
