// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/track_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "earthtop/elementary.hpp"
#include "plot/palette.hpp"
#include "plot/strokes.hpp"
#include "plot/svg_text.hpp"
#include "plot/trace.hpp"
#include "report/path_picture.hpp"

namespace earthtop::report {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kShortest_m = 1e-3;  // a shorter way has no map: its graticule would need more digits than one can read

/// The measures of the map (px).
struct MapSheet {
  double width, edge, margin, lowest, tallest, widest_bar, least_px;
  std::size_t title_characters, subtitle_characters;
  bool legend_below;
  const char* suffix;
};
constexpr MapSheet kWideMap{860, 24, 36, 240, 480, 160, 60, 1000, 130, false, ""},
    kNarrowMap{340, 8, 20, 160, 324, 110, 40, 30, 46, true, "-narrow"};
constexpr double kMapTop = 76, kMapTitleHeight = 20, kMapLineHeight = 16, kMapLegendHeight = 22;

struct Degrees {
  double low, high;
  double middle() const { return low + (high - low) / 2; }
};
Degrees range_of(const std::vector<double>& list) {
  const auto [low, high] = std::ranges::minmax(list);
  return {low, high};
}

/// The steps between the lines of a graticule, from the widest (deg).
std::vector<double> steps() {
  std::vector<double> list{90, 45, 30, 15, 10, 5, 2, 1};
  for (int decade = -1; decade >= -9; --decade)
    for (const double lead : {5.0, 2.0, 1.0}) list.push_back(lead * real::power_of_ten(decade));
  return list;
}
/// The decimals that a multiple of a step needs.
int decimals_of(double step) { return step >= 1 ? 0 : static_cast<int>(std::ceil(-real::log10(step) - 1e-9)); }

/// Where degrees beside the start are in the picture (px).
struct MapFrame {
  Degrees east, north;         ///< what the frame shows (deg)
  double left, top;            ///< of the frame
  double width, height;        ///< of the frame
  double per_east, per_north;  ///< px per degree
  double x(double deg) const { return left + (deg - east.low) * per_east; }
  double y(double deg) const { return top + height - (deg - north.low) * per_north; }
};

struct GraticuleLine {
  double deg;  ///< beside the start
  std::string label;
};
using LabelOf = std::string (*)(double, int);

double width_of(std::string_view text) { return static_cast<double>(character_count(text)) * kCharacter; }

/// The lines of a graticule in one direction: the narrowest step that leaves enough px between two of them, or the widest that shows two
/// labels. @param drop  clears the labels that have no room
template <class Drop>
std::vector<GraticuleLine> lines_in(const Degrees& shown, double start_deg, double per_deg, double least_px, LabelOf label,
                                    const Drop& drop) {
  std::vector<GraticuleLine> lines;
  const auto has_label = [](const GraticuleLine& line) { return !line.label.empty(); };
  for (const double step : steps()) {
    if (step * per_deg < least_px && std::ranges::count_if(lines, has_label) > 1) break;
    lines.clear();
    const double first = std::ceil((start_deg + shown.low) / step - 1e-9);
    for (double k = first; k * step <= start_deg + shown.high + 1e-9 * step; ++k)
      lines.push_back({k * step - start_deg, label(k * step, decimals_of(step))});
    drop(lines);
  }
  return lines;
}

/// Longitudes on one turn about the middle of the map; a way that leaves it on one side comes back on the other.
std::vector<std::vector<PlotPoint>> pieces_of(const Track& track, const MapFrame& map, double middle_deg) {
  std::vector<std::vector<PlotPoint>> pieces(1);
  const auto turn_of = [&](double east) { return std::floor((east - middle_deg) / 360 + 0.5); };
  const auto add = [&](double east, double north) {
    const PlotPoint point{map.x(east), map.y(north)};
    constexpr double kSeen_px = 0.2;
    std::vector<PlotPoint>& points = pieces.back();
    if (points.empty() || std::abs(points.back().x - point.x) + std::abs(points.back().y - point.y) > kSeen_px)
      points.push_back(point);
  };
  for (std::size_t i = 0; i < track.east_deg.size(); ++i) {
    const double east = track.east_deg[i], north = track.north_deg[i], turn = turn_of(east);
    if (i > 0) {
      const double before = turn_of(track.east_deg[i - 1]);
      if (before != turn) {
        const double edge = middle_deg + 360 * (std::max(before, turn) - 0.5), last = track.east_deg[i - 1];
        const double share = (edge - last) / (east - last),
                     there = track.north_deg[i - 1] + share * (north - track.north_deg[i - 1]);
        add(edge - 360 * before, there);
        pieces.emplace_back();
        add(edge - 360 * turn, there);
      }
    }
    add(east - 360 * turn, north);
  }
  return pieces;
}

std::string drawn(const Track& track, const MapSheet& sheet) {
  const Degrees north = range_of(track.north_deg), east = range_of(track.east_deg);
  const double middle_deg = middle_latitude_deg(track), ratio = real::cos(middle_deg * kDegree);
  const bool goes_round = east.high - east.low > 360.5;
  const double middle_east = goes_round ? 0 : east.middle(), wide = goes_round ? 360 : east.high - east.low;

  const auto title = lines_of(track.title, sheet.title_characters, 3);
  const auto subtitle = lines_of(track.subtitle, sheet.subtitle_characters, 4);
  const double subtitle_y = 52 + kMapTitleHeight * static_cast<double>(title.size() - 1);
  const double top = subtitle_y + kMapTop - 52 + kMapLineHeight * static_cast<double>(subtitle.size() - 1);

  // Twice: the labels of the latitudes need room at the left, which the scale depends on.
  MapFrame map{};
  std::vector<GraticuleLine> parallels;
  double label_px = 40;
  for (int pass = 0; pass < 2; ++pass) {
    map.left = sheet.edge + label_px + 8, map.top = top;
    map.width = sheet.width - sheet.edge - map.left;
    const double high = north.high - north.low, room = map.width - (goes_round ? 0 : 2 * sheet.margin);
    map.per_north =
        std::min(wide > 0 ? room / (wide * ratio) : HUGE_VAL, high > 0 ? (sheet.tallest - 2 * sheet.margin) / high : HUGE_VAL);
    map.per_east = map.per_north * ratio;
    map.width = std::min(map.width, 360 * map.per_east);
    map.height = std::clamp(high * map.per_north + 2 * sheet.margin, sheet.lowest, sheet.tallest);
    const double half_east = map.width / map.per_east / 2, half_north = map.height / map.per_north / 2;
    map.east = {middle_east - half_east, middle_east + half_east};
    // There is nothing beyond the poles.
    double centre = north.middle();
    const double to_north = 90 - track.start_latitude_deg, to_south = -90 - track.start_latitude_deg;
    if (2 * half_north < 180) centre = std::clamp(centre, to_south + half_north, to_north - half_north);
    map.north = {centre - half_north, centre + half_north};
    parallels = lines_in({std::max(map.north.low, to_south), std::min(map.north.high, to_north)}, track.start_latitude_deg,
                         map.per_north, sheet.least_px, latitude_text, [](const auto&) {});
    label_px = 0;
    for (const GraticuleLine& line : parallels) label_px = std::max(label_px, width_of(line.label));
  }
  const auto drop_labels = [&](std::vector<GraticuleLine>& lines) {
    double free_from = 0;
    for (GraticuleLine& line : lines) {
      const double x = map.x(line.deg), half = width_of(line.label) / 2;
      if (x - half < free_from || x + half > sheet.width)
        line.label.clear();
      else
        free_from = x + half + 8;
    }
  };
  const std::vector<GraticuleLine> meridians =
      lines_in(map.east, track.start_longitude_deg, map.per_east, 84, longitude_text, drop_labels);

  const double bottom = map.top + map.height, right = map.left + map.width, legend_y = bottom + 46;
  const double height = legend_y + 14 + (sheet.legend_below ? kMapLegendHeight : 0);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"et\" width=\"{0}\" height=\"{1:.0f}\" viewBox=\"0 0 {0} {1:.0f}\" "
      "role=\"img\" fill=\"{2}\" font-family=\"sans-serif\" font-size=\"{3}\">\n<title>{4}</title>\n",
      sheet.width, height, kText.light, kLabelSize, escape_xml(track.title));
  out += fmt::format("<desc>{}</desc>\n", escape_xml(track.subtitle));
  out +=
      fmt::format("<rect class=\"et-page\" fill=\"{}\" width=\"{}\" height=\"{:.0f}\"/>\n", kPage.light, sheet.width, height);
  const std::string heading =
      fmt::format(" class=\"et-h\" fill=\"{}\" font-size=\"{}\" font-weight=\"600\"", kHeading.light, kTitleSize);
  draw_lines(out, sheet.edge, 30, "start", heading.c_str(), title, kMapTitleHeight);
  draw_lines(out, sheet.edge, subtitle_y, "start", " class=\"et-s\"", subtitle, kMapLineHeight);

