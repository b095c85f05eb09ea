// SPDX-License-Identifier: GPL-3.0-or-later
/// How formulas in sentences name the Earth's rate in laboratory axes.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>

#include "earthtop/frames/site.hpp"

namespace earthtop {

/// The part of the rate about Up. Where the pole or the plumb line departs from the ellipsoid's, the latitude does not give it.
inline std::string vertical_rate(const Site& site, std::string_view rate) {
  return fmt::format("{}{}", rate, site.follows_ellipsoid() ? " sin(latitude)" : "_up");
}
/// The part about North.
inline std::string northward_rate(const Site& site, std::string_view rate) {
  return fmt::format("{}{}", rate, site.follows_ellipsoid() ? " cos(latitude)" : "_north");
}

/// A formula of which the size is told: in bars where its value is negative.
inline std::string size_of(const std::string& formula, double value) {
  return value < 0 ? fmt::format("|{}|", formula) : formula;
}

}  // namespace earthtop
