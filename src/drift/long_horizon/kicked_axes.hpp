// SPDX-License-Identifier: GPL-3.0-or-later
/// The axis of a fast symmetric top on which a further small torque acts: the motion of the long-horizon method, whose kicks
/// contain that torque as well.
#pragma once

#include <vector>

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// A small torque that depends on the axis and the time alone: of a gravity gradient, and of a uniform field.
struct AxisTorque {
  std::array<GradientTerm<double>, 2> gradient;
  TideSeries<double> tide;  ///< uniform, but varying in time; constant between two output times
  double tide_strength = 1;
};

/// Returns the axis at the problem's output times, in laboratory axes; fewer if the watch ends the walk.
/// @param problem  plain, of a top symmetric about body axis 3   @param steps  those that long_horizon found for the problem
/// @param earth_share  the factor by which the Earth's rate is multiplied; 0 gives the non-rotating prediction
std::vector<Vec3<double>> kicked_axes(const DriftProblem<double>& problem, const KickSteps& steps, double earth_share,
                                      const AxisTorque& torque, const Watch& watch = {});

}  // namespace earthtop
