// SPDX-License-Identifier: GPL-3.0-or-later
/// What follows the two integrations of a run, however they were made: bounds, rows, verdict and all that is told beside them.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"

namespace earthtop {

/// Both integrations behind a run.
template <class T>
struct TwoIntegrations {
  IntegrationOptions options, other_options;
  IntegrationReport solution, certificate;
  DriftTrajectory<T> first, second;
};

/// From the problem of the rows to that of the second integration: nudged, and no further than the rows got.
/// @param nudge_units  units in the last place
template <class T>
void make_second(DriftProblem<T>& problem, const DriftTrajectory<T>& first, T nudge_units = T(8));

/// Fills a report but for its reason and its time.
template <class T>
void describe(const DriftProblem<T>& problem, const IntegrationOptions& options, const DriftTrajectory<T>& trajectory,
              Precision precision, IntegrationReport& report);

/// The result of a scene without a choice of effects or an accuracy to reach. Can be interrupted.
/// @param seconds, parts  what is left of the run's watch, and how it is shared out   @param partial  as in
/// RunOptions
template <class T>
RunResult assemble_result(const Scene& scene, const TwoIntegrations<T>& made, const RunSeconds& seconds, Parts parts,
                          bool partial = false);

}  // namespace earthtop
