// SPDX-License-Identifier: GPL-3.0-or-later
/// Watches the integration of a run on a table: collects its events, and ends it at an event beyond which nothing is computed.
#pragma once

#include <algorithm>
#include <cmath>

#include "drift/table/contact_watch.hpp"

namespace earthtop {

/// Is thrown out of an integration that an event has ended.
struct ContactEnded {};

template <class T, class System>
class ContactRunWatch {
 public:
  ContactRunWatch(const System& system, const DriftProblem<T>& problem)
      : units_(problem.units), epsilon_(problem.model.epsilon), watch_(system, functions(problem), problem.fastest_rate) {}

  /// To be called with every step.   @throws ContactEnded if the run ends within it
  void operator()(T t, const typename System::State& x) {
    if (watch_.follow(t, x)) throw ContactEnded();
  }
  /// To be called with the outcome of the integration.   @returns the run's, which is not a failure where an event explains it
  RunStatus outcome(RunStatus status) {
    const bool failed = status == RunStatus::step_underflow || status == RunStatus::not_finite;
    return failed && watch_.see_jam() ? RunStatus::completed : status;
  }
  /// Appends the events, and leaves out samples beyond the one that has ended the run.
  void finish(DriftTrajectory<T>& trajectory) const {
    for (const ContactEvent& event : contact_events(watch_, epsilon_, units_)) trajectory.contact_events.push_back(event);
    if (!watch_.end()) return;
    const T end_s = real::scale(*watch_.end(), units_.time_exponent);
    while (trajectory.samples.size() > 1 && trajectory.samples.back().state.t_s > end_s) trajectory.samples.pop_back();
  }

 private:
  static ContactEventFunctions<T> functions(const DriftProblem<T>& problem) {
    const TableProblem<T>& table = *problem.table;
    ContactEventFunctions<T> made = contact_event_functions(problem.model, table.contact, table.start);
    if (table.max_tilt_rad < real::pi<double>()) made.least_cosine = real::cos(T(table.max_tilt_rad));
    if (table.static_coefficient) made.most_friction = T(*table.static_coefficient);
    return made;
  }

  const NaturalUnits& units_;
  T epsilon_;
  ContactWatch<T, System> watch_;
};

}  // namespace earthtop
