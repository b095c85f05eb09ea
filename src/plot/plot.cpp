// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "plot/legend.hpp"
#include "plot/line_labels.hpp"
#include "plot/mapping.hpp"
#include "plot/palette.hpp"
#include "plot/strokes.hpp"
#include "plot/svg_text.hpp"
#include "plot/ticks.hpp"
#include "plot/trace.hpp"

namespace earthtop {
namespace {

constexpr double kTop = 102, kPanelGap = 58, kBottom = 62, kTitleHeight = 20, kLineHeight = 16;  // px

/// The rules of a picture's colours on one background.
std::string ink_rules(std::string_view Ink::*side) {
  std::string rules = fmt::format(
      ".et text{{fill:{}}}.et .et-h,.et .et-b{{fill:{}}}.et{{color:{}}}.et .et-s{{fill:{}}}.et .et-page,.et "
      ".et-hollow{{fill:{}}}"
      ".et .et-grid{{stroke:{}}}.et .et-minor{{stroke:{}}}.et .et-frame{{stroke:{}}}",
      kText.*side, kHeading.*side, kHeading.*side, kMuted.*side, kPage.*side, kGrid.*side, kMinor.*side, kMuted.*side);
  for (const auto& [color, ink] : kCurveInks)
    if (ink.*side != ink.light)
      rules += fmt::format(".et [stroke=\"{0}\"]{{stroke:{1}}}.et [fill=\"{0}\"]{{fill:{1}}}", ink.light, ink.*side);
  return rules;
}

/// The style of a picture by itself, which follows the reader's colour scheme.
std::string picture_style() {
  return fmt::format(
      "<style>\n.et{{font-family:system-ui,-apple-system,'Segoe UI','Helvetica Neue',Arial,'DejaVu Sans',sans-serif;"
      "font-size:{}px}}\n.et .et-h{{font-size:{}px;font-weight:600}}.et .et-b{{font-size:{}px;font-weight:600}}"
      ".et .et-hollow{{stroke-width:1.4}}\n{}\n@media (prefers-color-scheme:dark){{{}}}\n</style>\n",
      kLabelSize, kTitleSize, kCaptionSize, ink_rules(&Ink::light), ink_rules(&Ink::dark));
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return !(low <= high); }
};

Mapping map_axis(Range range, AxisScale scale, bool tight, int wanted, double from, double to) {
  if (range.empty()) range = scale == AxisScale::linear ? Range{0, 1} : Range{0.1, 1};
  // Beyond a quarter of the largest double the arithmetic of the axis would overflow.
  constexpr double kMost = 4e307;
  range.low = std::clamp(range.low, -kMost, kMost);
  range.high = std::clamp(range.high, -kMost, kMost);
  if (scale == AxisScale::linear) return {linear_ticks(range.low, range.high, wanted, tight), scale, from, to};
  range.low = std::max({range.low, range.high * 1e-24, 1e-300});
  range.high = std::max(range.high, range.low);
  return {logarithmic_ticks(range.low, range.high, wanted), scale, from, to};
}

std::string caption(const Axis& axis, const Ticks& ticks) {
  std::string unit = ticks.factor;
  if (!axis.unit.empty()) unit += (unit.empty() ? "" : " ") + axis.unit;
  std::string text = axis.label;
  if (!ticks.offset.empty())
    text += " (" + (unit.empty() ? "" : unit + ", ") + ticks.offset + ")";
  else if (!unit.empty())
    text += " (" + unit + ")";
  return text;
}

/// The commands of a path through points, begun with a letter.   @param top  of the panel in the picture (px)
void add_points(std::string& path, char first, const std::vector<PlotPoint>& points, double top) {
  for (const PlotPoint& point : points) {
    fmt::format_to(Out(path), "{}{:.2f} {:.2f}", first, point.x, top + point.y);
    first = 'L';
  }
}

/// A line, or a band with its edges.
void draw_stretch(std::string& out, const Stretch& stretch, const Line& line, double top) {
  std::string path, fill = "fill=\"none\"";
  add_points(path, 'M', stretch.upper, top);
  if (stretch.is_band()) {
    add_points(path, 'L', {stretch.lower.rbegin(), stretch.lower.rend()}, top);
    path += 'Z';
    fill = fmt::format("class=\"et-band\" fill=\"{}\" fill-opacity=\"{}\"", hex(line.color), kBandOpacity);
  } else if (stretch.upper.size() == 1) {
    path += "h0.01";  // a single point shows as a dot because of the round line cap
  }
  fmt::format_to(Out(out),
                 "<path d=\"{}\" {} stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\" "
                 "stroke-linecap=\"round\"{}/>\n",
                 path, fill, hex(line.color), stroke_width(line.style), stroke_kind(line.style));
}

void draw_piece(std::string& out, const Piece& piece, const Line& line, double top, double floor) {
  if (line.style == LineStyle::filled) {
    std::string path;
    for (const Stretch& stretch : piece) add_points(path, path.empty() ? 'M' : 'L', stretch.upper, top);
    fmt::format_to(Out(out), "<path d=\"{}V{:.2f}H{:.2f}Z\" fill=\"{}\" fill-opacity=\"0.15\"/>\n", path, floor,
                   piece.front().upper.front().x, hex(line.color));
  }
  for (const Stretch& stretch : piece) draw_stretch(out, stretch, line, top);
}

/// Half the width of a line's bars in units of x: half the smallest distance of two of its points.
double half_bar(const Line& line) {
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.x.size(); ++i) width = std::min(width, std::abs(line.x[i] - line.x[i - 1]));
  return std::isfinite(width) ? width / 2 : 0.5;
}

