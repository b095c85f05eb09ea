// SPDX-License-Identifier: GPL-3.0-or-later
/// The legend of a panel.
#pragma once

#include <string>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "plot/strokes.hpp"

namespace earthtop {

/// Drawn above the panel, so that it never hides a line: right-aligned beside the panel's caption if it fits there, else in
/// columns below it.
class Legend {
 public:
  /// @param panel  must outlive the legend
  Legend(const Panel& panel, const Sheet& sheet);
  /// The height needed in addition to the caption's line (px).
  double height() const;
  /// @param baseline  y of the baseline of the last row (px)
  void draw(std::string& out, double baseline) const;

 private:
  const Sheet* sheet_;
  std::vector<const Line*> lines_;
  std::size_t columns_ = 0, rows_ = 0;  ///< 0: in the caption's line
};

}  // namespace earthtop
