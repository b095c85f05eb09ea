// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures show the motion: as another method sees it a hundred times in each of its swings, whatever the output rows are.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/report/report.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "support/json.hpp"
#include "support/page_data.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

using testing::data_of, testing::TemporaryDirectory;

constexpr double kPixel = 1;   // by how much a picture may differ from the motion (px)
constexpr double kColumn = 4;  // width of a band's columns: an edge stands for the values of one (px)

struct Point {
  double x, y;
};

/// A line as a picture has it: strokes, and bands as their outlines.
struct Drawn {
  std::vector<std::vector<Point>> strokes, bands;
};

std::vector<Point> points_of(std::string path) {
  std::replace_if(
      path.begin(), path.end(), [](char c) { return c == 'M' || c == 'L' || c == 'Z'; }, ' ');
  std::istringstream numbers(path);
  std::vector<Point> points;
  for (Point point{}; numbers >> point.x >> point.y;) points.push_back(point);
  return points;
}

/// The lines of one colour in a part of a picture.
Drawn drawn_in(const std::string& picture, const std::string& color) {
  static const std::regex kPath(
      "<path d=\"(M[^\"hV]*)\" (class=\"et-band\" )?fill=\"[^\"]*\"[^>]* stroke=\"([^\"]*)\" stroke-width=\"1.8\"");
  Drawn drawn;
  for (std::sregex_iterator at(picture.begin(), picture.end(), kPath), end; at != end; ++at)
    if ((*at)[3] == color) ((*at)[2].matched ? drawn.bands : drawn.strokes).push_back(points_of((*at)[1]));
  return drawn;
}

double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double along = length > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

/// How far a point is from a line; 0 within its bands.
class Cover {
 public:
  explicit Cover(const Drawn& drawn) {
    for (const auto& stroke : drawn.strokes)
      for (std::size_t i = 0; i + 1 < stroke.size(); ++i) add(segments_, {stroke[i], stroke[i + 1]});
    for (const auto& band : drawn.bands) {
      for (std::size_t i = 0; i < band.size(); ++i) add(segments_, {band[i], band[(i + 1) % band.size()]});
      // The upper edge goes to the right, the lower one back.
      const auto turn = std::ranges::adjacent_find(band, [](Point a, Point b) { return b.x <= a.x; }) + 1;
      bands_.push_back({{band.begin(), turn}, {band.rbegin(), std::make_reverse_iterator(turn)}});
    }
  }
  double away(Point p) const {
    for (const auto& [upper, lower] : bands_)
      if (p.x >= upper.front().x && p.x <= upper.back().x && p.y >= y_at(upper, p.x) && p.y <= y_at(lower, p.x)) return 0;
    double least = HUGE_VAL;
    const auto place = static_cast<int>(std::floor(p.x / kCell));
    for (int cell = place - 1; cell <= place + 1; ++cell)
      if (const auto found = segments_.find(cell); found != segments_.end())
        for (const auto& [a, b] : found->second) least = std::min(least, distance(p, a, b));
    return least;
  }

 private:
  using Segment = std::pair<Point, Point>;
  static constexpr double kCell = 4;
  static double y_at(const std::vector<Point>& edge, double x) {
    auto after = std::ranges::upper_bound(edge, x, {}, &Point::x);
    if (after == edge.end()) return edge.back().y;
    const Point a = *(after - 1), b = *after;
    return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
  }
  static void add(std::map<int, std::vector<Segment>>& to, const Segment& segment) {
    const auto low = static_cast<int>(std::floor(std::min(segment.first.x, segment.second.x) / kCell)),
               high = static_cast<int>(std::floor(std::max(segment.first.x, segment.second.x) / kCell));
    for (int cell = low; cell <= high; ++cell) to[cell].push_back(segment);
  }
  std::map<int, std::vector<Segment>> segments_;
  std::vector<std::pair<std::vector<Point>, std::vector<Point>>> bands_;  // upper and lower edges
};

