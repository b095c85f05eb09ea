// SPDX-License-Identifier: GPL-3.0-or-later
/// The way in which the growth of disturbances is followed: the equations, and the least number of steps.
#pragma once

#include "earthtop/drift/growth.hpp"
#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// The fewest steps of a series, for a slope of the growth over the second half.
inline constexpr double kFewestGrowthSteps = 100;

/// The tolerance of the series by which growth is followed at a relative tolerance. The last terms of a series are a ten-thousandth of its
/// tolerance (taylor_stepper.hpp), as digits of a motion need; growth needs no more than that they are the tolerance, as the errors of
/// embedded steps are. A motion that is followed closely, to stay near a separatrix, keeps all that a series gives.
inline double growth_series_tolerance(double relative_tolerance) {
  return relative_tolerance < kConfirmingGrowthTolerance ? relative_tolerance : 1e4 * relative_tolerance;
}

/// Whether the equations of a motion have a Taylor series throughout: no friction has a corner on its way.
bool has_smooth_series(const MotionProblem<double>& problem, double duration_s);

}  // namespace earthtop
