// SPDX-License-Identifier: GPL-3.0-or-later
/// A trajectory between its rows.
#pragma once

#include <array>

#include "compare/row.hpp"

namespace earthtop::compare {

/// The trajectory at a time between the inner two of four neighbouring rows, by cubic Hermite interpolation. Slopes of
/// attitude and axis are those that the rates give, of all else those of parabolas through three rows; an outer row that is
/// missing is its inner neighbour again. Of a flag the smaller one counts; an empty cell stays one.
Row interpolate(const std::array<const Row*, 4>& rows, double t_s);

}  // namespace earthtop::compare
