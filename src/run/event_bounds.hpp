// SPDX-License-Identifier: GPL-3.0-or-later
/// Error bounds of the times of a run's events: when the drift passes the threshold, and when a motion comes to rest. The bound
/// is the error of the drift, or of a rate, divided by its rate of change there; it is at least 1e-12 of the time.
#pragma once

#include "earthtop/drift/drift.hpp"
#include "run/assemble.hpp"

namespace earthtop {

/// Fills the three members of the summary that concern the threshold.
/// @param safety  factor that multiplies the distance of the two integrations
template <class T>
void assess_threshold(const TwoIntegrations<T>& made, double threshold_rad, int safety, DriftSummary& drift);

/// Returns the stops of the first integration with their bounds.
template <class T>
std::vector<StopEvent> assess_stops(const TwoIntegrations<T>& made, int safety);

/// Returns the events of a suspension of the first integration with their bounds.
template <class T>
std::vector<GimbalEvent> assess_gimbal_events(const TwoIntegrations<T>& made, int safety);

}  // namespace earthtop
