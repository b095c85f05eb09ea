// SPDX-License-Identifier: GPL-3.0-or-later
/// The basic elements of all pictures: the page's measures, strokes, markers, text.
#pragma once

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/plot/plot.hpp"

namespace earthtop {

inline constexpr double kCharacter = 6.4;  // px, of the 12 px font

/// The measures of a picture (px), and how many characters a line of it holds.
struct Sheet {
  double width, left, right, text_left;
  int x_ticks;
  std::size_t title_characters, subtitle_characters, caption_characters, legend_characters;
  std::size_t most_lines;  ///< of a title or caption; what is longer is cut
  double tallest_panel;
  bool legend_as_text;  ///< whether a legend below the caption is set like a text, instead of in columns
  double plot_width() const { return width - left - right; }
};
inline constexpr Sheet kWideSheet{860, 74, 30, 74, 8, 80, 101, 1000, 1000, 2, 1e9, false};
inline constexpr Sheet kNarrowSheet{340, 58, 22, 8, 4, 30, 44, 36, 42, 4, 300, true};
inline constexpr const Sheet& sheet_of(PlotWidth width) { return width == PlotWidth::wide ? kWideSheet : kNarrowSheet; }

using Out = std::back_insert_iterator<std::string>;

/// The colour on a light background; the styles of pictures and pages put that of a dark one in its place.
std::string_view hex(LineColor color);

/// SVG attributes for a line style in addition to colour and width (dashes, opacity); empty for a solid line.
const char* stroke_kind(LineStyle style);
double stroke_width(LineStyle style);

/// How opaque a band is that is drawn where a line swings too fast to be seen. Its edges are strokes as the line's, so that a band as thin
/// as a line looks like one.
inline constexpr double kBandOpacity = 0.35;

void draw_marker(std::string& out, const Line& line, double x, double y);
void draw_error_bar(std::string& out, const Line& line, double x, double y_low, double y_high);
void draw_text(std::string& out, double x, double y, const char* anchor, const char* style, std::string_view text);
/// Lines of a text below one another. @returns the height that they take beyond that of one line (px)
double draw_lines(std::string& out, double x, double y, const char* anchor, const char* style,
                  const std::vector<std::string>& lines, double line_height);
void draw_rule(std::string& out, const char* style, double x1, double y1, double x2, double y2);

}  // namespace earthtop
