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

/// A swing of the azimuth drift's rate with the small difference of precession and nutation.
struct SlowSwing {
  double rate_rad_s = 0;       ///< by how much the rate may swing, to first order; 0: there is no such swing
  double frequency_rad_s = 0;  ///< unsigned
};

/// Returns the swing that a run of this duration may take for a trend: where precession and nutation nearly agree, as in fast
/// precession, the drift swings with their difference, and the run may be shorter than such a swing. There is none for other tops,
/// and where the body is not symmetric about axis 3.
SlowSwing unseen_swing(const Scene& scene, double duration_s);

/// Returns the torque ledger of the motion on the rotating Earth, for the observer that the scenario names; empty without one.
std::optional<LedgerReport> assess_ledger(const RunResult& result, const Watch& watch);

}  // namespace earthtop
