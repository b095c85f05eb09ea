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
/// Those of a Cardan suspension.   @param looks  at the motion, and not its rows
std::vector<TheoryReport> assess_theory_of_journey(const Scene& scene, const std::vector<DriftRow>& looks,
                                                   const DriftSummary& drift);
std::vector<TheoryReport> assess_theory_of_gimbals(const Scene& scene, const std::vector<DriftRow>& looks,
                                                   const DriftSummary& drift);

/// The mean precession of a top with unequal moments across its axis, on which it spins: to first order in their difference it is that of a
/// symmetric top whose moment is the inverse of the mean of their inverses.
struct MeanPrecession {
  double moment_kg_m2 = 0;      ///< of that symmetric top
  double precession_rad_s = 0;  ///< without the Earth, counterclockwise about Up
  double change_rad_s = 0;      ///< by the Earth
  double left_out_rad_s = 0;    ///< size of what the theory leaves out of the change
};
/// @param scene  plain, with the centre of mass on body axis 3 and no products of inertia   @returns nothing where the axis is vertical, or the
/// moments are too different
std::optional<MeanPrecession> mean_precession_of_unequal_moments(const Scene& scene);

/// A swing of the azimuth drift's rate that is slower than the run.
struct SlowSwing {
  double rate_rad_s = 0;       ///< by how much the rate may swing; infinite where that is not known; 0: there is no such swing
  double frequency_rad_s = 0;  ///< unsigned
  double unseen = 1;           ///< how far the swing may be beyond what the windows of a fit leave open, as a factor
};

/// Returns the swing that a run of this duration may take for a trend. There is one where the precession is nearly a multiple of the
/// nutation, as in fast precession: the drift swings with the small difference, to first order in the Earth's rate. Where twice the
/// precession nearly is one, as for a pendulum, whose ellipse turns slowly, it does so to second order. In a body with three moments
/// it does where twice the spin is nearly the nutation.
SlowSwing unseen_swing(const Scene& scene, double duration_s);

/// Returns the torque ledger of the motion on the rotating Earth, for the observer that the scenario names; empty without one.
std::optional<LedgerReport> assess_ledger(const RunResult& result, const Watch& watch);

}  // namespace earthtop
