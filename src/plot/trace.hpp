// SPDX-License-Identifier: GPL-3.0-or-later
/// Chooses how a line is drawn: its points, or, where it swings faster than pixels can show, a band from its least to its largest value.
#pragma once

#include <string_view>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "plot/mapping.hpp"

namespace earthtop {

/// The words that the legend adds to the label of a line that shows a band.
inline constexpr std::string_view kBandWords = " (band: least to most)";

struct PlotPoint {
  double x = 0, y = 0;  ///< px
  bool operator==(const PlotPoint&) const = default;
};

/// A stretch of a line: its points, or the edges of a band, `lower` lying below `upper` in the picture.
struct Stretch {
  std::vector<PlotPoint> upper;
  std::vector<PlotPoint> lower{};  ///< empty for a line
  double height = 0;               ///< of a band where it is highest (px)
  bool is_band() const { return !lower.empty(); }
};

/// The stretches of an unbroken piece of a line, which follow one another.
using Piece = std::vector<Stretch>;

/// A line with its unbroken pieces.
struct Trace {
  std::vector<Piece> pieces;
  bool shows_band() const;  ///< whether a band in it can be told from a line
};

/// Leaves out points that lie on the line through those that stay, as far as can be seen (Ramer, Douglas and Peucker).
void thin_out(std::vector<PlotPoint>& points);

/// This is the one place where it is decided what becomes a band: a stretch of some columns in which each swing takes less than one.
Trace trace_of(const Line& line, const Mapping& x, const Mapping& y);

}  // namespace earthtop
