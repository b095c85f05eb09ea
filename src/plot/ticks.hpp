// SPDX-License-Identifier: GPL-3.0-or-later
/// Where an axis has its ticks, and how they are written.
#pragma once

#include <string>
#include <vector>

#include "earthtop/plot/plot.hpp"

namespace earthtop {

struct Tick {
  double value = 0;
  std::string label;  ///< empty for a minor tick
};

struct Ticks {
  double low = 0;  ///< the axis's ends, in data units
  double high = 1;
  std::vector<Tick> ticks;
  std::string factor;  ///< e.g. "×10⁻⁶": what the labels are multiplied by; empty for 1
  std::string offset;  ///< e.g. "+ 45.1234": what is added to the labels; empty for 0
};

/// Ticks at 1, 2 or 5 times a power of ten.
/// @param low, high  the data's range, finite, low <= high   @param wanted  about how many
/// @param tight  the axis ends at the data's ends, not at ticks
Ticks linear_ticks(double low, double high, int wanted, bool tight);

/// Ticks at powers of ten; with 2 and 5 where there are few. @param low, high  finite and positive, low <= high
Ticks logarithmic_ticks(double low, double high, int wanted);

}  // namespace earthtop
