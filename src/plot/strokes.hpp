// SPDX-License-Identifier: GPL-3.0-or-later
/// The basic elements of all pictures: the page's measures, strokes, markers, text.
#pragma once

#include <iterator>
#include <string>
#include <string_view>

#include "earthtop/plot/plot.hpp"

namespace earthtop {

// Lengths in px; one character of the 12 px font is about 6.4 wide.
inline constexpr double kWidth = 860, kLeft = 74, kRight = 30;
inline constexpr double kPlotWidth = kWidth - kLeft - kRight;
inline constexpr double kCharacter = 6.4;

using Out = std::back_insert_iterator<std::string>;

const char* hex(LineColor color);

/// SVG attributes for a line style in addition to colour and width (dashes, opacity); empty for a solid line.
const char* stroke_kind(LineStyle style);
double stroke_width(LineStyle style);

void draw_marker(std::string& out, const Line& line, double x, double y);
void draw_error_bar(std::string& out, const Line& line, double x, double y_low, double y_high);
void draw_text(std::string& out, double x, double y, const char* anchor, const char* style, std::string_view text);
void draw_rule(std::string& out, const char* style, double x1, double y1, double x2, double y2);

}  // namespace earthtop