/// From data to px, as the frame of a panel says.
struct Map {
  PlotFrame frame;
  double x(double value) const {
    return frame.left + (value - frame.x_low) / (frame.x_high - frame.x_low) * (frame.right - frame.left);
  }
  double y(double value) const {
    const bool is_log = frame.y_scale == AxisScale::logarithmic;
    const auto scaled = [&](double v) { return is_log ? std::log10(v) : v; };
    return frame.floor +
           (scaled(value) - scaled(frame.y_low)) / (scaled(frame.y_high) - scaled(frame.y_low)) * (frame.top - frame.floor);
  }
};

/// Checks that a panel shows the values of a fine reference, and nothing that they are not.
void expect_shows(const Panel& panel, const Axis& x, const std::string& color, const std::vector<double>& t,
                  const std::vector<double>& values, const std::string& what, bool has_corners = false) {
  const Figure alone{"alone", "", x, {panel}};
  const Map map{frame_of(alone)};
  const Drawn drawn = drawn_in(svg(alone), color);
  const Cover cover(drawn);
  const bool is_log = map.frame.y_scale == AxisScale::logarithmic;
  std::vector<Point> reference;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (std::isfinite(values[i]) && (!is_log || values[i] > 0)) reference.push_back({map.x(t[i]), map.y(values[i])});
  ASSERT_GT(reference.size(), 100U) << what;
  double hidden = 0, at = 0;
  for (const Point& point : reference)
    if (const double away = cover.away(point); away > hidden) hidden = away, at = point.x;
  EXPECT_LE(hidden, kPixel) << what << ": the motion is not within what is drawn, at " << at << " px";
  // Each drawn point is one of the motion's: on a band's edge, of its column.
  double invented = 0;
  const auto look = [&](const std::vector<Point>& points, double reach) {
    for (const Point& point : points) {
      const auto begin = std::ranges::lower_bound(reference, point.x - reach - kPixel, {}, &Point::x);
      double least = HUGE_VAL, low = HUGE_VAL, bottom = -HUGE_VAL;
      Point before = begin == reference.begin() ? *begin : *(begin - 1);
      for (auto p = begin; p != reference.end() && before.x <= point.x + reach + kPixel; before = *p, ++p) {
        const bool level = std::min(p->y, before.y) <= point.y && point.y <= std::max(p->y, before.y);
        least = std::min({least, reach > 0 ? (level ? 0 : std::abs(p->y - point.y)) : distance(point, before, *p)});
        low = std::min(low, p->y), bottom = std::max(bottom, p->y);
      }
      // Rows a hundredth of a swing apart do not meet the least value of a length that passes near zero, which has a corner there.
      constexpr double kHundredth = 0.07;  // of a swing's largest, at most, passes between two of them
      if (has_corners && point.y > bottom && point.y < bottom + kHundredth * (map.frame.floor - map.frame.top)) continue;
      if (is_log && point.y > low - std::log10(kHundredth) * (map.frame.floor - map.frame.top) /
                                        std::log10(map.frame.y_high / map.frame.y_low))
        continue;
      if (least > invented) invented = least, at = point.x;
    }
  };
  for (const auto& stroke : drawn.strokes) look(stroke, 0);
  for (const auto& band : drawn.bands) look(band, kColumn);
  EXPECT_LE(invented, kPixel) << what << ": the motion does not come where it is drawn, at " << at << " px";
}

Scenario shipped(const std::string& name) {
  return parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS "/") + name + ".json"), {});
}

/// The same motion by another method, with rows a hundredth of its looks' period apart.
RunResult seen_otherwise(Scenario scenario, const RunResult& result) {
  constexpr double kFiner = 100.0 / 12;
  scenario.numerics.method = result.solution.method == Method::rkf78 ? Method::extrapolation : Method::rkf78;
  scenario.numerics.relative_tolerance = 1e-12;
  scenario.output_step_s = (result.looks[1].t_s - result.looks[0].t_s) / kFiner;
  scenario.sensitivities = false;
  return run(scenario);
}

