// SPDX-License-Identifier: GPL-3.0-or-later
/// The positions and labels of an axis's ticks.
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
  double low = 0;  ///< ends of the axis, in data units
  double high = 1;
  std::vector<Tick> ticks;
  std::string factor;  ///< e.g. "×10⁻⁶": factor by which the labels are to be multiplied; empty for 1
  std::string offset;  ///< e.g. "+ 45.1234": number to be added to the labels; empty for 0
};

/// Ticks at 1, 2 or 5 times a power of ten.
/// @param low, high  range of the data, finite, low <= high   @param wanted  approximate number of ticks
/// @param tight  let the axis end at the ends of the data, not at ticks
Ticks linear_ticks(double low, double high, int wanted, bool tight);

/// Ticks at powers of ten, and at 2 and 5 times these if there are few.   @param low, high  finite and positive, low <= high
Ticks logarithmic_ticks(double low, double high, int wanted);

}  // namespace earthtop
