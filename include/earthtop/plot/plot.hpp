// SPDX-License-Identifier: GPL-3.0-or-later
/// Line plots as SVG: panels below one another with a common x axis. A document is self-contained (no scripts, fonts or links),
/// and the same figure always gives the same bytes.
#pragma once

#include <string>
#include <vector>

namespace earthtop {

enum class AxisScale { linear, logarithmic };
enum class LineStyle {
  solid,
  dashed,
  filled,  ///< a thin line with a tint down to the panel's floor
  thin,
  dotted,
  dash_dot,
  sparse,  ///< dots far apart
  broad,   ///< faint and wide, to be drawn beneath other lines
  points,  ///< the markers alone
  bars,    ///< a bar from 0 to each point of evenly spaced ones
};
enum class Marker { none, circle, square, triangle, diamond };
/// Okabe and Ito's, which the colour-blind can tell apart; ink is the text's.
enum class LineColor { blue, vermillion, green, purple, orange, sky, grey, ink };

struct Axis {
  std::string label;
  std::string unit;  ///< without brackets; may be empty
  AxisScale scale = AxisScale::linear;
};

/// A line through (x, y). A point that is not finite, or not positive on a logarithmic axis, breaks it. Where a line swings faster than
/// its picture can show, it is drawn as a band from its least to its largest value, and the legend says so.
struct Line {
  std::string label;  ///< shown in the legend; no entry if empty
  std::vector<double> x;
  std::vector<double> y;
  LineColor color = LineColor::blue;
  LineStyle style = LineStyle::solid;
  Marker marker = Marker::none;  ///< at every point
  bool hollow = false;           ///< of the marker
  /// Half lengths of the points' error bars along y; empty: none. One that is not above 0 is not drawn.
  std::vector<double> error = {};
  /// Number of successive points that belong together, as looks of one window, between which and the next nothing is known: a band has
  /// a column for each. 0: the points follow one another without gaps.
  std::size_t a_column = 0;
  std::string end_label = {};  ///< a text beside a dot at the line's last point; none if empty
};

struct Panel {
  Axis y;
  std::vector<Line> lines;       ///< drawn in this order
  double height = 210;           ///< px
  bool labels_at_lines = false;  ///< whether labels stand at the lines, without a legend, where all of them find a place there
};

struct Figure {
  std::string title;
  std::string subtitle;
  Axis x;
  std::vector<Panel> panels;
  std::string id = "et";  ///< prefix of the ids within the document: several pictures on one page need different ones
};

/// How wide a picture is drawn: for a desk and for paper, or for a phone, with fewer ticks and the text in several lines.
enum class PlotWidth { wide, narrow };

/// Position of a figure's x axis and of its first panel's y axis in its picture (px), and the values at their ends.
struct PlotFrame {
  double width = 0, left = 0, right = 0;
  double x_low = 0, x_high = 1;
  AxisScale x_scale = AxisScale::linear;
  double floor = 0, top = 0;
  double y_low = 0, y_high = 1;
  AxisScale y_scale = AxisScale::linear;
};
PlotFrame frame_of(const Figure& figure, PlotWidth width = PlotWidth::wide);

/// The figure as one SVG document. Labels may contain any text; characters that XML does not allow are replaced.
std::string svg(const Figure& figure, PlotWidth width = PlotWidth::wide);

}  // namespace earthtop
