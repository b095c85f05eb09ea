// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/first_figure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "earthtop/elementary.hpp"
#include "earthtop/scene/top_figures.hpp"
#include "report/finding.hpp"
#include "report/path_picture.hpp"
#include "text/number_words.hpp"
#include "text/short_number.hpp"

namespace earthtop::report {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr const char* kWithout = "without it";
std::string with_cause(const Run& run) { return fmt::format("with {}", run.compared().cause); }

/// An angle without its jumps by a whole period.
void unwrap(std::vector<double>& angles, double period) {
  for (std::size_t i = 1; i < angles.size(); ++i) angles[i] -= period * std::floor((angles[i] - angles[i - 1]) / period + 0.5);
}

/// Where a pendulum's bob is farthest from the vertical, once in each half swing: the times, and the azimuths of its plane of swing,
/// clockwise from North and counted on beyond half turns.
struct Extremes {
  std::vector<double> t_s, azimuth;
};
Extremes extremes(const Motion& motion, const char* first) {
  Extremes found;
  const std::size_t at = column(first);
  const auto part = [&](std::size_t row, std::size_t k) { return motion.rows[row].value[at + k]; };
  const auto far = [&](std::size_t row) { return part(row, 0) * part(row, 0) + part(row, 1) * part(row, 1); };
  for (std::size_t i = 1; i + 1 < motion.rows.size(); ++i) {
    if (motion.a_window > 0 && (i % motion.a_window == 0 || (i + 1) % motion.a_window == 0)) continue;
    const double before = far(i - 1), here = far(i), after = far(i + 1);
    if (!(here > before && here >= after)) continue;
    // The parabola through three points, for each component.
    const double u = 0.5 * (before - after) / (before - 2 * here + after);
    const auto there = [&](std::size_t k) {
      return part(i, k) + u / 2 * (part(i + 1, k) - part(i - 1, k)) +
             u * u / 2 * (part(i + 1, k) - 2 * part(i, k) + part(i - 1, k));
    };
    found.t_s.push_back(motion.rows[i].t_s + u * (motion.rows[i + 1].t_s - motion.rows[i].t_s));
    found.azimuth.push_back(real::atan2(there(0), there(1)));
  }
  unwrap(found.azimuth, std::numbers::pi);
  return found;
}

/// "1.884° at 600 s".
std::string told_at(double rad, double bound_rad, double t_s, const TimeUnit& time) {
  return fmt::format("{}° at {:.4g} {}", short_number(rad * kDegrees, std::isfinite(bound_rad) ? bound_rad * kDegrees : 0),
                     t_s * time.per_s, time.name);
}

/// The path of the bob seen from above; a band where swings are denser than pixels.
std::string rosette(const Run& run, Page& page, const PlaneTurn& turn, std::size_t half_swings) {
  const double length_m = run.scene ? run.scene->top().center_of_mass_m[2] : -1;
  PathPicture picture;
  picture.name = "rosette";
  picture.title = "Path of the bob, seen from above";
  picture.right = "East";
  picture.up = "North";
  const auto path_of = [&](std::string label, const std::string& first) {
    Path path{std::move(label), values(run.drawn, first + "_x", length_m), values(run.drawn, first + "_y", length_m)};
    if (run.drawn.a_window > 0)  // between windows nothing is known
      for (std::size_t i = run.drawn.a_window; i < path.x.size(); i += run.drawn.a_window) path.x[i] = kNoNumber;
    return path;
  };
  picture.rotating = path_of(with_cause(run), "axis_L");
  picture.reference = path_of(kWithout, "ref_axis_L");
  constexpr double kRim_px = 200, kDense_px = 4;
  constexpr std::size_t kMany = 20;
  const bool is_dense = half_swings > kMany && std::abs(turn.rad) / static_cast<double>(half_swings) * kRim_px < kDense_px;
  if (is_dense) {
    picture.rotating.last_swing =
        std::min(run.drawn.rows.size(), 2 * run.drawn.rows.size() / std::max<std::size_t>(half_swings, 1));
    if (run.drawn.a_window > 0) picture.rotating.last_swing = run.drawn.a_window - 1;
  }
  picture.subtitle = fmt::format("The plane of the swing has turned by {}° {}",
                                 short_number(std::abs(turn.rad) * kDegrees, turn.bound_rad * kDegrees),
                                 turn.rad > 0 ? "clockwise" : "counterclockwise");
  std::vector<std::vector<std::string>> rows;
  const std::vector<compare::Row>& listed = run.listed.rows;
  constexpr std::size_t kMostListed = 200;
  for (std::size_t i = 0; i < listed.size(); i += std::max<std::size_t>(1, (listed.size() + kMostListed - 1) / kMostListed)) {
    rows.push_back({fmt::format("{:.7g}", listed[i].t_s * run.time.per_s)});
    for (const char* name : {"axis_L_x", "axis_L_y", "ref_axis_L_x", "ref_axis_L_y"})
      rows.back().push_back(fmt::format("{:.7g}", value(listed[i], column(name)) * length_m));
  }
  return page.picture("rosette", path_svg(picture),
                      std::string("The same scale in both directions. Rings: start. Dots: end. ") +
                          (is_dense ? "Pale: all swings; dark: the last one. " : "") + run.drawn_words,
                      table_html({fmt::format("Time ({})", run.time.name), "East (m)", "North (m)", "prediction, East (m)",
                                  "prediction, North (m)"},
                                 rows));
}

/// A chart of one panel with both motions; of a label that is empty no line.
Figure both(const Run& run, const char* title, const char* label, const char* unit, Line with, Line without) {
  Panel panel{{label, unit}, {}};
  with.label = with_cause(run);
  without.label = kWithout;
  with.color = LineColor::vermillion;  // the colours of the pictures that move
  without.style = LineStyle::dashed;
  panel.lines = {std::move(with), std::move(without)};
  panel.labels_at_lines = true;
  return {title, title_of(run), {"Time", run.time.name}, {std::move(panel)}};
}

bool add_plane(const Run& run, Page& page) {
  const auto turn = plane_turn(run);
  if (!turn) return false;
  const Extremes with = extremes(run.drawn, "axis_L_x"), without = extremes(run.drawn, "ref_axis_L_x");
  if (with.t_s.size() < 3 || without.t_s.size() < 3) return false;
  const double half_turns = std::floor((with.azimuth[0] - without.azimuth[0]) / std::numbers::pi + 0.5);
  const auto line = [&](const Extremes& of, double from) {
    Line made;
    for (std::size_t i = 0; i < of.t_s.size(); ++i) {
      made.x.push_back(of.t_s[i] * run.time.per_s);
      made.y.push_back((of.azimuth[i] - from) * kDegrees);
    }
    return made;
  };
  Line turned = line(with, without.azimuth[0] + half_turns * std::numbers::pi);
  turned.end_label = told_at(turn->rad, turn->bound_rad, run.number("/outcome/reached_s").value_or(0), run.time);
  Figure figure = both(run, "The plane of the swing turns", "Turn of the plane of swing, clockwise from above", "degrees",
                       std::move(turned), line(without, without.azimuth[0]));
  // The first picture that the page is given is its small one, too: the chart.
  const std::string chart =
      page.chart("plane", std::move(figure), "The azimuth of the bob where it is farthest from the vertical.");
  page.section("plane", "The plane of the swing", rosette(run, page, *turn, with.t_s.size()) + chart);
  return true;
}

/// Whether the summary says that the axis of a gyrocompass swings about North.
bool swings_about_north(const Run& run) {
  for (std::size_t i = 0; !run.word(fmt::format("/why/{}/name", i)).empty(); ++i)
    if (run.word(fmt::format("/why/{}/name", i)) == "swings_about_north") return true;
  for (std::size_t i = 0; !run.word(fmt::format("/theory/{}/name", i)).empty(); ++i)
    if (run.word(fmt::format("/theory/{}/name", i)) == "compass_period") return true;
  return false;
}

bool add_compass(const Run& run, Page& page) {
  if (!swings_about_north(run) || run.drawn.rows.size() < 2) return false;
  const auto bearings = [](const Motion& motion, const std::string& axis) {
    std::vector<double> east = values(motion, axis + "_x"), north = values(motion, axis + "_y");
    for (std::size_t i = 0; i < east.size(); ++i) east[i] = real::atan2(east[i], north[i]);
    unwrap(east, 2 * std::numbers::pi);
    return east;
  };
  const ReadableUnit unit =
      angle_unit(std::max(largest_size(bearings(run.drawn, "axis_L")), largest_size(bearings(run.drawn, "ref_axis_L"))));
  const auto figure = [&](const Motion& motion) {
    const auto line = [&](const char* axis) {
      std::vector<double> y = bearings(motion, axis);
      for (double& bearing : y) bearing *= unit.per_si;
      return line_of(motion, "", times(run, motion), std::move(y));
    };
    return both(run, "The axis swings about North", "Bearing of the axis, clockwise from North", std::string(unit.name).c_str(),
                line("axis_L"), line("ref_axis_L"));
  };
  page.section("compass", "The swing about North",
               page.chart("compass", figure(run.drawn), figure(run.listed), "North is at 0."));
  return true;
}

void add_turn_over(const Run& run, Page& page) {
  bool turns_over = false;
  for (std::size_t i = 0; !run.word(fmt::format("/contact/events/{}/event", i)).empty(); ++i)
    turns_over = turns_over || run.word(fmt::format("/contact/events/{}/event", i)) == "inverted";
  if (!turns_over || run.drawn.rows.size() < 2) return;
  const auto figure = [&](const Motion& motion) {
    std::vector<double> y = values(motion, "axis_L_z");
    const std::vector<double> east = values(motion, "axis_L_x"), north = values(motion, "axis_L_y");
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = real::atan2(real::hypot(east[i], north[i]), y[i]) * kDegrees;
    const double end = y.back() / kDegrees;
    Line line = line_of(motion, "", times(run, motion), std::move(y));
    line.end_label = told_at(end, 0, motion.rows.back().t_s, run.time);
    line.color = LineColor::vermillion;
    Panel panel{{"Angle of the axis from the vertical", "degrees"}, {std::move(line)}};
    panel.labels_at_lines = true;
    return Figure{"The top turns over", title_of(run), {"Time", run.time.name}, {std::move(panel)}};
  };
  page.section("turn-over", "The turn-over",
               page.chart("turn-over", figure(run.drawn), figure(run.listed),
                          "With the Earth's rotation: 0 is upright, 180 upside down."));
}

}  // namespace

bool add_first_figure(const Run& run, Page& page) {
  if (add_plane(run, page)) return true;
  if (!add_compass(run, page)) add_turn_over(run, page);
  return false;
}

}  // namespace earthtop::report
