// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows in a wider arithmetic, with which those of a run are compared.
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "run/rows.hpp"

namespace earthtop::testing {

struct TrueRun {
  std::vector<ExtendedDriftRow> rows;
  std::vector<ContactEvent> events;
};

template <class T>
TrueRun true_run(const Scene& scene, const DriftTrajectory<T>& trajectory) {
  const RowParts<T> parts(scene, trajectory.contact_events);
  TrueRun made;
  for (const DriftSample<T>& sample : trajectory.samples)
    made.rows.push_back(row_cast<float128>(make_row(sample, DriftBound<T>(0), parts)));
  made.events = trajectory.contact_events;
  return made;
}

/// @param rows  how many are integrated at most   @throws std::runtime_error if the integration does not complete
template <class T>
TrueRun integrate_truth(const Scenario& scenario, const IntegrationOptions& options, std::size_t rows = SIZE_MAX) {
  const Scene scene(scenario);
  DriftProblem<T> problem = scene.problem<T>();
  problem.times_s.resize(std::min(rows, problem.times_s.size()));
  const auto trajectory = integrate_drift(problem, options);
  if (trajectory.status != RunStatus::completed)
    throw std::runtime_error("no truth: " + std::string(to_string(trajectory.status)));
  return true_run(scene, trajectory);
}

/// A top on a table in the equations that a run by default does not integrate: in inertial axes, or in the laboratory's where the
/// run is in inertial ones; under the exact Coulomb law up to the stop of its slip, and in the laboratory's from there on.
/// @param rows  how many are integrated at most, as a run that an event has ended has fewer
/// @param extended  in 113 bits by extrapolation, or by Taylor series where that would take minutes; otherwise in 64 bits
/// @throws std::runtime_error if the integration does not complete
TrueRun truth_on_table(const Scenario& scenario, bool extended, std::size_t rows = SIZE_MAX);

}  // namespace earthtop::testing
