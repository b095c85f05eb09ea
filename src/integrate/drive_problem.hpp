// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the driver's options from a problem and the options asked for: converts to natural units, sets first and fixed steps.
#pragma once

#include <algorithm>
#include <iterator>

#include "integrate/inline_all.hpp"
#include "integrate/natural_times.hpp"
#include "integrate/odeint_driver.hpp"

namespace earthtop {

/// The work at which an integration of a problem is stopped.
template <class T>
WorkLimit work_limit(const MotionProblem<T>& problem, const IntegrationOptions& options) {
  if (!options.stops_beyond_estimate || !problem.pace.known()) return {};
  constexpr double kLeast = std::is_same_v<T, float128> ? 3e4 : 1e6;  // evaluations in about a second
  return work_limit_for(estimated_work(problem.pace, options, takes_reduced_form(problem.model, options)), kLeast);
}

template <class T>
DriveOptions<T> drive_options(const MotionProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  DriveOptions<T> drive;
  drive.method = options.method;
  drive.relative_tolerance = T(options.relative_tolerance);
  drive.first_step = T(0.02) / problem.fastest_rate;
  drive.fixed_step = options.step_s ? problem.units.time_from_s(T(*options.step_s)) : T(0.04) / problem.fastest_rate;
  drive.fixed_step_given = options.step_s.has_value();
  drive.composition = options.composition;
  drive.rate = problem.fastest_rate;
  drive.step_limit = options.step_limit;
  drive.limit = work_limit(problem, options);
  drive.watch = watch;
  const auto merge = [&](std::vector<T> joints) {
    std::ranges::sort(joints);
    std::vector<T> merged;
    std::ranges::set_union(drive.joints, joints, std::back_inserter(merged));
    merged.erase(std::unique(merged.begin(), merged.end()), merged.end());
    drive.joints = std::move(merged);
  };
  for (const PrescribedMotion<T>* motion : {&problem.model.platform.turn, &problem.model.rotor.drive})
    if (motion->table) merge(motion->table->joints());
  if (const auto& table = problem.model.applied.given.table) merge(table->joints());
  if (!problem.model.journey.empty()) merge(problem.model.journey.joints());
  for (const MovingMasses<T>* masses : {&problem.model.masses, &problem.model.gimbals.masses})
    if (masses->any()) merge(masses->joints());
  return drive;
}

}  // namespace earthtop
