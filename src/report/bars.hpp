// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes over many decades, side by side.
#pragma once

#include <string>
#include <vector>

namespace earthtop::report {

struct Bar {
  std::string label;
  double value = 0;       ///< above 0
  bool left_out = false;  ///< hatched
};

/// Horizontal bars on a logarithmic axis, as SVG. @param name  what the names within the document begin with
std::string bars_svg(const std::string& name, const std::string& title, const std::string& unit, const std::vector<Bar>& bars);

}  // namespace earthtop::report