void draw_bars(std::string& out, const Line& line, const Mapping& x, const Mapping& y) {
  const double half = half_bar(line), floor = y.scale == AxisScale::linear ? y(0) : y.from;
  for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i)
    if (drawable(line.x[i], x.scale) && drawable(line.y[i], y.scale))
      fmt::format_to(Out(out),
                     "<path d=\"M{:.2f} {:.2f}V{:.2f}H{:.2f}V{:.2f}z\" fill=\"{}\" fill-opacity=\"0.3\" stroke=\"{}\"/>\n",
                     x(line.x[i] - half), floor, y(line.y[i]), x(line.x[i] + half), floor, hex(line.color), hex(line.color));
}

/// The half length of a point's error bar; 0 where it has none.
double error_of(const Line& line, std::size_t point) {
  const double error = point < line.error.size() ? line.error[point] : 0;
  return std::isfinite(error) && error > 0 ? error : 0;
}

/// The markers of a line's points, on top of their error bars.
void draw_points(std::string& out, const Line& line, const Mapping& x, const Mapping& y) {
  for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i) {
    if (!drawable(line.x[i], x.scale) || !drawable(line.y[i], y.scale)) continue;
    const double error = error_of(line, i), low = line.y[i] - error;
    if (error > 0) draw_error_bar(out, line, x(line.x[i]), drawable(low, y.scale) ? y(low) : y.from, y(line.y[i] + error));
    draw_marker(out, line, x(line.x[i]), y(line.y[i]));
  }
}

bool is_drawn_through(const Line& line) { return line.style != LineStyle::points && line.style != LineStyle::bars; }

void draw_line(std::string& out, const Line& line, const Trace& trace, const Mapping& x, const Mapping& y) {
  if (line.style == LineStyle::points) return draw_points(out, line, x, y);
  if (line.style == LineStyle::bars) return draw_bars(out, line, x, y);
  for (const Piece& piece : trace.pieces) draw_piece(out, piece, line, y.to, y.from);
  if (line.marker != Marker::none || !line.error.empty()) draw_points(out, line, x, y);
}

/// The values of y that a line needs room for.
void include_y(Range& range, const Line& line, AxisScale x_scale, AxisScale y_scale) {
  for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i) {
    if (!drawable(line.x[i], x_scale) || !drawable(line.y[i], y_scale)) continue;
    range.include(line.y[i]);
    for (const double end : {line.y[i] - error_of(line, i), line.y[i] + error_of(line, i)})
      if (drawable(end, y_scale)) range.include(end);
  }
  if (line.style == LineStyle::bars && y_scale == AxisScale::linear) range.include(0);
}

