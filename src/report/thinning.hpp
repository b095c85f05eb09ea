// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows enough for a picture, its extremes among them.
#pragma once

#include <functional>
#include <vector>

#include "compare/row_source.hpp"

namespace earthtop::report {

/// Of rows in equally many each: the first and the last one, and those in which one of the values is least or largest.
inline constexpr const char* kThinningRule =
    "of each of 250 spans the first and last row, and those where an axis drift, azimuth or tilt is least or largest";

/// @param count  how many rows there are; up to a thousand are all kept
std::vector<compare::Row> thinned_rows(compare::RowSource& rows, std::uint64_t count);

}  // namespace earthtop::report
