// SPDX-License-Identifier: GPL-3.0-or-later
/// The names of horizontal directions.
#pragma once

#include <cmath>
#include <numbers>
#include <string_view>

#include "earthtop/elementary.hpp"

namespace earthtop {

/// The nearest of the eight points of the compass to a horizontal direction.
inline std::string_view compass_point(double east, double north) {
  constexpr std::string_view kPoints[] = {"North", "North-East", "East", "South-East",
                                          "South", "South-West", "West", "North-West"};
  const long eighths = std::lround(real::atan2(east, north) * 4 / std::numbers::pi);  // -4 to 4, clockwise from North
  return kPoints[static_cast<std::size_t>(eighths + 8) % 8];
}

}  // namespace earthtop
