// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/odeint_pow.hpp"  // must come first: it redirects std::pow
//
#include "integrate/motion_integration.ipp"

namespace earthtop {
template MotionTrajectory<float80> integrate_motion(const MotionProblem<float80>&, const IntegrationOptions&, MotionSought,
                                                    const Watch&);
}  // namespace earthtop
