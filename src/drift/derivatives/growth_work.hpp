// SPDX-License-Identifier: GPL-3.0-or-later
/// The way in which the growth of disturbances is followed: the equations, and the least number of steps.
#pragma once

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// The fewest steps of a series, for a slope of the growth over the second half.
inline constexpr double kFewestGrowthSteps = 100;

/// Whether the equations of a motion have a Taylor series throughout: no friction has a corner on its way.
bool has_smooth_series(const MotionProblem<double>& problem, double duration_s);

}  // namespace earthtop
