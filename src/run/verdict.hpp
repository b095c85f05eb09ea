// SPDX-License-Identifier: GPL-3.0-or-later
/// What the drift of a run is worth, and until when.
#pragma once

#include "earthtop/run.hpp"

namespace earthtop {

/// Judges a run by its rows and their bounds, and by the growth of disturbances along both motions, which is integrated only
/// where closed forms do not already say that nothing grows exponentially.
/// @param watch  may end it early, with what is known by then
VerdictReport assess_verdict(const RunResult& result, const Watch& watch);

/// Marks the rows from the verdict's time on.
void mark_rows(RunResult& result);

}  // namespace earthtop
