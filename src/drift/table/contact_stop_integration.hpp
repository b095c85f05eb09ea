// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates the drift of a symmetric top under the exact Coulomb law: it slides to the stop of its slip, and rolls on.
#pragma once

#include <cmath>
#include <utility>

#include "drift/integrate_system.hpp"
#include "drift/table/contact_stop.hpp"

namespace earthtop {

/// Appends what a later part of a run has given; its first sample, at which it began, is left out.
template <class T>
void append_part(DriftTrajectory<T>&& part, DriftTrajectory<T>& whole) {
  whole.status = part.status;
  for (std::size_t i = 1; i < part.samples.size(); ++i) whole.samples.push_back(std::move(part.samples[i]));
  whole.counters.accepted += part.counters.accepted, whole.counters.rejected += part.counters.rejected;
  whole.counters.evaluations += part.counters.evaluations;
  for (const ContactEvent& event : part.contact_events) whole.contact_events.push_back(event);
  if (part.threshold) whole.threshold = part.threshold;
}

/// In laboratory axes.   @param problem  has a table and the exact Coulomb law, and a symmetric body
template <class T>
DriftTrajectory<T> integrate_to_stop_and_on(const DriftProblem<T>& problem, const IntegrationOptions& options,
                                            const Watch& watch) {
  using Drift = ContactReducedDrift<T, Observer::laboratory>;
  constexpr double kLeftOut = 1e-4;  // of the time to the stop, just before it, is not watched for other events
  const TableProblem<T>& table = *problem.table;
  Drift drift(problem.model, table.contact, table.start, problem.natural_release());
  const std::vector<T> times = natural_times(problem);
  const T tolerance = T(std::max(options.relative_tolerance, 64 * static_cast<double>(real::epsilon<T>())));
  const auto stop = slide_to_stop(drift, drift.initial_state(), times.back(), tolerance, watch);
  const T epsilon = problem.model.epsilon;
  const auto seconds = [&](T t) { return real::scale(t, problem.units.time_exponent); };

  // The part that slides: the rows before both stops.
  DriftTrajectory<T> whole;
  std::size_t rows = times.size();
  if (stop)
    for (rows = 1; rows < times.size() && times[rows] < std::min(stop->time.ref, stop->time.rot);) ++rows;
  DriftProblem<T> part = problem;
  part.times_s.assign(problem.times_s.begin(), problem.times_s.begin() + static_cast<std::ptrdiff_t>(rows));
  std::vector<T> part_times(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(rows));
  const bool slides = !stop || stop->time.ref > T(0);
  if (slides) {
    if (stop) part_times.push_back(std::max(part_times.back(), T(T(1 - kLeftOut) * std::min(stop->time.ref, stop->time.rot))));
    if (part_times.size() > 1 && part_times[part_times.size() - 2] == part_times.back()) part_times.pop_back();
    whole = integrate_system_at(part_times, drift, drift.initial_state(), part, options, watch, drift.largest_step());
    if (whole.status == RunStatus::step_underflow && options.method == Method::taylor) {
      // Where the direction of a small slip turns fast, a series may hold for less than the least step.
      IntegrationOptions other = options;
      other.method = Method::extrapolation;
      Drift again(problem.model, table.contact, table.start, problem.natural_release());
      whole = integrate_system_at(part_times, again, again.initial_state(), part, other, watch, again.largest_step());
    }
    if (!stop || whole.status != RunStatus::completed) return whole;
    for (const ContactEvent& event : whole.contact_events)
      if (ends_run(event.kind)) return whole;
    const double difference = static_cast<double>(seconds(T(epsilon * stop->time.diff)));
    ContactEvent stops[2] = {{ContactEventKind::slip_stopped, Prediction::reference,
                              static_cast<double>(seconds(stop->time.ref)), difference, std::nullopt},
                             {ContactEventKind::slip_stopped, Prediction::rotating,
                              static_cast<double>(seconds(stop->time.rot)), difference, std::nullopt}};
    if (difference < 0) std::swap(stops[0], stops[1]);
    whole.contact_events.insert(whole.contact_events.end(), stops, stops + 2);
  }

  // The part that rolls: friction may not exceed its greatest.
  ContactRolledOn<T> rolling(drift, *stop);
  part = problem;
  part.table->static_coefficient = static_cast<double>(table.contact.coefficient);
  if (slides) {
    if (whole.threshold && whole.threshold->passing) part.threshold_rad.reset();
    part.times_s.assign(1, static_cast<double>(seconds(stop->time.ref)));
    part_times.assign(1, stop->time.ref);
    for (std::size_t i = rows; i < times.size(); ++i)
      part.times_s.push_back(problem.times_s[i]), part_times.push_back(times[i]);
    // A row between the two stops is shown as if the reference had rolled since: it is marked.
    for (T& t : part_times) t = std::max(t, stop->time.ref);
  } else {
    part_times = times;
  }
  DriftTrajectory<T> on =
      integrate_system_at(part_times, rolling, rolling.initial_state(), part, options, watch, rolling.largest_step());
  if (!slides) return on;
  append_part(std::move(on), whole);
  return whole;
}

}  // namespace earthtop
