// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/path_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "earthtop/elementary.hpp"
#include "plot/svg_text.hpp"
#include "plot/trace.hpp"

namespace earthtop::report {
namespace {

/// The measures of the picture (px), and how many characters its lines hold. In the narrow one the legend has lines of its own.
struct Layout {
  double width, side, margin, edge;
  std::size_t title_characters, subtitle_characters, most_lines;
  bool legend_below;
  const char* suffix;
};
constexpr Layout kWide{860, 480, 40, 24, 1000, 1000, 1, false, ""}, kNarrow{340, 324, 24, 8, 30, 44, 4, true, "-narrow"};
constexpr double kTop = 76, kBelow = 56, kTitleHeight = 20, kLineHeight = 16;
/// Colours and font of a picture that stands alone; on a page its style overrides them.
constexpr const char* kAlone = "fill=\"#374151\" font-family=\"sans-serif\" font-size=\"12\"";
constexpr double kSmallest = 1e-15;  // m; shorter paths are drawn as if they were as long

/// Where the points of the plane are in the picture.
struct Map {
  double middle_x, middle_y;  ///< of the picture (px)
  double x0, y0, per_m;       ///< the plane's point there (m), and px per metre
  double x(double m) const { return middle_x + (m - x0) * per_m; }
  double y(double m) const { return middle_y - (m - y0) * per_m; }
};

Map map_of(const PathPicture& picture, const Layout& layout, double top) {
  const double middle_x = layout.width / 2, middle_y = top + layout.side / 2;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low[2] = {kInfinity, kInfinity}, high[2] = {-kInfinity, -kInfinity};
  for (const Path* path : {&picture.rotating, &picture.reference})
    for (int axis = 0; axis < 2; ++axis)
      for (const double m : axis == 0 ? path->x : path->y)
        if (std::isfinite(m)) low[axis] = std::min(low[axis], m), high[axis] = std::max(high[axis], m);
  if (!(low[0] <= high[0]) || !(low[1] <= high[1])) return {middle_x, middle_y, 0, 0, 1};
  const double width = std::max(high[0] - low[0], kSmallest), height = std::max(high[1] - low[1], kSmallest);
  return {middle_x, middle_y, (low[0] + high[0]) / 2, (low[1] + high[1]) / 2,
          std::min((layout.width - 2 * layout.margin) / width, (layout.side - 2 * layout.margin) / height)};
}

/// The commands of a path element from a point on, without those that lie on the line through the others.
std::string commands(const Path& path, const Map& map, std::size_t from = 0) {
  std::string text;
  std::vector<PlotPoint> piece;
  for (std::size_t i = from; i <= path.x.size(); ++i) {
    if (i < path.x.size() && std::isfinite(path.x[i]) && std::isfinite(path.y[i])) {
      piece.push_back({map.x(path.x[i]), map.y(path.y[i])});
      continue;
    }
    thin_out(piece);
    for (std::size_t k = 0; k < piece.size(); ++k)
      text += fmt::format("{}{:.1f} {:.1f}", k > 0 ? "L" : "M", piece[k].x, piece[k].y);
    piece.clear();
  }
  return text;
}

/// The first or the last finite point of a path; none where there is none.
bool find_point(const Path& path, bool last, double& x, double& y) {
  for (std::size_t k = 0; k < path.x.size(); ++k) {
    const std::size_t i = last ? path.x.size() - 1 - k : k;
    if (!std::isfinite(path.x[i]) || !std::isfinite(path.y[i])) continue;
    x = path.x[i];
    y = path.y[i];
    return true;
  }
  return false;
}

/// A ring at the start of a path and a dot at its end.
std::string marks(const Path& path, const Map& map, std::string_view color, double radius) {
  std::string text;
  double x = 0, y = 0;
  if (find_point(path, false, x, y))
    text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                        map.x(x), map.y(y), radius + 2, color);
  if (find_point(path, true, x, y))
    text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", map.x(x), map.y(y), radius, color);
  return text;
}

/// The lines of a text, each as an element.
std::string text_lines(double x, double y, const char* style, const std::vector<std::string>& lines, double height) {
  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i)
    out += fmt::format("<text x=\"{}\" y=\"{}\" class=\"{}\">{}</text>\n", x, y + height * static_cast<double>(i), style,
                       escape_xml(lines[i]));
  return out;
}

