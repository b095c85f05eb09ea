// SPDX-License-Identifier: GPL-3.0-or-later
/// Many drifts side by side: Taylor series of symmetric tops without their spin, or of any body, a point in each lane of the
/// processor's vectors.
///
/// A point's result depends on it alone, to the last bit: not on its neighbours, on its place among them, on how many there
/// are, or on the instruction set.
#pragma once

#include <span>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/integrate/instruction_set.hpp"

namespace earthtop {

/// @param options  of them `form` (general: any body; else reduced), `observer` (reduced: laboratory; general: body; or
/// inertial: other equations for the same drift), `relative_tolerance` and `step_limit` are read
/// @param watch  may end it early with RunStatus::interrupted
/// @param set  which instructions to take; none: the widest
/// @throws std::logic_error for a model that does not have the form, and for other axes.
std::vector<DriftTrajectory<double>> integrate_drift_in_lanes(std::span<const DriftProblem<double>> problems,
                                                              const IntegrationOptions& options, const Watch& watch = {},
                                                              std::optional<InstructionSet> set = std::nullopt);

}  // namespace earthtop