/// The room that a panel needs above and for itself.
struct PanelRoom {
  const Panel* panel;
  Range range;  ///< of its values of y
  double height;
  std::vector<Trace> traces;  ///< of its lines, with the panel's top at 0
  LineLabels labels;
  Legend legend;
  std::vector<std::string> caption;

  PanelRoom(const Panel& drawn, const Mapping& x, const Sheet& sheet)
      : panel(&drawn), height(std::min(drawn.height, sheet.tallest_panel)) {
    for (const Line& line : drawn.lines) include_y(range, line, x.scale, drawn.y.scale);
    make_room_for_ends(x.scale);
    const Mapping y = map_y(height, 0);
    for (const Line& line : drawn.lines) traces.push_back(is_drawn_through(line) ? trace_of(line, x, y) : Trace());
    labels = LineLabels(drawn, traces, x, y);
    if (!labels.name_all_lines()) legend = Legend(drawn, traces, sheet);
    std::string text = earthtop::caption(drawn.y, map_y(0, 1).axis);
    if (labels.name_all_lines() && std::ranges::any_of(traces, [](const Trace& trace) { return trace.shows_band(); }))
      text = text.ends_with(')') ? text.substr(0, text.size() - 1) + "; " + std::string(kBandWords.substr(2))
                                 : text + std::string(kBandWords);
    caption = lines_of(text, sheet.caption_characters, sheet.most_lines);
  }
  Mapping map_y(double floor, double top) const { return map_axis(range, panel->y.scale, false, 6, floor, top); }
  /// Adds room above the highest value where the text of a line's end would not have it.
  void make_room_for_ends(AxisScale x_scale) {
    if (panel->y.scale != AxisScale::linear || range.empty()) return;
    constexpr double kRoom = 0.12;  // of the range
    const Mapping y = map_y(height, 0);
    for (const Line& line : panel->lines)
      for (std::size_t i = std::min(line.x.size(), line.y.size()); !line.end_label.empty() && i-- > 0;) {
        if (!drawable(line.x[i], x_scale) || !drawable(line.y[i], y.scale)) continue;
        if (!has_room_for_end(y(line.y[i]))) range.include(line.y[i] + kRoom * (range.high - range.low));
        break;
      }
  }
  /// The room above the panel beyond that for a caption of one line (px).
  double above() const { return legend.height() + kLineHeight * static_cast<double>(caption.size() - 1); }
};

void draw_panel(std::string& out, const PanelRoom& room, const Sheet& sheet, const Mapping& x, double top,
                const std::string& id) {
  const Panel& panel = *room.panel;
  const double floor = top + room.height, right = sheet.width - sheet.right;
  const Mapping y = room.map_y(floor, top);
  draw_lines(out, sheet.text_left, top - 14 - room.above(), "start", " class=\"et-b\"", room.caption, kLineHeight);
  room.legend.draw(out, top - 14);
  for (const Tick& tick : x.axis.ticks)
    draw_rule(out, tick.label.empty() ? "et-minor" : "et-grid", x(tick.value), top, x(tick.value), floor);
  for (const Tick& tick : y.axis.ticks) {
    draw_rule(out, tick.label.empty() ? "et-minor" : "et-grid", sheet.left, y(tick.value), right, y(tick.value));
    draw_text(out, sheet.left - 8, y(tick.value) + 4, "end", "", tick.label);
  }
  if (panel.y.scale == AxisScale::linear && y.axis.low < 0 && y.axis.high > 0)
    draw_rule(out, "et-frame", sheet.left, y(0), right, y(0));
  fmt::format_to(Out(out),
                 "<clipPath id=\"{}\"><rect x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{}\"/></clipPath>\n"
                 "<g clip-path=\"url(#{})\">\n",
                 id, sheet.left, top - 2, sheet.plot_width() + 2, room.height + 4, id);
  for (std::size_t i = 0; i < panel.lines.size(); ++i) draw_line(out, panel.lines[i], room.traces[i], x, y);
  out += "</g>\n";
  room.labels.draw(out, top);
  draw_rule(out, "et-frame", sheet.left, floor, right, floor);
}

