// SPDX-License-Identifier: GPL-3.0-or-later
// A benchmark report as a picture.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <set>

#include "bench/look.hpp"
#include "earthtop/bench/comparison.hpp"

namespace earthtop {
namespace {

constexpr std::array<std::string_view, 7> kColors = {"blue", "vermillion", "green", "purple", "orange", "sky", "grey"};
constexpr std::array<std::string_view, 5> kMarkers = {"none", "circle", "square", "triangle", "diamond"};

/// The value of an enumeration whose names these are, in its order.
template <class Enum, std::size_t n>
Enum named(std::string_view word, const std::array<std::string_view, n>& names) {
  return static_cast<Enum>(std::find(names.begin(), names.end() - 1, word) - names.begin());
}

/// Colour and marker of a contender, the same in every picture; grey for other libraries.
Look look_of(const Contender& contender) {
  if (contender.peer) return {LineColor::grey, named<Marker>(contender.peer->marker, kMarkers)};
  return *look_of_method(to_string(contender.options.method));
}

LineStyle style_of(const Contender& contender) {
  if (contender.precision != Precision::bits53) return LineStyle::dotted;
  return contender.options.form == ModelForm::general ? LineStyle::dashed : LineStyle::thin;
}

std::string label_of(const Contender& contender) {
  return std::string(contender.peer ? contender.peer->word : to_string(contender.options.method));
}

struct Point {
  double seconds, error;
};

Line line_through(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.seconds < b.seconds; });
  Line line;
  for (const Point& point : points) {
    line.x.push_back(point.seconds);
    line.y.push_back(point.error);
  }
  return line;
}

/// The Pareto front as a step line from each of its points to the next: no entry lies below and to the left of it.
Line front_line(const BenchReport& report, ErrorKind kind) {
  std::vector<Point> points;
  const std::vector<bool> front = pareto_front(report, kind);
  for (std::size_t i = 0; i < front.size(); ++i)
    if (front[i]) points.push_back({report.entries[i].seconds, *error_of(report.entries[i], report.reference, kind)});
  const Line corners = line_through(std::move(points));
  Line line;
  for (std::size_t i = 0; i < corners.x.size(); ++i) {
    if (i > 0) {
      line.x.push_back(corners.x[i]);
      line.y.push_back(corners.y[i - 1]);
    }
    line.x.push_back(corners.x[i]);
    line.y.push_back(corners.y[i]);
  }
  line.label = "Pareto front";
  line.color = LineColor::grey;
  line.style = LineStyle::broad;
  return line;
}

}  // namespace

std::optional<Look> look_of_method(std::string_view word) {
  for (const MethodRow& method : kMethodRows) {
    if (method.word != word || method.look.empty()) continue;
    const std::size_t space = std::min(method.look.find(' '), method.look.size());
    return Look{named<LineColor>(method.look.substr(0, space), kColors),
                named<Marker>(method.look.substr(std::min(space + 1, method.look.size())), kMarkers)};
  }
  return std::nullopt;
}

Figure bench_figure(const BenchReport& report) {
  const ErrorKind kind = report.compared;
  Figure figure;
  figure.title = fmt::format("{}, {:g} s: error versus cost", report.scenario, report.duration_s);
  figure.subtitle =
      fmt::format("{}; {}; dashed: general form; dotted: more than double precision",
                  report.workload == Workload::drift ? "both motions and the drift" : "one motion", processor_description());
  figure.x = {"processor time", "s", AxisScale::logarithmic};
  Panel panel{{fmt::format("largest error of the {}", to_string(kind)), "rad", AxisScale::logarithmic}, {}, 430};
  panel.lines.push_back(front_line(report, kind));
  std::set<std::string> named;
  for (const BenchFamily& family : families(report)) {
    std::vector<Point> points;
    for (const std::size_t i : family.entries)
      if (const auto error = error_of(report.entries[i], report.reference, kind); error && *error > 0)
        points.push_back({report.entries[i].seconds, *error});
    if (points.empty()) continue;
    Line line = line_through(std::move(points));
    if (const std::string label = label_of(family.first); named.insert(label).second) line.label = label;
    line.color = look_of(family.first).color;
    line.marker = look_of(family.first).marker;
    line.style = style_of(family.first);
    panel.lines.push_back(std::move(line));
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace earthtop
