/// What the drift of a run is worth, and until when.
#pragma once

#include <atomic>

#include "earthtop/run.hpp"

namespace earthtop {

/// Judges a run by its rows and their bounds, and by the growth of disturbances along both motions, which is integrated only
/// where closed forms do not already say that nothing grows exponentially.
/// @param stop  ends it early, with what is known by then
VerdictReport assess_verdict(const RunResult& result, const std::atomic<bool>& stop);

/// Marks the rows from the verdict's time on.
void mark_rows(RunResult& result);

}  // namespace earthtop
