// SPDX-License-Identifier: GPL-3.0-or-later
/// Tells what is known about a motion's stability without integrating anything: from closed forms and their limits.
#pragma once

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// Whether the motion has a closed form, or is so near one that the Earth cannot make it chaotic. It is if the body is free of
/// torque, or a symmetric top whose nutation is at least a hundred times as fast as the Earth's rotation. Such a motion may be
/// unstable, but it is not chaotic.
bool is_integrable(const MotionProblem<double>& problem);

/// Whether both motions are integrable and far from every separatrix, so that nothing in them grows faster than linearly with
/// the time. Such are a free body far from its middle axis, and a top symmetric about axis 3 that does not come near the
/// upright position with all its energy.
bool is_regular(const MotionProblem<double>& problem);
/// The same with friction, a tide or the gravity gradient acting on a top for a while, where these are so weak that the motion
/// stays next to regular ones: friction takes at most a quarter of the spin, with which the motion is still regular, and the
/// others could make a disturbance grow e-fold at most, whatever the resonance.
bool stays_regular(const MotionProblem<double>& problem, double duration_s);

/// An upright symmetric top.
struct UprightTop {
  double spin_ratio_squared;  ///< square of its spin over the critical one, (I3 w3)^2 / (4 m g l I1)
};
/// The top of this problem, if it is released upright (within a twentieth of a radian) and with a transverse rate of at most a
/// twentieth of sqrt(m g l / I1); none otherwise, and for other bodies.
std::optional<UprightTop> upright_top(const MotionProblem<double>& problem);
/// An upright top so near its critical spin, to a thousandth of the ratio, that whether it stands or falls depends on digits of
/// spin and moments that no experiment knows.
std::optional<UprightTop> marginal_top(const MotionProblem<double>& problem);

/// A symmetric top under gravity in some state of its motion; other torques may act as well.
struct StandingTop {
  double spin_ratio_squared;  ///< as in UprightTop
  double lean_rad;            ///< sine of the angle between its heavy side and Up; 2 where the heavy side hangs below
  double transverse_rate;     ///< natural units
  double falling_rate;        ///< sqrt(m g l / I1), natural units
};
/// The top in this state; none in a gimbal, where a platform accelerates the pivot, and for other bodies.
std::optional<StandingTop> standing_top(const Model<double>& model, const Quaternion<double>& q_LB, const Vec3<double>& w_IB_B);

}  // namespace earthtop
