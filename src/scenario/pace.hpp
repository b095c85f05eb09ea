// SPDX-License-Identifier: GPL-3.0-or-later
/// What of a scenario decides how many steps its integrations take.
#pragma once

#include "earthtop/integrate/pace.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

Pace pace_of(const Scenario& scenario);

/// The friction that damps a motion most.
struct StiffFriction {
  std::string_view pointer = {};  ///< of the key that gives it; empty without friction
  double damping = 0;             ///< its rate's integral over the duration
};
StiffFriction stiffest_friction(const Scenario& scenario);

}  // namespace earthtop
