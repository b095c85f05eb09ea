// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "bench/look.hpp"
#include "report/document_values.hpp"
#include "report/pages.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

/// An entry's error of the compared kind, but at least the error of the reference.
double error_of(const Json& entry, const Json& scene) {
  const std::string key = text_of(scene, "compared_error") + "_rad";
  const Json error = entry.value("error", Json()), floor = scene.value(Json::json_pointer("/reference/error"), Json());
  if (!error.is_object() || !error.value(key, Json()).is_number()) return NAN;
  const double least = floor.is_object() && floor.value(key, Json()).is_number() ? floor.at(key).get<double>() : 0;
  return std::max(error.at(key).get<double>(), least);
}

/// An entry that can be drawn.
struct Entry {
  std::string method, equations, precision;
  double seconds = 0, error = 0;
  std::optional<double> tolerance, step_s;
  bool on_front = false;

  auto family() const { return std::tie(method, equations, precision); }
  std::string text() const {
    std::string text = fmt::format("{}, {}, {}", method, equations, precision);
    std::string numbers;
    if (tolerance) numbers += fmt::format(", tolerance {:g}", *tolerance);
    if (step_s) numbers += fmt::format(", step {:g} s", *step_s);
    numbers += fmt::format(": {:.3g} s, error {:.3g} rad", seconds, error);
    return text + with_powers(numbers) + (on_front ? "; on the front" : "");
  }
};

std::vector<Entry> entries_of(const Json& scene) {
  const auto number = [](const Json& entry, const char* key) {
    const Json value = entry.value(key, Json());
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
  };
  std::vector<Entry> list;
  for (const Json& entry : scene.value("entries", Json::array())) {
    const double error = error_of(entry, scene);
    const std::optional<double> seconds = number(entry, "seconds");
    if (error > 0 && seconds)
      list.push_back({text_of(entry, "method"), text_of(entry, "equations"), text_of(entry, "precision"), *seconds, error,
                      number(entry, "relative_tolerance"), number(entry, "step_s"), entry.value("on_front", false)});
  }
  std::stable_sort(list.begin(), list.end(), [](const Entry& a, const Entry& b) { return a.seconds < b.seconds; });
  return list;
}

/// A look for each method, none twice: the table's where it has one, else the next one that is free.
std::map<std::string, Look> looks_of(const std::vector<Entry>& entries) {
  constexpr std::array kColors = {LineColor::blue,   LineColor::vermillion, LineColor::green, LineColor::purple,
                                  LineColor::orange, LineColor::sky,        LineColor::grey};
  constexpr std::array kMarkers = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  std::map<std::string, Look> looks;
  const auto is_taken = [&](const Look& look) {
    return std::any_of(looks.begin(), looks.end(), [&](const auto& given) { return given.second == look; });
  };
  for (const Entry& entry : entries)
    if (const auto look = look_of_method(entry.method); look && !is_taken(*look)) looks.emplace(entry.method, *look);
  for (const Entry& entry : entries) {
    if (looks.contains(entry.method)) continue;
    Look look{LineColor::grey, Marker::none};  // where there are more methods than looks
    for (const Marker marker : kMarkers)
      for (const LineColor color : kColors)
        if (look.marker == Marker::none && !is_taken({color, marker})) look = {color, marker};
    looks.emplace(entry.method, look);
  }
  return looks;
}

LineStyle style_of(const Entry& entry) {
  if (entry.precision == "long_double") return LineStyle::dotted;
  if (entry.precision != "double") return LineStyle::sparse;
  if (!entry.equations.starts_with("general")) return LineStyle::thin;
  return entry.equations.ends_with("body") ? LineStyle::dashed : LineStyle::dash_dot;
}

/// The front as a step line from each of its points to the next, and its points on it.
void add_front(Panel& panel, const std::vector<Entry>& entries, const std::map<std::string, Look>& looks) {
  Line line{"Pareto front", {}, {}, LineColor::ink};
  for (const Entry& entry : entries) {
    if (!entry.on_front) continue;
    if (!line.x.empty()) {
      line.x.push_back(entry.seconds);
      line.y.push_back(line.y.back());
    }
    line.x.push_back(entry.seconds);
    line.y.push_back(entry.error);
  }
  if (line.x.empty()) return;
  panel.lines.push_back(std::move(line));
  for (const Entry& entry : entries)
    if (entry.on_front)
      panel.lines.push_back({"",
                             {entry.seconds},
                             {entry.error},
                             looks.at(entry.method).color,
                             LineStyle::points,
                             looks.at(entry.method).marker,
                             entry.equations.starts_with("general")});
}

