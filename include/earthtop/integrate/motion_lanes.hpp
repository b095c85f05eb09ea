// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates many motions of symmetric tops side by side: by the Taylor series of the reduced form, as `integrate_motion`
/// does, with one problem (a point) in each lane of the processor's vectors.
///
/// The result for a point depends on that point alone, to the last bit: not on its neighbours, its place among them, the number
/// of points or the instruction set.
#pragma once

#include <span>

#include "earthtop/integrate/instruction_set.hpp"
#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// Integrates each problem's motion from its release to its last output time.
/// @param options  `relative_tolerance` and `step_limit` control the integration; the limit of the work
/// (`stops_beyond_estimate`) is estimated from the other options. Observer and form are always laboratory and reduced.
/// @param set  the instruction set to use; none: the widest that there is
/// @returns one trajectory for each problem, in the same order
/// @throws std::logic_error for a model that has no reduced form, and for an instruction set that is not there.
std::vector<MotionTrajectory<double>> integrate_motion_in_lanes(std::span<const MotionProblem<double>> problems,
                                                                const IntegrationOptions& options,
                                                                MotionSought sought = MotionSought::attitude,
                                                                const Watch& watch = {},
                                                                std::optional<InstructionSet> set = std::nullopt);

}  // namespace earthtop
