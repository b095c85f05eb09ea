// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/strokes.hpp"

#include <fmt/format.h>

#include "plot/palette.hpp"
#include "plot/svg_text.hpp"

namespace earthtop {

std::string_view hex(LineColor color) {
  for (const CurveInk& curve : kCurveInks)
    if (curve.color == color) return curve.ink.light;
  return "currentColor";  // ink
}

const char* stroke_kind(LineStyle style) {
  if (style == LineStyle::dashed) return " stroke-dasharray=\"6 4\"";
  if (style == LineStyle::dotted) return " stroke-dasharray=\"1 4\"";
  if (style == LineStyle::dash_dot) return " stroke-dasharray=\"6 3 1 3\"";
  if (style == LineStyle::sparse) return " stroke-dasharray=\"1 9\"";
  return style == LineStyle::broad ? " stroke-opacity=\"0.4\"" : "";
}

double stroke_width(LineStyle style) {
  switch (style) {
    case LineStyle::solid:
    case LineStyle::dashed: break;
    case LineStyle::filled:
    case LineStyle::thin:
    case LineStyle::points:
    case LineStyle::bars:
    case LineStyle::dash_dot:
    case LineStyle::sparse:
    case LineStyle::dotted: return 1.2;
    case LineStyle::broad: return 7;
  }
  return 1.8;
}

void draw_marker(std::string& out, const Line& line, double x, double y) {
  const auto path = [&](const char* from) {
    if (line.hollow)
      fmt::format_to(Out(out), "<path class=\"et-hollow\" d=\"M{:.2f} {:.2f}{}z\" stroke=\"{}\"/>\n", x, y, from,
                     hex(line.color));
    else
      fmt::format_to(Out(out), "<path d=\"M{:.2f} {:.2f}{}z\" fill=\"{}\"/>\n", x, y, from, hex(line.color));
  };
  switch (line.marker) {
    case Marker::none: return;
    case Marker::circle: return path("m-3.2 0a3.2 3.2 0 1 0 6.4 0a3.2 3.2 0 1 0-6.4 0");
    case Marker::square: return path("m-2.9-2.9h5.8v5.8h-5.8");
    case Marker::triangle: return path("m0-3.9l3.7 6.4h-7.4");
    case Marker::diamond: return path("m0-4l4 4l-4 4l-4-4");
  }
}

void draw_error_bar(std::string& out, const Line& line, double x, double y_low, double y_high) {
  constexpr double kCap = 2.5;  // half the width of the ends (px)
  fmt::format_to(Out(out), "<path d=\"M{0:.2f} {2:.2f}V{3:.2f}M{1:.2f} {2:.2f}h{4}M{1:.2f} {3:.2f}h{4}\" stroke=\"{5}\"/>\n", x,
                 x - kCap, y_low, y_high, 2 * kCap, hex(line.color));
}

void draw_text(std::string& out, double x, double y, const char* anchor, const char* style, std::string_view text) {
  fmt::format_to(Out(out), "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, style,
                 escape_xml(text));
}

double draw_lines(std::string& out, double x, double y, const char* anchor, const char* style,
                  const std::vector<std::string>& lines, double line_height) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    draw_text(out, x, y + line_height * static_cast<double>(i), anchor, style, lines[i]);
  return lines.empty() ? 0 : line_height * static_cast<double>(lines.size() - 1);
}

void draw_rule(std::string& out, const char* style, double x1, double y1, double x2, double y2) {
  fmt::format_to(Out(out), "<path class=\"{}\" d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\"/>\n", style, x1, y1, x2, y2);
}

}  // namespace earthtop
