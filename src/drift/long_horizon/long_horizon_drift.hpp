// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift by the long-horizon method (long_horizon.hpp): the reference by its closed form, the rotating motion by exact
/// flows and kicks, and their deviation without cancellation.
///
/// Where the drift is large, the deviation is taken from the two attitudes, without the spin that they share. Where it is
/// small, that difference would lose its digits. But the deviation divided by epsilon is a smooth function of the Earth's rate.
/// So it is found for four rates so much larger that the drift is some thousandths of a radian, and a cubic through the four
/// gives it for the rate asked for, however small that is.
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// @throws std::logic_error for a model that is not a top symmetric about body axis 3
DriftTrajectory<double> long_horizon_drift(const DriftProblem<double>& problem, const IntegrationOptions& options,
                                           const Watch& watch);

}  // namespace earthtop
