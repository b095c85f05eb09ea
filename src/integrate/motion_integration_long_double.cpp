// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/odeint_pow.hpp"  // first: it gives a name of the C library another meaning
//
#include "integrate/motion_integration.ipp"

namespace earthtop {
template MotionTrajectory<long double> integrate_motion(const MotionProblem<long double>&, const IntegrationOptions&,
                                                        MotionSought, const Watch&);
}  // namespace earthtop
