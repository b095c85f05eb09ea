// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates one system of both motions and their deviation from the release to the last output time.
#pragma once

#include <algorithm>

#include "drift/release_rates.hpp"
#include "drift/step_watcher.hpp"
#include "integrate/drive_problem.hpp"

namespace earthtop {

/// @param largest_step  the longest time between two states that are seen; 0: no limit
template <class T, class System>
DriftTrajectory<T> integrate_system(System& system, typename System::State x, const DriftProblem<T>& problem,
                                    const IntegrationOptions& options, const Watch& watch, T largest_step) {
  const std::vector<T> times = natural_times(problem);
  DriveOptions<T> drive = drive_options(problem, options, watch);
  drive.largest_step = largest_step;

  DriftTrajectory<T> trajectory;
  trajectory.samples.reserve(times.size());
  StepWatcher<T, System> watcher(system, problem);
  const auto on_row = [&](std::size_t row, const typename System::State& state) {
    trajectory.samples.push_back(watcher.sample(state, times[row], problem.times_s[row]));
    if constexpr (requires { system.contact_state(state, times[row]); })
      trajectory.samples.back().contact = system.contact_state(state, times[row]);
    if (row == 0) set_release_rates(problem, trajectory.samples.front().state);
  };
  Driver<T, System, decltype(watcher), decltype(on_row)> driver(system, drive, watcher, on_row);
  trajectory.status = driver.run(x, times);
  trajectory.counters = driver.counters();
  trajectory.threshold = watcher.threshold();
  if constexpr (requires { system.stops(); }) {
    for (const auto& [prediction, t, slowing] : system.stops())
      trajectory.stops.push_back({prediction, static_cast<double>(real::scale(t, problem.units.time_exponent)),
                                  static_cast<double>(real::scale(slowing, -2 * problem.units.time_exponent))});
    std::ranges::sort(trajectory.stops, {}, &StopEvent::t_s);
  }
  if (driver.first_step_taken() > T(0))
    trajectory.step_s = static_cast<double>(real::scale(driver.first_step_taken(), problem.units.time_exponent));
  return trajectory;
}

}  // namespace earthtop
