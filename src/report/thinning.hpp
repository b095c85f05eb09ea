// SPDX-License-Identifier: GPL-3.0-or-later
/// Reduces rows to as many as a picture needs, including all extremes.
#pragma once

#include <functional>
#include <vector>

#include "compare/row_source.hpp"
#include "earthtop/watch.hpp"

namespace earthtop::report {

/// The rows are divided into spans of equal numbers. The first and the last row of each span are kept, and those where one of
/// the watched values is smallest or largest.
inline constexpr const char* kThinningRule =
    "of each of 250 spans the first and last row, and those where a drift of axis, azimuth, tilt or tip, or the slip, is least "
    "or largest";

/// @param count  the number of rows; up to a thousand rows are all kept   @param watch  may stop the reading
/// @throws Interrupted
std::vector<compare::Row> thinned_rows(compare::RowSource& rows, std::uint64_t count, const Watch& watch = {});

}  // namespace earthtop::report
