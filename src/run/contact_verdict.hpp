// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the drift of a top on a table can be trusted.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "run/followed_growth.hpp"

namespace earthtop {

/// How disturbances grow along the non-rotating prediction, which the rotating motion stays next to. Friction takes most of them
/// away in the end. @see SupportReports::growth
/// @param result  its rows and the events of its contact are there
GrowthFound growth_on_table(const DriftProblem<double>& problem, const RunResult& result, double log_round_off,
                            const Watch& watch);

}  // namespace earthtop
