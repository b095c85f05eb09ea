// SPDX-License-Identifier: GPL-3.0-or-later
/// The steps after the two integrations of a run, however these were made: bounds, rows, verdict and all further reports.
#pragma once

#include <optional>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "run/looks.hpp"

namespace earthtop {

/// The two integrations of a run.
template <class T>
struct TwoIntegrations {
  IntegrationOptions options, other_options;
  IntegrationReport solution, certificate;
  DriftTrajectory<T> first, second;
  LookPlan plan;
  Looks looks;  ///< of the first integration; the second has those for rows and judgement
  std::shared_ptr<MotionWay> way = LookMemory::new_way();  ///< what the first integration and looks leave for later looks

  std::optional<OutputTimes> all_rows;  ///< where the scene of the integrations has only a few of the run's rows

  LookMemory memory() const { return {first.kick_steps, way}; }
};

/// Sets the times of the first integration, those of the rows and of all other looks that it can take.
/// @param between  as in RunOptions
template <class T>
void plan_first(const Scene& scene, bool between, TwoIntegrations<T>& made, DriftProblem<T>& problem);

/// Turns the first integration's problem into that of the second one: nudged, with those looks alone that are compared, and ending
/// where the first one ended.
/// @param count  of the looks that the first integration has taken   @param first  the options of that integration
/// @param nudge_units  size of the nudge (units in the last place); as drift_bound.hpp has it if not given
template <class T>
void make_second(DriftProblem<T>& problem, const Looks& looks, std::size_t count, const IntegrationOptions& first,
                 std::optional<double> nudge_units = {});

/// Fills a report except for its reason and its time.
template <class T>
void describe(const DriftProblem<T>& problem, const IntegrationOptions& options, const DriftTrajectory<T>& trajectory,
              Precision precision, IntegrationReport& report);

/// Makes the result of a run from its integrations, without the choice of effects and the accuracy. It can be interrupted.
/// @param seconds, parts  estimated times of the phases, and the rest of the run's progress that they share
/// @param options  of which `partial` and `between` are read
template <class T>
RunResult assemble_result(const Scene& scene, TwoIntegrations<T> made, const RunSeconds& seconds, Parts parts,
                          const RunOptions& options = {});

}  // namespace earthtop
