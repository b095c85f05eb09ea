// SPDX-License-Identifier: GPL-3.0-or-later
/// Many motions of symmetric tops side by side: `integrate_motion`'s Taylor series of the reduced form, a point in each lane
/// of the processor's vectors.
///
/// A point's result depends on it alone, to the last bit: not on its neighbours, on its place among them, on how many there
/// are, or on the instruction set.
#pragma once

#include <span>

#include "earthtop/integrate/instruction_set.hpp"
#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// @param options  of them `relative_tolerance` and `step_limit` are read
/// @param set  which instructions to take; none: the widest
/// @throws std::logic_error for a model that has no reduced form.
std::vector<MotionTrajectory<double>> integrate_motion_in_lanes(std::span<const MotionProblem<double>> problems,
                                                                const IntegrationOptions& options,
                                                                MotionSought sought = MotionSought::attitude,
                                                                const Watch& watch = {},
                                                                std::optional<InstructionSet> set = std::nullopt);

}  // namespace earthtop