  // The graticule with its labels, of which none overlaps the one before.
  const auto rule = [&](double x1, double y1, double x2, double y2) {
    out += fmt::format("<path class=\"et-grid\" stroke=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", kGrid.light, x1, y1, x2,
                       y2);
  };
  for (const GraticuleLine& line : parallels) {
    const double y = map.y(line.deg);
    rule(map.left, y, right, y);
    draw_text(out, map.left - 6, y + 4, "end", "", line.label);
  }
  for (const GraticuleLine& line : meridians) {
    const double x = map.x(line.deg);
    rule(x, map.y(std::min(map.north.high, 90 - track.start_latitude_deg)), x,
         map.y(std::max(map.north.low, -90 - track.start_latitude_deg)));
    if (!line.label.empty()) draw_text(out, x, bottom + 18, "middle", "", line.label);
  }
  out += fmt::format(
      "<rect class=\"et-frame\" stroke=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\"/>\n",
      kMuted.light, map.left, map.top, right - map.left, map.height);

  // The way; its start is a ring and its end a dot, which are seen where both are one place, too.
  const std::string_view ink = hex(LineColor::vermillion);
  std::string way;
  for (std::vector<PlotPoint> points : pieces_of(track, map, middle_east)) {
    thin_out(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      way += fmt::format("{}{:.1f} {:.1f}", i > 0 ? "L" : "M", points[i].x, points[i].y);
  }
  out +=
      fmt::format("<path id=\"track{}\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\"/>\n",
                  sheet.suffix, way, ink);
  const auto ring = [&](double x, double y) {
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", x, y,
                       ink);
  };
  const auto dot = [&](double x, double y) {
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", x, y, ink);
  };
  const auto on_map = [&](double deg) { return map.x(deg - 360 * std::floor((deg - middle_east) / 360 + 0.5)); };
  out += ring(on_map(track.east_deg.front()), map.y(track.north_deg.front()));
  out += dot(on_map(track.east_deg.back()), map.y(track.north_deg.back()));

