// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run of a top on a table tells about the contact.
#pragma once

#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"

namespace earthtop {

/// How far axis and tip of the non-rotating prediction move within `at_s` per 1 % of each coefficient of the contact's law, and
/// per arcsecond by which the table is tilted, in the direction that moves each of the two most. Empty if the integration does not
/// reach that time.
/// @param problem  has a table
std::vector<PredictionChange> prediction_changes(const DriftProblem<double>& problem, double at_s, const Watch& watch = {});

/// The report of a run whose rows are marked. Its changes are those at the last reliable row; under the exact Coulomb law at the
/// last row before a slip stops, since friction has no derivative there.
/// @param events  of both motions, ascending in time
ContactReport assess_contact(const RunResult& result, std::vector<ContactEvent> events, const Watch& watch);

}  // namespace earthtop
