// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of integrate_contact; each of contact_integration_*.cpp instantiates it for one scalar.
#pragma once

#include <stdexcept>

#include "drift/integrate_system.hpp"
#include "drift/table/contact_general_drift.hpp"
#include "drift/table/contact_integration.hpp"
#include "drift/table/contact_reduced_drift.hpp"
#include "drift/table/contact_stop_integration.hpp"

namespace earthtop {
namespace {

template <class T, Observer O>
DriftTrajectory<T> integrate_on_table(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  const TableProblem<T>& table = *problem.table;
  if (is_symmetric(table.contact) && options.form != ModelForm::general) {
    ContactReducedDrift<T, O> system(problem.model, table.contact, table.start, problem.natural_release());
    return integrate_system(system, system.initial_state(), problem, options, watch, system.largest_step());
  }
  ContactGeneralDrift<T, O> system(problem.model, table.contact, table.start, problem.natural_release());
  // Both motions may turn at the fastest rate, and the angle between them must change by less than half a turn between two looks.
  const T largest_step = row_of(options.method).cost.is_watched ? T(1.5) / problem.fastest_rate : T(0);
  return integrate_system(system, system.initial_state(), problem, options, watch, largest_step);
}

}  // namespace

template <class T>
DriftTrajectory<T> integrate_contact(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  // The clock of the slip exists for the reduced form in laboratory axes; a second integration differs by its tolerance.
  if (has_exact_coulomb(problem.table->contact)) {
    if (!is_symmetric(problem.table->contact))
      throw std::logic_error("the exact Coulomb law is integrated for symmetric bodies only");
    return integrate_to_stop_and_on(problem, options, watch);
  }
  switch (options.observer) {
    case Observer::laboratory: return integrate_on_table<T, Observer::laboratory>(problem, options, watch);
    case Observer::inertial: return integrate_on_table<T, Observer::inertial>(problem, options, watch);
    case Observer::body: break;
  }
  throw std::logic_error("a top on a table is not integrated in body axes");
}

}  // namespace earthtop