  // The scale, and what the marks are.
  const double per_m = map.per_east / (track.radius_m * ratio * kDegree);
  const double bar_m = round_down(sheet.widest_bar / per_m), bar_px = bar_m * per_m;
  out += fmt::format(
      "<path class=\"et-frame\" d=\"M{:.1f} {:.1f}v8h{:.1f}v-8\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", map.left,
      legend_y - 8, bar_px, kMuted.light);
  draw_text(out, map.left + bar_px + 8, legend_y, "start", "", length_text(bar_m, 6));
  const double marks_y = legend_y + (sheet.legend_below ? kMapLegendHeight : 0),
               marks_x = sheet.legend_below ? map.left + 8 : map.left + 300;
  out += ring(marks_x, marks_y - 4) + dot(marks_x + 90, marks_y - 4);
  draw_text(out, marks_x + 14, marks_y, "start", "", "start");
  draw_text(out, marks_x + 104, marks_y, "start", "", "end");
  return out + "</svg>\n";
}

}  // namespace

double middle_latitude_deg(const Track& track) {
  return std::clamp(track.start_latitude_deg + range_of(track.north_deg).middle(), -89.95, 89.95);
}

bool has_map(const Track& track) {
  const Degrees north = range_of(track.north_deg), east = range_of(track.east_deg);
  const double high = north.high - north.low, wide = (east.high - east.low) * real::cos(middle_latitude_deg(track) * kDegree);
  constexpr double kLargest_m = 1e12;  // no planet's; results may say anything
  const double extent_m = std::max(high, wide) * kDegree * track.radius_m;
  return track.radius_m <= kLargest_m && extent_m >= kShortest_m;
}

std::string latitude_text(double deg, int decimals) {
  const std::string number = fmt::format("{:.{}f}°", std::abs(deg), decimals);
  const bool is_zero = number.find_first_of("123456789") == number.npos;
  return is_zero ? number : number + (deg > 0 ? " N" : " S");
}

std::string longitude_text(double deg, int decimals) {
  const double one_turn = deg - 360 * std::floor((deg + 180) / 360);  // [-180, 180)
  const std::string number = fmt::format("{:.{}f}°", std::abs(one_turn), decimals);
  const bool is_zero = number.find_first_of("123456789") == number.npos,
             is_half = number == fmt::format("{:.{}f}°", 180.0, decimals);
  return is_zero || is_half ? number : number + (one_turn > 0 ? " E" : " W");
}

std::string place_text(const Track& track, double north_deg, double east_deg) {
  const Degrees north = range_of(track.north_deg), east = range_of(track.east_deg);
  const double apart = std::max(north.high - north.low, std::min(360.0, east.high - east.low));
  constexpr int kFewest = 1, kMost = 10, kFiner = 3;
  const int decimals =
      apart > 0 ? std::clamp(kFiner - static_cast<int>(std::ceil(real::log10(apart))), kFewest, kMost) : kFewest;
  return latitude_text(track.start_latitude_deg + north_deg, decimals) + ", " +
         longitude_text(track.start_longitude_deg + east_deg, decimals);
}

Drawings track_svg(const Track& track) { return {drawn(track, kWideMap), drawn(track, kNarrowMap)}; }

}  // namespace earthtop::report
