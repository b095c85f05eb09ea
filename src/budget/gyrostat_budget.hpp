// SPDX-License-Identifier: GPL-3.0-or-later
/// The budget of a gyrostat: the torques of the Earth's rotation and of the rotor's bearing along the motion, and the drift of all together.
/// The share of a single effect in the drift is not known, as the variations that size it are those of a rigid body.
#pragma once

#include "earthtop/budget/budget.hpp"

namespace earthtop {

Budget gyrostat_budget(const Scene& scene, const Watch& watch);
/// Estimates the time (s) that it takes on one core.
double gyrostat_budget_seconds(const Scene& scene);

}  // namespace earthtop
