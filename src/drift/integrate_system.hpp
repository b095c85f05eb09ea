// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates one system of both motions and their deviation from the release to the last output time.
#pragma once

#include <algorithm>
#include <memory>

#include "drift/release_rates.hpp"
#include "drift/table/contact_run_watch.hpp"
#include "drift/watch/step_watcher.hpp"
#include "integrate/drive_problem.hpp"

namespace earthtop {

/// Notes what a driver counted.
template <class T, class Driver>
void note_steps(const Driver& driver, const DriftProblem<T>& problem, DriftTrajectory<T>& trajectory) {
  trajectory.counters = driver.counters();
  if (driver.first_step_taken() > T(0))
    trajectory.step_s = static_cast<double>(real::scale(driver.first_step_taken(), problem.units.time_exponent));
}

/// A system of a top on a table has events.
template <class System, class T>
concept HasContact = requires(const System& system, const typename System::State& x, T t) {
  system.contact_state(x, t);
};

/// @param row_times  in natural units: of the release, or of another state at which the integration begins, then of the rows, and of
/// an end beyond the last row if there is one more   @param largest_step  the longest time between two states that are seen; 0: no
/// limit
template <class T, class System>
DriftTrajectory<T> integrate_system_at(const std::vector<T>& row_times, System& system, typename System::State x,
                                       const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch,
                                       T largest_step) {
  DriveOptions<T> drive = drive_options(problem, options, watch);
  drive.largest_step = largest_step;

  DriftTrajectory<T> trajectory;
  trajectory.samples.reserve(row_times.size());
  StepWatcher<T, System> watcher(system, problem);
  const auto on_row = [&](std::size_t row, const typename System::State& state) {
    if (row >= problem.times_s.size()) return;
    const T t = row_times[row];
    trajectory.samples.push_back(watcher.sample(state, t, problem.times_s[row]));
    if constexpr (HasContact<System, T>)
      trajectory.samples.back().contact = std::make_shared<const ContactDriftState<T>>(system.contact_state(state, t));
    if (row == 0 && t == T(0)) set_release_rates(problem, trajectory.samples.front().state);
  };
  if constexpr (HasContact<System, T>) {
    ContactRunWatch<T, System> events(system, problem);
    const auto on_step = [&](T t, const typename System::State& state) {
      watcher(t, state);
      events(t, state);
    };
    Driver<T, System, decltype(on_step), decltype(on_row)> driver(system, drive, on_step, on_row);
    try {
      trajectory.status = events.outcome(driver.run(x, row_times));
    } catch (const ContactEnded&) {
      if (trajectory.samples.empty()) on_row(0, x);  // the release itself has ended the run
      trajectory.status = RunStatus::completed;
    }
    note_steps(driver, problem, trajectory);
    events.finish(trajectory);
  } else {
    Driver<T, System, decltype(watcher), decltype(on_row)> driver(system, drive, watcher, on_row);
    trajectory.status = driver.run(x, row_times);
    note_steps(driver, problem, trajectory);
  }
  trajectory.threshold = watcher.threshold();
  if constexpr (requires { system.stops(); }) {
    for (const auto& [prediction, t, slowing] : system.stops())
      trajectory.stops.push_back({prediction, static_cast<double>(real::scale(t, problem.units.time_exponent)),
                                  static_cast<double>(real::scale(slowing, -2 * problem.units.time_exponent))});
    std::ranges::sort(trajectory.stops, {}, &StopEvent::t_s);
  }
  return trajectory;
}
template <class T, class System>
DriftTrajectory<T> integrate_system(System& system, typename System::State x, const DriftProblem<T>& problem,
                                    const IntegrationOptions& options, const Watch& watch, T largest_step) {
  return integrate_system_at(natural_times(problem), system, x, problem, options, watch, largest_step);
}

}  // namespace earthtop
