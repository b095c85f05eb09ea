// SPDX-License-Identifier: GPL-3.0-or-later
/// What is known of a motion's stability without integrating anything: from closed forms and their limits.
#pragma once

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// Whether the motion is one with a closed form, or so near one that the Earth cannot make it chaotic: a free body; a symmetric
/// top whose nutation is a hundred times as fast as the Earth turns. Such motions may be unstable, but none is chaotic.
bool is_integrable(const MotionProblem<double>& problem);

/// Whether both motions are such, and far from every separatrix: nothing in them grows faster than with the time. A free body
/// far from its middle axis, a top symmetric about axis 3 that does not come near the upright with all its energy.
bool is_regular(const MotionProblem<double>& problem);

/// An upright symmetric top: the square of its spin over the critical one, (I3 w3)^2 / (4 m g l I1).
struct UprightTop {
  double spin_ratio_squared;
};
/// None for every other motion: unlike body or attitude, or a transverse rate of a twentieth of sqrt(m g l / I1).
std::optional<UprightTop> upright_top(const MotionProblem<double>& problem);
/// An upright top so near its critical spin, to a thousandth of the ratio, that whether it stands or falls hangs on digits of
/// spin and moments that no experiment knows.
std::optional<UprightTop> marginal_top(const MotionProblem<double>& problem);

/// A symmetric top under gravity in some state of its motion, other torques notwithstanding.
struct StandingTop {
  double spin_ratio_squared;  ///< as of an upright one
  double lean_rad;            ///< sine of the angle between its heavy side and Up; 2 where that hangs
  double transverse_rate;     ///< natural units
  double falling_rate;        ///< sqrt(m g l / I1), natural units
};
/// None in a gimbal, where a platform accelerates the pivot, and for other bodies.
std::optional<StandingTop> standing_top(const Model<double>& model, const Quaternion<double>& q_LB, const Vec3<double>& w_IB_B);

}  // namespace earthtop
