// SPDX-License-Identifier: GPL-3.0-or-later
/// Texts at the lines of a panel: the mark of a line's end, and labels instead of a legend.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "plot/mapping.hpp"
#include "plot/strokes.hpp"
#include "plot/trace.hpp"

namespace earthtop {

/// Finds places for the texts where no line and no other text is.
class LineLabels {
 public:
  LineLabels() = default;
  /// @param panel  must outlive the labels   @param traces  of its lines   @param x, y  with the panel's top at 0
  LineLabels(const Panel& panel, const std::vector<Trace>& traces, const Mapping& x, const Mapping& y);
  /// Whether each line has its label, so that the panel needs no legend. That some are bands then stands in the panel's caption.
  bool name_all_lines() const { return names_all_; }
  /// @param top  of the panel in the picture (px)
  void draw(std::string& out, double top) const;

 private:
  struct Text {
    std::string words;
    double right, baseline;  ///< px
    bool is_end;
  };
  struct Dot {
    const Line* line;
    double x, y;  ///< px
  };
  std::vector<Text> texts_;
  std::vector<Dot> dots_;
  bool names_all_ = false;
};

/// Whether the panel has room above the end of a line for its mark, of which the value is given in px.
bool has_room_for_end(double y);

}  // namespace earthtop
