// SPDX-License-Identifier: GPL-3.0-or-later
/// The derivatives of a drift by the inputs of its scene, from the drifts of scenes in which one input is a little larger or
/// smaller. Each drift is computed without cancellation, so that few digits of it are lost in a difference.
#pragma once

#include <optional>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop {

/// Bounds on the errors of a drift's axis and attitude (rad).
struct DriftBounds {
  double axis = 0, attitude = 0;
};

/// Computes central differences whose steps decrease by 4 and extrapolates them to a step of 0 [C. J. F. Ridders, Adv. Eng.
/// Software 4 (1982) 75], until the two last extrapolations differ by less than the drift's own error makes of them. One more
/// difference, with a step that the fastest of the motion's angles resolves, tells what the larger steps have averaged out.
/// @param time_s  time of the drift (s)   @param bounds  on the errors of the drifts at that time
/// @returns a report's entries, for all inputs of the scene; none where the watch asks to stop. An input has no derivative where
/// differences do not settle, and where a scene with a changed input cannot be run to that time.
std::optional<std::vector<InputSensitivity>> difference_sensitivities(const Scene& scene, double time_s,
                                                                      const DriftBounds& bounds, const Watch& watch);

}  // namespace earthtop
