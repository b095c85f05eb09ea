// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run says beside its drift: how well the conserved quantities were kept, and first-order theory beside the numbers.
/// Invariants and ledger are computed from the rows in full: in float128 where the run is of extended precision. Who watches
/// may end them early; then they are not whole.
#pragma once

#include "earthtop/run.hpp"

namespace earthtop {

/// Jacobi integral and inertial spin along the rotating motion, the energy of the reference; none for a scene that does not
/// conserve them (platform, switched-off torques).
std::vector<InvariantReport> assess_invariants(const RunResult& result, const Watch& watch);

/// Leading-order predictions that fit the scene: fast top, free gyroscope, sleeping top.
std::vector<TheoryReport> assess_theory(const Scene& scene, const std::vector<DriftRow>& rows, const DriftSummary& drift);

/// The ledger of the rotating motion, for the observer whom the scenario names; none if it names none.
std::optional<LedgerReport> assess_ledger(const RunResult& result, const Watch& watch);

}  // namespace earthtop
