// SPDX-License-Identifier: GPL-3.0-or-later
/// The verdict on a run's drift: whether it can be trusted, and until when.
#pragma once

#include <span>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "run/followed_growth.hpp"
#include "run/looks.hpp"

namespace earthtop {

/// Follows the growth of disturbances along both motions of a run, where closed forms do not already say that nothing grows exponentially.
/// @param watch  may end it early; the verdict then rests on what is known so far
GrowthFound growth_of(const RunResult& result, const Watch& watch);

/// Judges a run by its looks for judgement and their bounds, and by the growth of disturbances.
VerdictReport assess_verdict(const RunResult& result, std::span<const JudgedLook> judged, const GrowthFound& found);

/// The growth of disturbances along both motions of a body on a pivot. @see SupportReports::growth
GrowthFound growth_on_pivot(const DriftProblem<double>& problem, const RunResult& result, double log_round_off,
                            const Watch& watch);

/// The verdict on a run that was not judged.
VerdictReport not_judged(std::string reason);

/// Marks each row and each look as reliable or not, by the verdict's intervals.
void mark_rows(RunResult& result);

}  // namespace earthtop
