// SPDX-License-Identifier: GPL-3.0-or-later
/// The rows of a run, one after the other. A long table need not be held in memory: the result of such a run has few of its rows, and
/// the others are made when they are asked for.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "earthtop/run.hpp"

namespace earthtop {

/// Tables of more rows are made row by row, where a run is asked to and its method can.
inline constexpr std::size_t kLongTable = 20'000;

/// Returns whether a run of this scene with `RunOptions::row_by_row` leaves most of its rows to be made later: it has more than `kLongTable`
/// of them, in double precision, by a method that finds the motion at any time from what the run has left on its way (series, closed
/// forms, long steps), on a pivot without dry friction, and nothing else is told at each row (a ledger, a headline within the run).
bool is_made_row_by_row(const Scene& scene);

/// The number of all rows of a result, whether it holds them or not.
std::size_t row_count(const RunResult& result);

/// Visits all rows in the order of time. Rows that the result does not hold are integrated now; their bound is that of the run's next
/// look for judgement, and the last digits of their numbers may differ from those of a run that holds all.
/// One thread at a time may visit a result and its copies.
/// @param watch  gets the progress, and may end the visits early
/// @throws std::runtime_error if the motion cannot be integrated once more, though the run could
void each_row(const RunResult& result, const std::function<void(const DriftRow&)>& visit, const Watch& watch = {});

/// The means of both axes (East, North, Up) over all rows, about which a precessing or nutating axis moves. Of rows that the result does
/// not hold they are known as soon as all have been visited, which is done now if it has not been.
struct AxisMeans {
  std::array<double, 3> axis_L{}, ref_axis_L{};
};
AxisMeans axis_means(const RunResult& result);

}  // namespace earthtop
