// SPDX-License-Identifier: GPL-3.0-or-later
/// The way in which the growth of disturbances is followed: the equations, and the least number of steps.
#pragma once

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// The fewest steps of a series, for a slope of the growth over the second half.
inline constexpr double kFewestGrowthSteps = 100;

/// Whether a motion is that of a driven symmetric top or of a compass, with equations that have a Taylor series throughout.
bool has_spinless_series(const MotionProblem<double>& problem, double duration_s);

}  // namespace earthtop
