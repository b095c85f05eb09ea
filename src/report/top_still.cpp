// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/top_still.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "earthtop/elementary.hpp"
#include "plot/palette.hpp"
#include "plot/strokes.hpp"
#include "plot/svg_text.hpp"
#include "plot/trace.hpp"
#include "report/path_picture.hpp"

namespace earthtop::report {
namespace {

using Vec = Eigen::Vector3d;

constexpr double kSeen_rad = 0.2;  // at most, the angle between the axes as it is drawn

Vec vector(const std::array<double, 3>& list) { return {list[0], list[1], list[2]}; }

double angle_between(const Vec& a, const Vec& b) { return real::atan2(a.cross(b).norm(), a.dot(b)); }

/// The eye stands in the South-East, somewhat above the ground; the picture's units are the length of the axis.
class View {
 public:
  View(double width, double height, double middle_y)
      : scale_(0.46 * std::min(0.78 * width, height)), x_(width / 2), y_(middle_y) {
    constexpr double kTurn = 0.6, kRise = 0.35;  // rad
    right_ = {real::cos(kTurn), real::sin(kTurn), 0};
    up_ = {-real::sin(kTurn) * real::sin(kRise), real::cos(kTurn) * real::sin(kRise), real::cos(kRise)};
  }
  PlotPoint at(const Vec& p) const { return {x_ + scale_ * p.dot(right_), y_ - scale_ * p.dot(up_)}; }
  /// Moves the picture up as far as these points are below a line.
  void keep_above(double floor, const std::vector<Vec>& points) {
    double lowest = floor;
    for (const Vec& point : points) lowest = std::max(lowest, at(point).y);
    y_ -= lowest - floor;
  }

