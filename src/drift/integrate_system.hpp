// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates one system of both motions and their deviation from the release to the last output time.
#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <type_traits>
#include <utility>

#include "drift/motion_way.hpp"
#include "drift/release_rates.hpp"
#include "drift/table/contact_run_watch.hpp"
#include "drift/watch/step_watcher.hpp"
#include "integrate/drive_problem.hpp"

namespace earthtop {

/// Notes what a driver counted.
template <class T, class Driver>
void note_steps(const Driver& driver, const DriftProblem<T>& problem, DriftTrajectory<T>& trajectory) {
  trajectory.counters.accepted += driver.counters().accepted;
  trajectory.counters.rejected += driver.counters().rejected;
  trajectory.counters.evaluations += driver.counters().evaluations;
  if (!trajectory.step_s && driver.first_step_taken() > T(0))
    trajectory.step_s = static_cast<double>(real::scale(driver.first_step_taken(), problem.units.time_exponent));
}

/// A system of a top on a table has events.
template <class System, class T>
concept HasContact = requires(const System& system, const typename System::State& x, T t) {
  system.contact_state(x, t);
};

/// Whether an integration leaves stops for later looks, and may begin at them: by series, which begin anywhere without a search for their
/// step, and where no friction may hold a motion at rest.
template <class T, class System>
bool leaves_stops(const DriftProblem<T>& problem, const IntegrationOptions& options) {
  if constexpr (!std::is_same_v<T, double> || HasContact<System, T>) return false;
  return problem.way && options.method == Method::taylor && problem.model.applied.coulomb == T(0);
}

/// A system that remembers what it has followed, and not only the states.
template <class System>
concept Remembers = requires(System& system) {
  system.go_on_from(system.followed());
};
struct NoMemory {};
template <class System>
auto memory_of(const System& system) {
  if constexpr (Remembers<System>)
    return system.followed();
  else
    return NoMemory{};
}

/// The stops of an integration by steps, by their times in natural units.
template <class System>
struct SteppedStops {
  struct Stop {
    typename System::State x;
    decltype(memory_of(std::declval<const System&>())) memory;
    StepWatcherTurns<double> turns;
  };
  std::map<double, Stop> at;
};

/// Integrates from the release, and leaves stops on the way. Looks begin at the last stop that is left before each of them.
template <class System>
void integrate_by_stops(const std::vector<double>& times, System& system, typename System::State x,
                        const DriftProblem<double>& problem, const DriveOptions<double>& drive,
                        StepWatcher<double, System>& watcher, DriftTrajectory<double>& trajectory) {
  constexpr double kMostStops = 2000;
  auto& stops = problem.way->template stops<SteppedStops<System>>().at;
  const double apart = problem.way->duration_from(times.back()) / kMostStops;
  const auto after = [&](double t) { return stops.upper_bound(t); };
  const auto begins_anew = [&](double before, double t) {
    return problem.are_looks && after(t) != stops.begin() && std::prev(after(t))->first >= before + apart;
  };
  double left_at = 0;
  std::vector<double> stretch;
  for (std::size_t row = 0; row < times.size() && trajectory.status == RunStatus::completed;) {
    stretch.clear();
    if (row > 0) {
      const auto& [t, stop] = *std::prev(after(times[row]));
      x = stop.x;
      if constexpr (Remembers<System>) system.go_on_from(stop.memory);
      watcher.go_on_from(stop.turns);
      stretch.push_back(t);
    }
    const std::size_t seen = stretch.size();  // a stop is no look
    do stretch.push_back(times[row++]);
    while (row < times.size() && !begins_anew(stretch.back(), times[row]));
    const auto on_row = [&](std::size_t i, const typename System::State& state) {
      if (i < seen) return;
      const double t = stretch[i], t_s = problem.times_s[trajectory.samples.size()];
      trajectory.samples.push_back(watcher.sample(state, t, t_s));
      if (t == 0) set_release_rates(problem, trajectory.samples.front().state);
      if (t - left_at < apart || !(problem.are_looks || std::ranges::binary_search(problem.way->leave_at_s, t_s))) return;
      stops.try_emplace(t, typename SteppedStops<System>::Stop{state, memory_of(system), watcher.turns()});
      left_at = t;
    };
    Driver<double, System, StepWatcher<double, System>, decltype(on_row)> driver(system, drive, watcher, on_row);
    trajectory.status = driver.run(x, stretch);
    note_steps(driver, problem, trajectory);
  }
}

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
  } else if (leaves_stops<T, System>(problem, options)) {
    if constexpr (std::is_same_v<T, double>) integrate_by_stops(row_times, system, x, problem, drive, watcher, trajectory);
  } else {
    Driver<T, System, decltype(watcher), decltype(on_row)> driver(system, drive, watcher, on_row);
    trajectory.status = driver.run(x, row_times);
    note_steps(driver, problem, trajectory);
  }
  trajectory.threshold = watcher.threshold();
  if constexpr (requires { watcher.events().events(); }) trajectory.gimbal_events = watcher.events().events();
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
