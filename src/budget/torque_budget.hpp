// SPDX-License-Identifier: GPL-3.0-or-later
/// The budget where the share of a single effect in the drift is not found: torques along the motion, and the drift of all together. It is that
/// of a body with moving parts, as the variations that size effects are those of one rigid body, and of a journey whose reference stays.
#pragma once

#include "earthtop/budget/budget.hpp"

namespace earthtop {

Budget torque_budget(const Scene& scene, const Watch& watch);
/// Estimates the time (s) that it takes on one core.
double torque_budget_seconds(const Scene& scene);

}  // namespace earthtop
