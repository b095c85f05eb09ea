/// What is known of a motion's stability without integrating anything: from closed forms and their limits.
#pragma once

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// Whether the non-rotating motion has a closed form: a free body, or a symmetric top. Such motions may be unstable, but none
/// is chaotic.
bool is_integrable(const Model<double>& model);

/// Whether both motions are such, and far from every separatrix: nothing in them grows faster than with the time. A free body
/// far from its middle axis, a top symmetric about axis 3 that does not come near the upright with all its energy.
bool is_regular(const MotionProblem<double>& problem);

/// An upright symmetric top: the square of its spin over the critical one, (I3 w3)^2 / (4 m g l I1), and the rate at which it
/// would fall without spin (rad/s).
struct UprightTop {
  double spin_ratio_squared;
  double falling_rate_1_s;
};
/// None for every other motion: unlike body or attitude, or a transverse rate of a twentieth of the falling rate.
std::optional<UprightTop> upright_top(const MotionProblem<double>& problem);

}  // namespace earthtop
