// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks what a top on a table conserves, along both predictions of a run, and its torque ledger.
#pragma once

#include <array>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"

namespace earthtop {

/// Assesses the Jacobi integral and the inertial spin of the motion on the rotating Earth, and the energy, Jellett's and Routh's
/// integrals of the reference motion: each only where the scene conserves it exactly, so the list may be empty.
/// @param scene  must have a contact   @param rows  number of samples that are rows of the result
template <class T>
std::vector<InvariantReport> assess_contact_invariants(const Scene& scene, const std::vector<DriftSample<T>>& samples,
                                                       std::size_t rows, const Watch& watch);

/// Returns the balances of both motions from the release to the last row, of the rotating motion first.
/// @param scene  must have a contact   @param rows  number of samples that are rows of the result
template <class T>
std::array<ContactBalances, 2> assess_contact_balances(const Scene& scene, const std::vector<DriftSample<T>>& samples,
                                                       std::size_t rows);

/// Returns the torque ledger of the motion on the rotating Earth, about the centre of the tip's sphere, for the observer that the
/// scenario names; empty without one.
/// @param scene  must have a contact   @param rows  number of samples that are rows of the result
template <class T>
std::optional<LedgerReport> assess_contact_ledger(const Scene& scene, const std::vector<DriftSample<T>>& samples,
                                                  std::size_t rows, const Watch& watch);

}  // namespace earthtop
