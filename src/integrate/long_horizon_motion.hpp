// SPDX-License-Identifier: GPL-3.0-or-later
/// A single motion by the long-horizon method (long_horizon.hpp).
#pragma once

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// @throws std::logic_error for a model that is not a top symmetric about body axis 3
MotionTrajectory<double> long_horizon_motion(const MotionProblem<double>& problem, const IntegrationOptions& options,
                                             const Watch& watch);

}  // namespace earthtop
