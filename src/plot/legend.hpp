// SPDX-License-Identifier: GPL-3.0-or-later
/// The legend of a panel.
#pragma once

#include <string>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "plot/strokes.hpp"
#include "plot/trace.hpp"

namespace earthtop {

/// Drawn above the panel, so that it never hides a line: right-aligned beside the panel's caption if it fits there, else below
/// it, in columns, or, where the picture is narrow, as in a text: each entry after the one before it.
class Legend {
 public:
  Legend() = default;
  /// @param panel  must outlive the legend   @param traces  of its lines
  Legend(const Panel& panel, const std::vector<Trace>& traces, const Sheet& sheet);
  /// The height needed in addition to the caption's line (px).
  double height() const;
  /// @param baseline  y of the baseline of the last row (px)
  void draw(std::string& out, double baseline) const;

 private:
  struct Place {
    std::size_t row;
    double left;  ///< px
  };
  struct Entry {
    const Line* line;
    std::string label;
    bool is_band;
    double width;  ///< px
  };
  void place_in_columns(double room, double widest);
  void place_as_text(double room);
  static void draw_entry(std::string& out, const Entry& entry, double left, double baseline);

  const Sheet* sheet_ = nullptr;
  std::vector<Entry> entries_;
  std::size_t rows_ = 0;       ///< 0: in the caption's line
  std::vector<Place> places_;  ///< of the entries below the caption
};

}  // namespace earthtop