 private:
  double scale_, x_, y_;
  Vec right_, up_;
};

std::string polyline(const View& view, const std::vector<Vec>& points, std::string_view attributes, bool is_closed = false) {
  std::string d;
  for (const Vec& point : points) {
    const PlotPoint at = view.at(point);
    d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", at.x, at.y);
  }
  return fmt::format("<path d=\"{}{}\" {}/>\n", d, is_closed ? "Z" : "", attributes);
}

/// A circle about an axis through a point.
std::vector<Vec> circle(const Vec& centre, const Vec& axis, double radius) {
  const Vec p = axis.unitOrthogonal(), q = axis.cross(p);
  std::vector<Vec> points;
  constexpr int kPoints = 72;
  for (int k = 0; k < kPoints; ++k) {
    const double turn = 2 * std::numbers::pi * k / kPoints;
    points.push_back(centre + radius * (real::cos(turn) * p + real::sin(turn) * q));
  }
  return points;
}

/// Writes a label beside a place, and moved so far that it does not leave the picture.
void label(std::string& out, const View& view, double width, const Vec& place, double dx, double dy, bool is_left,
           std::string_view text) {
  constexpr double kCharacter = 7.4, kEdge = 6;  // px
  const PlotPoint at = view.at(place);
  const double length = kCharacter * static_cast<double>(text.size()), x = at.x + dx;
  const double kept = is_left ? std::max(x, kEdge + length) : std::min(x, width - kEdge - length);
  draw_text(out, kept, at.y + dy, is_left ? "end" : "start", " class=\"et-b\" font-weight=\"600\"", text);
}

std::string drawn(const TopStill& still, double width, double height) {
  const bool is_narrow = width < 400;
  const double top = 60, factor = magnification(still);
  View view(width, height - top, still.hangs ? top + 0.32 * (height - top) : top + 0.7 * (height - top));
  const Vec reference = vector(still.ref_axis_L), axis = vector(still.axis_L), up(0, 0, 1);
  const Vec turn = reference.cross(axis);
  const double apart = angle_between(reference, axis), shown = std::min(apart * factor, kSeen_rad);
  const Vec across = turn.cross(reference).normalized();  // the null vector stays what it is
  const Vec seen = real::cos(shown) * reference + real::sin(shown) * across;
  const double side = still.hangs ? -1 : 1, length = 1.15;
  const Vec place = 0.58 * side * seen;
  std::vector<Vec> drawn_points = circle(place, seen, 0.42);
  drawn_points.insert(drawn_points.end(), {side * length * seen, side * length * reference});
  view.keep_above(height - 20, drawn_points);
  const std::string blue = fmt::format("fill=\"none\" stroke=\"{}\"", hex(LineColor::blue)),
                    red = fmt::format("fill=\"none\" stroke=\"{}\"", hex(LineColor::vermillion)),
                    grey = fmt::format("fill=\"none\" stroke=\"{}\"", hex(LineColor::grey));
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"et\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\" "
      "fill=\"{3}\" font-family=\"sans-serif\" font-size=\"{5}\">\n<title>{2}</title>\n<rect class=\"et-page\" "
      "fill=\"{4}\" "
      "width=\"{0}\" height=\"{1}\"/>\n",
      width, height, escape_xml(still.title), kText.light, kPage.light, kLabelSize);
  const std::string heading =
      fmt::format(" class=\"et-h\" fill=\"{}\" font-size=\"{}\" font-weight=\"600\"", kHeading.light, kTitleSize);
  draw_text(out, 24, 30, "start", heading.c_str(), still.title);
  double line_y = 50;
  for (const std::string& line : lines_of(still.subtitle, is_narrow ? 50 : 100, 2)) {
    draw_text(out, 24, line_y, "start", " class=\"et-s\"", line);
    line_y += 16;
  }
  // The ground, North on it, and Up.
  out += polyline(view, circle({0, 0, 0}, up, 1.25), grey + " stroke-width=\"1\"", true);
  out += polyline(view, {Vec(0, 0, 0), Vec(0, 1.25, 0)}, grey + " stroke-width=\"1\"");
  label(out, view, width, Vec(0, 1.25, 0), 4, -4, false, "North");
  out += polyline(view, {Vec(0, 0, 0), Vec(0, 0, side * 1.25)}, grey + " stroke-width=\"1\" stroke-dasharray=\"2 4\"");
  const double tilt_cos = reference[2];
  if (still.has_cone)
    out += polyline(view,
                    circle(Vec(0, 0, side * length * tilt_cos), up, length * std::sqrt(std::max(0.0, 1 - tilt_cos * tilt_cos))),
                    red + " stroke-width=\"1\" stroke-dasharray=\"1 4\"", true);
  if (const Vec earth = vector(still.earth_rate_L); earth.norm() > 0) {
    const Vec end = 1.35 * side * earth.normalized();
    out += polyline(view, {-0.25 * end, end},
                    fmt::format("fill=\"none\" class=\"et-frame\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"8 4\"",
                                kMuted.light));
    const PlotPoint at = view.at(end), north = view.at(Vec(0, 1.25, 0));
    const bool is_at_north = std::abs(at.x - north.x) < 60 && std::abs(at.y - north.y) < 16;
    label(out, view, width, end, 6, is_at_north ? -20 : 0, false, "the Earth's axis");
  }
  // The top: its stem, and its disc, which hides what is behind it.
  out += polyline(view, {Vec(0, 0, 0), side * length * reference}, blue + " stroke-width=\"2.5\" stroke-dasharray=\"7 4\"");
  out += polyline(view, {Vec(0, 0, 0), place}, red + " stroke-width=\"3\"");
  out += polyline(view, circle(place, seen, 0.42),
                  fmt::format("fill=\"#d6dbe3\" fill-opacity=\"0.9\" stroke=\"{}\" stroke-width=\"1.5\"", kMuted.light), true);
  out += polyline(view, {place, side * length * seen}, red + " stroke-width=\"3\"");
  const PlotPoint at = view.at(side * length * seen), other = view.at(side * length * reference);
  const bool is_left = at.x < other.x;
  label(out, view, width, side * length * seen, is_left ? -8 : 8, -4, is_left, "its axis");
  label(out, view, width, side * length * reference, is_left ? 8 : -8, 14, !is_left, fmt::format("without {}", still.cause));
  return out + "</svg>\n";
}

}  // namespace

double magnification(const TopStill& still) {
  const double apart = angle_between(vector(still.ref_axis_L), vector(still.axis_L));
  return apart > 0 ? std::max(1.0, round_down(kSeen_rad / apart)) : 1;
}

Drawings top_still_svg(const TopStill& still) { return {drawn(still, 640, 480), drawn(still, 340, 340)}; }

}  // namespace earthtop::report
