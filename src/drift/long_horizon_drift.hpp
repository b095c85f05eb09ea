// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift by the long-horizon method: both motions by closed forms, and their deviation without cancellation.
///
/// Where the drift is large, it is the quaternion of the two attitudes, the spin they share left out. Where it is small, a
/// difference would lose its digits: the deviation over epsilon, a smooth function of the Earth's rate, is then taken at four
/// rates so much larger that the drift is some thousandths of a radian, and a cubic through them gives it at the rate asked
/// for, however small that is.
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// @throws std::logic_error for a model that is not a top symmetric about body axis 3
DriftTrajectory<double> long_horizon_drift(const DriftProblem<double>& problem, const IntegrationOptions& options,
                                           const Watch& watch);

}  // namespace earthtop
