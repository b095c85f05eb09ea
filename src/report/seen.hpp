// SPDX-License-Identifier: GPL-3.0-or-later
/// Chooses what a run's page draws of the motion: looks that resolve it, or, where there are none, output rows.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "earthtop/drift/drift.hpp"
#include "report/run_data.hpp"

namespace earthtop::report {

/// Rows as a file would have them. @param run  whose verdict says which can be trusted
std::vector<compare::Row> rows_of(const Run& run, std::span<const DriftRow> looks);

/// Fills in the motion that is drawn and the one that is played from looks that resolve it.
/// @param a_window  as RunResult::looks_a_window   @param last  gives looks at the end of the motion, without windows
void take_looks(Run& run, std::span<const DriftRow> looks, std::size_t a_window,
                const std::function<std::vector<DriftRow>()>& last);

/// Fills in the motion that is drawn and the one that is played. @param run  with its output rows
/// @throws Interrupted
void see_motion(Run& run);

}  // namespace earthtop::report
