// SPDX-License-Identifier: GPL-3.0-or-later
/// What the lines of a panel are called.
#pragma once

#include <string>
#include <vector>

#include "earthtop/plot/plot.hpp"

namespace earthtop {

/// Above the panel, so that it never hides a line: right-aligned beside the panel's caption where it fits, else in columns
/// under it.
class Legend {
 public:
  /// @param panel  outlives the legend
  explicit Legend(const Panel& panel);
  /// What it takes beyond a caption's line (px).
  double height() const;
  /// @param baseline  of its last line (px)
  void draw(std::string& out, double baseline) const;

 private:
  std::vector<const Line*> lines_;
  std::size_t columns_ = 0, rows_ = 0;  ///< 0: in the caption's line
};

}  // namespace earthtop
