// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates many drifts side by side: by the Taylor series of symmetric tops without their spin, or by those of any body,
/// with one problem (a point) in each lane of the processor's vectors. Where more acts than gravity and the Earth's rotation, the series
/// are those of recorded equations; a point whose equations branch otherwise than at its release is integrated by itself.
///
/// The result for a point depends on that point alone, to the last bit: not on its neighbours, its place among them, the number
/// of points or the instruction set.
#pragma once

#include <span>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/integrate/instruction_set.hpp"

namespace earthtop {

/// Integrates both motions and their deviation of each problem, from its release to its last output time. All problems are plain, or none
/// is; all have a wheel in a gimbal, or none has. A pivot has no dry friction.
/// @param options  `form` (general: any body; otherwise reduced), `observer` (laboratory for the reduced form, body for the
/// general one; inertial for either, which gives the same drift by other equations), `relative_tolerance` and `step_limit`
/// control the integration; the limit of the work (`stops_beyond_estimate`) is estimated from the other options.
/// @param watch  may end the integrations early, with RunStatus::interrupted
/// @param set  the instruction set to use; none: the widest that there is
/// @returns one trajectory for each problem, in the same order
/// @throws std::logic_error for a model that does not have the form, for an observer for whom the form has no series, for
/// problems of several kinds, and for an instruction set that is not there.
std::vector<DriftTrajectory<double>> integrate_drift_in_lanes(std::span<const DriftProblem<double>> problems,
                                                              const IntegrationOptions& options, const Watch& watch = {},
                                                              std::optional<InstructionSet> set = std::nullopt);

}  // namespace earthtop
