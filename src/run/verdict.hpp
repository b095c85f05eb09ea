// SPDX-License-Identifier: GPL-3.0-or-later
/// The verdict on a run's drift: whether it can be trusted, and until when.
#pragma once

#include "earthtop/run.hpp"

namespace earthtop {

/// Judges a run by its rows and their bounds, and by the growth of disturbances along both motions, which is integrated only
/// where closed forms do not already say that nothing grows exponentially.
/// @param watch  may end the assessment early; the verdict then rests on what is known so far
VerdictReport assess_verdict(const RunResult& result, const Watch& watch);

/// Marks each row as reliable or not, by the verdict's time and by the stops of the motions.
void mark_rows(RunResult& result);

}  // namespace earthtop
