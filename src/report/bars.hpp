// SPDX-License-Identifier: GPL-3.0-or-later
/// Bar charts for sizes that differ by many decades.
#pragma once

#include <string>
#include <vector>

#include "report/drawings.hpp"

namespace earthtop::report {

struct Bar {
  std::string label;
  double value = 0;       ///< must be positive
  bool left_out = false;  ///< hatched
};

/// Horizontal bars on a logarithmic axis, as SVG.   @param name  prefix of the ids within the document
Drawings bars_svg(const std::string& name, const std::string& title, const std::string& unit, const std::vector<Bar>& bars);

}  // namespace earthtop::report
