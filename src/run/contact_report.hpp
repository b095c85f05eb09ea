// SPDX-License-Identifier: GPL-3.0-or-later
/// The report of a run of a top on a table about the contact.
#pragma once

#include <cmath>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/real.hpp"
#include "earthtop/run.hpp"

namespace earthtop {

/// How far axis and tip of the non-rotating prediction move within `at_s` per 1 % of each coefficient of the contact's law, and
/// per arcsecond by which the table is tilted, in the direction that moves each of the two most. Empty if the integration does not
/// reach that time.
/// @param problem  has a table
std::vector<PredictionChange> prediction_changes(const DriftProblem<double>& problem, double at_s, const Watch& watch = {});

/// Fills the changes in the report of a run whose events are known and whose rows are marked: at the last reliable row; under the
/// exact Coulomb law at the last one before a slip stops, since friction has no derivative there.
void assess_prediction_changes(RunResult& result, const Watch& watch);

/// The events of a run, with bounds on the errors of their times from the distance to those of the second integration.
/// @param safety  the factor of that distance
template <class T>
std::vector<ContactEvent> assess_contact_events(const DriftTrajectory<T>& first, const DriftTrajectory<T>& second, int safety) {
  std::vector<ContactEvent> events = first.contact_events;
  std::vector<bool> taken(second.contact_events.size());
  for (ContactEvent& event : events)
    for (std::size_t i = 0; i < taken.size(); ++i) {
      const ContactEvent& other = second.contact_events[i];
      if (taken[i] || other.kind != event.kind || other.prediction != event.prediction) continue;
      taken[i] = true;
      event.bound_s = safety * std::abs(other.t_s - event.t_s) + 1024 * real::epsilon<double>() * event.t_s;
      break;
    }
  return events;
}

}  // namespace earthtop
