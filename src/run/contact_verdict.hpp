// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the drift of a top on a table can be trusted.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "run/followed_growth.hpp"

namespace earthtop {

/// The verdict on a run that needs no growth of disturbances: a motion beyond the onset of a slip is marginal, an integrable one and
/// that of a top which stands fast are reliable. None for the others.
/// @param result  its rows and the events of its contact are there
std::optional<VerdictReport> verdict_by_contact(const DriftProblem<double>& problem, const RunResult& result);

/// How disturbances grow along the non-rotating prediction, which the rotating motion stays next to. Friction takes most of them
/// away in the end.
/// @param log_round_off  natural logarithm of the growth at which rounding is too large
FollowedGrowth growth_on_table(const DriftProblem<double>& problem, const RunResult& result, double log_round_off,
                               const Watch& watch);

}  // namespace earthtop
