// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a smooth motion turns between its samples.
#pragma once

#include <span>
#include <vector>

namespace earthtop {

/// Moves those points of a line that are larger, or less, than their neighbours to where the line turns next to them, so that twelve
/// points a period show each swing in full.
/// @param x, y  samples of a smooth motion, at equal steps or in windows of equal steps
/// @param parts  where the line is the length of a vector (times a unit): the vector's components at the same points. A length has a
/// corner where the vector passes near zero, its components have none.
void move_to_turns(std::vector<double>& x, std::vector<double>& y, std::span<const std::vector<double>> parts = {});

}  // namespace earthtop