std::string drawn(const PathPicture& picture, const Layout& layout) {
  const auto title = lines_of(picture.title, layout.title_characters, layout.most_lines);
  const auto subtitle = lines_of(picture.subtitle, layout.subtitle_characters, layout.most_lines);
  const double subtitle_y = 52 + kTitleHeight * static_cast<double>(title.size() - 1);
  const double top = subtitle_y + kTop - 52 + kLineHeight * static_cast<double>(subtitle.size() - 1);
  const Map map = map_of(picture, layout, top);
  const double bar = round_down((layout.legend_below ? 120 : 160) / map.per_m), bottom = top + layout.side;
  const double bar_px = bar * map.per_m, below = kBelow + (layout.legend_below ? 44 : 0), edge = layout.edge;
  const std::string name = escape_xml(picture.name) + layout.suffix;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"et\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\" {3}>\n<title>{2}</title>\n<rect class=\"et-page\" fill=\"#ffffff\" width=\"{0}\" height=\"{1}\"/>\n",
      layout.width, bottom + below, escape_xml(picture.title), kAlone);
  out += text_lines(edge, 30, "et-h", title, kTitleHeight) + text_lines(edge, subtitle_y, "et-s", subtitle, kLineHeight);
  out +=
      fmt::format("<rect class=\"et-frame\" stroke=\"#6b7280\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\"/>\n",
                  edge, top, layout.width - 2 * edge, layout.side);
  // Start and end are seen even where both paths coincide: those of the prediction are larger.
  out += fmt::format(
      "<path id=\"{}-ref\" d=\"{}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"3\" stroke-dasharray=\"7 4\"/>\n", name,
      commands(picture.reference, map));
  // One stroke over all swings is equally pale everywhere: a band.
  if (const std::size_t last = picture.rotating.last_swing; last > 0)
    out += fmt::format(
        "<path id=\"{}-band\" d=\"{}\" fill=\"none\" stroke=\"#d55e00\" stroke-opacity=\"0.35\" stroke-width=\"1.5\"/>\n", name,
        commands(picture.rotating, map));
  const std::size_t begin = picture.rotating.last_swing > 0 ? picture.rotating.x.size() - picture.rotating.last_swing : 0;
  out += fmt::format("<path id=\"{}-rot\" d=\"{}\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"1.5\"/>\n", name,
                     commands(picture.rotating, map, begin));
  out += marks(picture.reference, map, "#0072b2", 6) + marks(picture.rotating, map, "#d55e00", 3);
  out += fmt::format("<text x=\"{0}\" y=\"{1}\" text-anchor=\"end\">{2} →</text>\n<text x=\"{5}\" y=\"{3}\">↑ {4}</text>\n",
                     layout.width - edge - 10, bottom - 10, escape_xml(picture.right), top + 20, escape_xml(picture.up),
                     edge + 10);
  const double line = bottom + 24;
  out += fmt::format(
      "<path d=\"M{5} {0}v8h{1:.1f}v-8\" fill=\"none\" stroke=\"#808080\" stroke-width=\"2\"/>\n"
      "<text x=\"{2:.1f}\" y=\"{3}\">{4}</text>\n",
      line - 8, bar_px, edge + 8 + bar_px, line, length_text(bar, 3), edge);
  const auto entry = [&](double x, double y, const char* stroke, const std::string& label) {
    return fmt::format("<path d=\"M{0} {1}h32\" {2}/><text x=\"{3}\" y=\"{4}\">{5}</text>\n", x, y - 4, stroke, x + 40, y,
                       escape_xml(shorten(label, layout.legend_below ? 42 : 1000)));
  };
  const bool below_bar = layout.legend_below;
  out += entry(below_bar ? edge : 300, below_bar ? line + 24 : line, "stroke=\"#d55e00\" stroke-width=\"1.5\"",
               picture.rotating.label);
  out += entry(below_bar ? edge : 540, below_bar ? line + 46 : line,
               "stroke=\"#0072b2\" stroke-width=\"3\" stroke-dasharray=\"7 4\"", picture.reference.label);
  return out + "</svg>\n";
}

}  // namespace

double round_down(double number) {
  const double decade = real::power_of_ten(static_cast<int>(std::floor(real::log10(number)))), lead = number / decade;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * decade;
}

std::string length_text(double m, int digits) {
  struct Unit {
    const char* name;
    double m;
  };
  constexpr Unit kUnits[] = {{"km", 1e3}, {"m", 1}, {"mm", 1e-3}, {"µm", 1e-6}, {"nm", 1e-9}};
  for (const Unit& unit : kUnits)
    if (std::abs(m) >= 0.999 * unit.m) return fmt::format("{:.{}g} {}", m / unit.m, digits, unit.name);
  return fmt::format("{:.{}g} m", m, digits);
}

Drawings path_svg(const PathPicture& picture) { return {drawn(picture, kWide), drawn(picture, kNarrow)}; }

}  // namespace earthtop::report