Mapping map_x(const Figure& figure, const Sheet& sheet) {
  Range range;
  for (const Panel& panel : figure.panels)
    for (const Line& line : panel.lines)
      for (const double value : line.x) {
        const double half = line.style == LineStyle::bars ? half_bar(line) : 0;
        for (const double end : {value - half, value + half})
          if (drawable(end, figure.x.scale)) range.include(end);
      }
  return map_axis(range, figure.x.scale, true, sheet.x_ticks, sheet.left, sheet.left + sheet.plot_width());
}

/// The texts above the panels.
struct Heading {
  std::vector<std::string> title, subtitle;
  double subtitle_y, end;  ///< end: where the first panel's caption would begin (px)
  Heading(const Figure& figure, const Sheet& sheet)
      : title(lines_of(figure.title, sheet.title_characters, sheet.most_lines)),
        subtitle(lines_of(figure.subtitle, sheet.subtitle_characters, sheet.most_lines)),
        subtitle_y(49 + kTitleHeight * static_cast<double>(title.size() - 1)),
        end(subtitle_y + kTop - 49 + kLineHeight * static_cast<double>(subtitle.size() - 1)) {}
};

}  // namespace

PlotFrame frame_of(const Figure& figure, PlotWidth width) {
  const Sheet& sheet = sheet_of(width);
  const Mapping x = map_x(figure, sheet);
  PlotFrame frame{sheet.width, x.from, x.to, x.axis.low, x.axis.high, figure.x.scale};
  if (figure.panels.empty()) return frame;
  const PanelRoom room(figure.panels[0], x, sheet);
  frame.top = Heading(figure, sheet).end + room.above();
  frame.floor = frame.top + room.height;
  const Mapping y = room.map_y(frame.floor, frame.top);
  frame.y_low = y.axis.low;
  frame.y_high = y.axis.high;
  frame.y_scale = figure.panels[0].y.scale;
  return frame;
}

std::string svg(const Figure& figure, PlotWidth width) {
  const Sheet& sheet = sheet_of(width);
  const Mapping x = map_x(figure, sheet);
  std::vector<PanelRoom> rooms;
  for (const Panel& panel : figure.panels) rooms.emplace_back(panel, x, sheet);
  const Heading heading(figure, sheet);
  const auto x_caption = lines_of(caption(figure.x, x.axis), sheet.caption_characters, sheet.most_lines);
  double top = heading.end;

  double bottom = top - kPanelGap + 18;
  for (const PanelRoom& room : rooms) bottom += room.above() + room.height + kPanelGap;
  const double height = bottom - 18 + kBottom + kLineHeight * static_cast<double>(x_caption.size() - 1);
  std::string out;
  fmt::format_to(Out(out),
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"et\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                 "role=\"img\">\n<title>{2}</title>\n<desc>{3}</desc>\n",
                 sheet.width, height, escape_xml(figure.title), escape_xml(figure.subtitle));
  out += picture_style();
  fmt::format_to(Out(out), "<rect class=\"et-page\" width=\"{}\" height=\"{}\"/>\n", sheet.width, height);
  draw_lines(out, sheet.text_left, 30, "start", " class=\"et-h\"", heading.title, kTitleHeight);
  draw_lines(out, sheet.text_left, heading.subtitle_y, "start", " class=\"et-s\"", heading.subtitle, kLineHeight);
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    top += rooms[i].above();
    draw_panel(out, rooms[i], sheet, x, top, fmt::format("{}-clip{}", figure.id, i));
    top += rooms[i].height + kPanelGap;
  }
  for (const Tick& tick : x.axis.ticks) draw_text(out, x(tick.value), bottom, "middle", "", tick.label);
  const double middle = sheet.text_left + (sheet.width - sheet.text_left - sheet.right) / 2;
  draw_lines(out, middle, bottom + 26, "middle", " class=\"et-b\"", x_caption, kLineHeight);
  out += "</svg>\n";
  return out;
}

}  // namespace earthtop
