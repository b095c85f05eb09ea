// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the times of a run's events can be off: of the threshold's passing, and of motions that come to rest. The error of
/// the drift, or of a rate, divided by how fast it changes there; no less than 1e-12 of the time.
#pragma once

#include "earthtop/drift/drift.hpp"
#include "run/assemble.hpp"

namespace earthtop {

/// Fills the summary's three members of the threshold.
/// @param safety  by how much the distance of the two integrations is multiplied
template <class T>
void assess_threshold(const TwoIntegrations<T>& made, double threshold_rad, int safety, DriftSummary& drift);

/// The stops of the first integration with their bounds.
template <class T>
std::vector<StopEvent> assess_stops(const TwoIntegrations<T>& made, int safety);

}  // namespace earthtop