Figure bench_chart(const Json& scene, const std::vector<Entry>& entries) {
  const std::map<std::string, Look> looks = looks_of(entries);
  Figure figure{text_of(scene, "scenario") + ": error against cost",
                text_of(scene, "workload"),
                {"Processor time", "s", AxisScale::logarithmic},
                {}};
  Panel panel{{"Largest error", "rad", AxisScale::logarithmic}, {}, 430};
  std::vector<const Entry*> first;  // of each family
  for (const Entry& entry : entries)
    if (std::none_of(first.begin(), first.end(), [&](const Entry* other) { return other->family() == entry.family(); }))
      first.push_back(&entry);
  std::vector<std::string> named;
  for (const Entry* family : first) {
    const Look look = looks.at(family->method);
    const bool is_named = std::find(named.begin(), named.end(), family->method) != named.end();
    Line line{is_named ? "" : family->method,          {}, {}, look.color, style_of(*family), look.marker,
              family->equations.starts_with("general")};
    named.push_back(family->method);
    for (const Entry& entry : entries) {
      if (entry.family() != family->family()) continue;
      line.x.push_back(entry.seconds);
      line.y.push_back(entry.error);
    }
    panel.lines.push_back(std::move(line));
  }
  add_front(panel, entries, looks);
  figure.panels.push_back(std::move(panel));
  return figure;
}

/// The finding on the first scenario, in a sentence: the fastest method, and the most accurate one.
std::string finding_of(const Json& scenes) {
  const std::vector<Entry> entries = scenes.empty() ? std::vector<Entry>() : entries_of(scenes.front());
  if (entries.empty()) return "No method has both a time and an error.";
  const Entry& best =
      *std::min_element(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.error < b.error; });
  const Entry& fastest = entries.front();
  const auto told = [](const Entry& entry) {
    return with_powers(fmt::format("errs by {:.2g} rad after {:.2g} s", entry.error, entry.seconds));
  };
  if (&best == &fastest)
    return fmt::format("{}: {} is fastest and most accurate; it {}.", text_of(scenes.front(), "scenario"), best.method,
                       told(best));
  return fmt::format("{}: the most accurate method, {}, {}; the fastest, {}, {}.", text_of(scenes.front(), "scenario"),
                     best.method, told(best), fastest.method, told(fastest));
}

std::string entries_table(const Json& scene) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& entry : scene.value("entries", Json::array()))
    rows.push_back({entry.value("on_front", false) ? "front" : "", entry.value("auto", false) ? "auto" : "",
                    escaped(text_of(entry, "method")), escaped(text_of(entry, "equations")),
                    escaped(text_of(entry, "precision")), number_of(entry, "relative_tolerance"),
                    std::isfinite(error_of(entry, scene)) ? number_html(error_of(entry, scene), "", 3) : "",
                    number_of(entry, "seconds"), number_of(entry, "evaluations", 8), escaped(text_of(entry, "outcome"))});
  return table_html(
      {"", "", "method", "equations", "precision", "tolerance", "error (rad)", "seconds", "evaluations", "outcome"}, rows);
}

}  // namespace

Report bench_page(const Json& document, const std::vector<std::string>& notes) {
  const Json scenes = document.value("scenarios", Json::array());
  Page page("bench", "Speed against error", notes);
  page.finding(escaped(finding_of(scenes)));
  page.headline(fmt::format("{}; {}.", scenes.size() == 1 ? "One scenario" : fmt::format("{} scenarios", scenes.size()),
                            escaped(text_of(document, "processor"))));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Json& scene = scenes[i];
    const Json reference = scene.value("reference", Json::object());
    const std::vector<Entry> entries = entries_of(scene);
    std::vector<Mark> marks;
    marks.reserve(entries.size());
    for (const Entry& entry : entries) marks.push_back({entry.seconds, entry.error, entry.text()});
    page.section(
        fmt::format("scene{}", i), text_of(scene, "scenario"),
        fmt::format("<p>{}. Reference: {}; checked against {}.</p>\n", escaped(text_of(scene, "title")),
                    with_powers(escaped(text_of(reference, "source"))), with_powers(escaped(text_of(reference, "witness")))) +
            page.chart_of_marks(
                fmt::format("bench{}", i), bench_chart(scene, entries), marks,
                "Error against processor time. Marks further down or to the left are better; no mark beats those on "
                "the front in both. Filled marks: the reduced equations, or a method's own; hollow ones: the general "
                "equations, dashed in body axes, dash-dotted in other axes. Dotted: long double; dots far apart: "
                "float128.") +
            entries_table(scene));
  }
  return page.finish();
}

}  // namespace earthtop::report
