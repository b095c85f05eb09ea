// SPDX-License-Identifier: GPL-3.0-or-later
/// A still of the top: its axis, the axis that it would have without what makes it drift, its cone, and the Earth's axis.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "report/drawings.hpp"
#include "results/compared_words.hpp"

namespace earthtop::report {

/// Directions are unit vectors in East, North, Up.
struct TopStill {
  std::string title, subtitle;
  std::array<double, 3> axis_L{}, ref_axis_L{};
  std::array<double, 3> earth_rate_L{};           ///< of any length; all zero: not drawn
  bool has_cone = true;                           ///< whether the axis goes round Up at a constant tilt, or nearly so
  bool hangs = false;                             ///< whether the body is below the pivot
  std::string_view cause = kRotationWords.cause;  ///< without which the axis would be the other one
};

/// How many times larger the angle between the two axes is drawn: 1, 2 or 5 times a power of ten, at least 1, so that it is seen.
double magnification(const TopStill& still);

/// SVG documents.
Drawings top_still_svg(const TopStill& still);

}  // namespace earthtop::report