/// Compares long texts; a failure shows the lines where they part.
void expect_same(const std::string& a, const std::string& b) {
  std::istringstream lines_a(a), lines_b(b);
  for (std::string line_a, line_b; std::getline(lines_a, line_a) && std::getline(lines_b, line_b);)
    if (line_a != line_b) {
      const auto at = static_cast<std::size_t>(std::ranges::mismatch(line_a, line_b).in1 - line_a.begin());
      const std::size_t from = at > 60 ? at - 60 : 0;
      ADD_FAILURE() << line_a.substr(from, 120) << "\n" << line_b.substr(from, 120);
      return;
    }
  EXPECT_EQ(a.size(), b.size());
}

class PicturesOf : public ::testing::TestWithParam<const char*> {};

TEST_P(PicturesOf, AMotionDoNotDependOnRows) {
  Scenario scenario = shipped(GetParam());
  const RunResult result = run(scenario);
  ASSERT_EQ(result.looks_a_window, 0U);
  const Figure figure = drift_figure(result);
  const RunResult other = seen_otherwise(scenario, result);
  ASSERT_EQ(other.status, RunStatus::completed);
  std::vector<double> t, axis, azimuth, tilt;
  const double per_s = figure.panels[0].lines[0].x.back() / result.looks.back().t_s;
  const auto per_rad = [](const Panel& panel) { return 180 / std::numbers::pi * (panel.y.unit == "degrees" ? 1 : 3600); };
  // Beside its secular line, if it has one, the azimuth has the mean 0 over the looks.
  const bool has_azimuth = figure.panels.size() > 1;
  const auto& secular = result.drift.secular;
  const double rate = secular && !secular->of_window ? secular->azimuth_rate_rad_s.value_or(0) : 0;
  double offset = 0;
  for (const DriftRow& look : result.looks)
    if (rate != 0 && has_azimuth)
      offset += (look.drift_azimuth_rad.value_or(NAN) - rate * look.t_s) / static_cast<double>(result.looks.size());
  for (const DriftRow& row : other.rows) {
    if (!row.drift_reliable || !result.verdict.trusts(row.t_s)) break;
    t.push_back(row.t_s * per_s);
    axis.push_back(row.drift_axis_rad * per_rad(figure.panels[0]));
    tilt.push_back(row.drift_tilt_rad * per_rad(figure.panels[0]));
    if (has_azimuth)
      azimuth.push_back((row.drift_azimuth_rad.value_or(NAN) - offset - rate * row.t_s) * per_rad(figure.panels[1]));
  }
  expect_shows(figure.panels[0], figure.x, "#0072b2", t, axis, "axis", true);
  // A pendulum's axis passes the vertical so near that its azimuth turns within a hundredth of a swing.
  if (has_azimuth && std::string(GetParam()) != "foucault-pendulum")
    expect_shows(figure.panels[1], figure.x, "#0072b2", t, azimuth, "azimuth");
  if (figure.panels[0].lines.size() > 1) expect_shows(figure.panels[0], figure.x, "#e69f00", t, tilt, "tilt");
  // To the last byte.
  const std::string picture = svg(figure);
  scenario.output_step_s = scenario.duration_s;
  expect_same(svg(drift_figure(run(scenario))), picture);
  scenario.output_step_s = scenario.duration_s / 7;
  expect_same(svg(drift_figure(run(scenario))), picture);
}

