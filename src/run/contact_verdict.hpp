// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the drift of a top on a table can be trusted.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"

namespace earthtop {

/// A tippe top is unstable while it turns over and not for ever after; a motion beyond the onset of a slip is marginal.
/// @param result  its rows and the events of its contact are there
VerdictReport contact_verdict(const DriftProblem<double>& problem, const RunResult& result, const Watch& watch);

}  // namespace earthtop
