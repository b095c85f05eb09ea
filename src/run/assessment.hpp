// SPDX-License-Identifier: GPL-3.0-or-later
/// Reports of a run besides its drift: how well the conserved quantities were kept, and predictions of first-order theory.
/// Invariants and ledger are computed from the rows in full precision: in float128 for a run in extended precision. The watch
/// may end them early; then they are incomplete.
#pragma once

#include "earthtop/run.hpp"

namespace earthtop {

/// Assesses the Jacobi integral and the inertial spin of the motion on the rotating Earth, and the energy of the reference
/// motion. The list is empty for a scene that does not conserve them (platform, switched-off torques).
std::vector<InvariantReport> assess_invariants(const RunResult& result, const Watch& watch);

/// Returns the leading-order predictions that apply to the scene: fast top, free gyroscope, sleeping top.
std::vector<TheoryReport> assess_theory(const Scene& scene, const std::vector<DriftRow>& rows, const DriftSummary& drift);

/// Returns by how much the rate of the azimuth drift may change beyond a time (rad/s), to first order: where precession and
/// nutation nearly agree, as in fast precession, the drift swings with the difference of the two, and a run that is shorter than
/// such a swing takes it for a trend. It is 0 for other tops, and where the body is not symmetric about axis 3.
double unseen_swings(const Scene& scene, double duration_s);

/// Returns the torque ledger of the motion on the rotating Earth, for the observer that the scenario names; empty without one.
std::optional<LedgerReport> assess_ledger(const RunResult& result, const Watch& watch);

}  // namespace earthtop