// Sphere and animation have both axes where the motion has them, between the rows, too.
TEST_P(PicturesOf, APageHaveTheAxesOfTheMotion) {
  Scenario scenario = shipped(GetParam());
  scenario.output_step_s = scenario.duration_s / 2;
  const TemporaryDirectory dir;
  const RunResult result = run(scenario);
  write_results(result, dir.path() / "run", false);
  const std::string html = make_report(dir.path() / "run").html;
  const testing::UnpackedAxes axes = testing::unpacked_axes(data_of(html));
  ASSERT_EQ(axes.t_s.size(), result.looks.size());
  // The same times, by another method.
  scenario.output_step_s = scenario.duration_s / static_cast<double>(axes.t_s.size() - 1);
  scenario.numerics.method = result.solution.method == Method::rkf78 ? Method::extrapolation : Method::rkf78;
  const RunResult other = run(scenario);
  ASSERT_EQ(other.rows.size(), axes.t_s.size());
  // Steps of a millionth of the axes' extent, 2 at most, and of the drift; a component that is left out is at least 0.3.
  constexpr double kStep = 1.0 / (1 << 20), kLeftOut = 1 / 0.3;
  for (std::size_t i = 0; i < other.rows.size(); ++i) {
    const DriftRow& row = other.rows[i];
    if (!row.drift_reliable || !result.verdict.trusts(row.t_s)) break;
    double off = 0, apart = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      off = std::max(off, std::abs(axes.ref_axis_L[3 * i + k] - row.ref_axis_L[k]));
      const double drawn = axes.axis_L[3 * i + k] - axes.ref_axis_L[3 * i + k];
      apart = std::max(apart, std::abs(drawn - (row.axis_L[k] - row.ref_axis_L[k])));
    }
    ASSERT_LE(off, 4 * kStep * kLeftOut + row.drift_attitude_bound_rad + result.attitude_bound_rad) << row.t_s;
    ASSERT_LE(apart, 8 * kStep * kLeftOut * result.drift.axis_max_rad + row.drift_axis_bound_rad) << row.t_s;
  }
}

/// Where a panel's axis has its lowest and its highest tick in a picture, from the labels beside it.
struct Labels {
  double low, high, low_px, high_px;
  double value(double px) const { return low + (px - low_px) / (high_px - low_px) * (high - low); }
};
Labels labels_in(const std::string& picture, double top, double bottom) {
  static const std::regex kLabel("<text x=\"66\\.?0*\" y=\"([0-9.]*)\" text-anchor=\"end\"[^>]*>([^<]*)</text>");
  Labels ticks{HUGE_VAL, -HUGE_VAL, 0, 0};
  for (std::sregex_iterator at(picture.begin(), picture.end(), kLabel), end; at != end; ++at) {
    const double y = std::stod((*at)[1]) - 4;
    std::string text = (*at)[2];
    if (text.starts_with("−")) text.replace(0, std::string("−").size(), "-");
    if (y < top || y > bottom) continue;
    const double value = std::stod(text);
    if (value < ticks.low) ticks.low = value, ticks.low_px = y;
    if (value > ticks.high) ticks.high = value, ticks.high_px = y;
  }
  return ticks;
}

