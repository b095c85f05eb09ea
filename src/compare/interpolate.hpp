// SPDX-License-Identifier: GPL-3.0-or-later
/// Interpolation of a trajectory between its rows.
#pragma once

#include <array>

#include "compare/row.hpp"

namespace earthtop::compare {

/// The trajectory at a time between the inner two of four neighbouring rows, by cubic Hermite interpolation. The
/// slopes of attitude and axis come from the rates, those of all else from parabolas through three rows. An outer row that is
/// missing is given as its inner neighbour again. A flag takes the smaller of both values,
/// a word that of the row before; an empty cell stays empty.
Row interpolate(const std::array<const Row*, 4>& rows, double t_s);

}  // namespace earthtop::compare