// The still in the README is the page's, and the caption's numbers are in the pictures and in the results.
TEST(ReadmePicture, ShowsTheTopAndSaysItsNumbers) {
  const TemporaryDirectory dir;
  const RunResult result = run(shipped("toy-top"));
  write_results(result, dir.path() / "run", false);
  const Report report = make_report(dir.path() / "run");
  const auto made = std::ranges::find(report.pictures, std::string("top"), [](const auto& p) { return p.first; });
  ASSERT_NE(made, report.pictures.end());
  const auto text_of = [](const char* path) {
    std::ifstream file(std::string(EARTHTOP_TESTS "/../") + path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(text_of("tools/readme/toy-top.svg"), made->second) << "make it again: earthtop report out/toy-top --svg";
  const std::string readme = text_of("README.md"), chart = text_of("tools/readme/toy-top-drift.svg");
  const std::string angle = fmt::format("{:.4g}″", result.drift.axis_final_rad * 648000 / std::numbers::pi);
  EXPECT_NE(readme.find("turns its axis " + angle + " off course"), readme.npos) << angle;
  EXPECT_NE(chart.find(angle + " at 60 s"), chart.npos) << angle;
  EXPECT_NE(made->second.find("drawn 100 times as large as it is"), made->second.npos);
}

// The nutation of the toy top takes 0.1057 s and its rows are 0.1 s apart: drawn through rows, the residual of the azimuth beats with
// 1.9 s and swings by 14.2" from 41 to 45 s; the motion swings by 33.6".
TEST(ReadmePicture, IsNotAliased) {
  std::ifstream file(EARTHTOP_TESTS "/../tools/readme/toy-top-drift.svg");
  const std::string picture(std::istreambuf_iterator<char>(file), {});
  const TemporaryDirectory dir;
  const RunResult result = run(shipped("toy-top"));
  write_results(result, dir.path() / "run", false);
  const Report report = make_report(dir.path() / "run");
  const auto made = std::ranges::find(report.pictures, std::string("parts"), [](const auto& p) { return p.first; });
  ASSERT_NE(made, report.pictures.end());
  EXPECT_EQ(picture, made->second) << "make it again: earthtop report out/toy-top --svg";
  expect_same(svg(drift_figure(result)), made->second);
  // The lowest panel: from its caption to the end.
  const std::size_t caption = picture.find("Azimuth minus its secular line (arcseconds; band: least to most)");
  ASSERT_NE(caption, picture.npos);
  const std::string panel = picture.substr(caption);
  const Drawn drawn = drawn_in(panel, "#0072b2");
  ASSERT_FALSE(drawn.bands.empty());
  double top = HUGE_VAL, bottom = -HUGE_VAL;
  for (const auto& band : drawn.bands)
    for (const Point& point : band) top = std::min(top, point.y), bottom = std::max(bottom, point.y);
  const Labels ticks = labels_in(panel, top - 60, bottom + 60);
  double low = HUGE_VAL, high = -HUGE_VAL;
  constexpr double kLeft = 74, kPlotWidth = 756, kDuration_s = 60;
  for (const auto& band : drawn.bands)
    for (const Point& point : band) {
      const double t_s = (point.x - kLeft) / kPlotWidth * kDuration_s;
      if (t_s < 41 || t_s > 45) continue;
      low = std::min(low, ticks.value(point.y)), high = std::max(high, ticks.value(point.y));
    }
  const double pixel = std::abs(ticks.value(1) - ticks.value(0));
  EXPECT_NEAR(high - low, 33.6, 2 * kPixel * pixel);
}

// Where a page cannot look at the motion again it draws the rows and says why.
TEST(PageOfRows, SaysThatItDrawsRows) {
  const TemporaryDirectory dir;
  const RunResult result = run(shipped("cusped-top"));
  write_results(result, dir.path() / "run", false);
  EXPECT_NE(make_report(dir.path() / "run").html.find("Drawn: the motion at"), std::string::npos);
  RunResult interrupted = result;
  interrupted.status = RunStatus::interrupted;
  write_results(interrupted, dir.path() / "stopped", false);
  const std::string html = make_report(dir.path() / "stopped").html;
  EXPECT_NE(html.find("Drawn: the output rows, since the run was interrupted"), html.npos);
  RunResult other = result;
  other.rows.back().drift_axis_rad *= 1.1;
  write_results(other, dir.path() / "other", false);
  EXPECT_NE(make_report(dir.path() / "other").html.find("Drawn: the output rows, since the scenario gives another motion"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Shipped, PicturesOf,
                         ::testing::Values("toy-top", "cusped-top", "southern-hemisphere", "equator", "north-pole",
                                           "lecture-gyro", "steady-precession-slow", "foucault-pendulum", "asymmetric-top",
                                           "routh-sphere", "turntable", "toy-top-on-table"),
                         [](const auto& name) {
                           std::string word = name.param;
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

}  // namespace
}  // namespace earthtop
