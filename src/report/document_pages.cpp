// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/pages.hpp"
#include "results/time_unit.hpp"
#include "results/unit_of_name.hpp"

namespace earthtop::report {
namespace {

std::string text_of(const Json& json, const char* key) {
  const Json value = json.value(key, Json());
  return value.is_string() ? value.get<std::string>() : "";
}

std::string number_of(const Json& json, const char* key, int digits = 3) {
  const Json value = json.value(key, Json());
  return value.is_number() ? number_html(value.get<double>(), "", digits) : "";
}

std::vector<double> numbers(const Json& list, double factor) {
  std::vector<double> values;
  for (const Json& value : list) values.push_back(value.is_number() ? value.get<double>() * factor : NAN);
  return values;
}

std::string quantities_table(const Json& pair) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& quantity : pair.value("quantities", Json::array()))
    rows.push_back({quantity.value("passed", false) ? "ok" : "<strong>FAILED</strong>", escaped(text_of(quantity, "name")),
                    number_of(quantity, "largest_difference"), escaped(text_of(quantity, "where")),
                    number_of(quantity, "tolerance"), escaped(text_of(quantity, "tolerance_origin")),
                    number_of(quantity, "share_used", 2), escaped(text_of(quantity, "first_violation")),
                    escaped(text_of(quantity, "change")), escaped(text_of(quantity, "reason"))});
  return table_html(
      {"", "quantity", "largest difference", "at", "tolerance", "from", "share used", "first beyond it", "change", ""}, rows);
}

/// The quantities for which differences over time were kept: first those that failed, then those nearest to their tolerance.
std::vector<const Json*> quantities_to_draw(const Json& pair) {
  constexpr std::size_t kMostCharts = 5;
  std::vector<const Json*> list;
  if (!pair.contains("quantities")) return list;
  for (const Json& quantity : pair.at("quantities"))
    if (quantity.contains("curve") && !quantity.at("curve").at("t_s").empty() && text_of(quantity, "name") != "drift_reliable")
      list.push_back(&quantity);
  const auto share = [](const Json& quantity) {
    const Json used = quantity.value("share_used", Json());
    return used.is_number() ? used.get<double>() : 1e300;
  };
  std::stable_sort(list.begin(), list.end(), [&](const Json* a, const Json* b) {
    const bool a_passed = a->value("passed", false), b_passed = b->value("passed", false);
    return a_passed != b_passed ? !a_passed : share(*a) > share(*b);
  });
  if (list.size() > kMostCharts) list.resize(kMostCharts);
  return list;
}

/// Charts of the differences over time and their tolerances.
std::string pair_charts(const Json& pair, std::size_t number, Page& page) {
  std::string html;
  std::size_t count = 0;
  for (const Json* quantity : quantities_to_draw(pair)) {
    const Json& curve = quantity->at("curve");
    std::vector<double> t = numbers(curve.at("t_s"), 1);
    const TimeUnit unit = time_unit(t.back());
    for (double& time : t) time *= unit.per_s;
    const std::string name = text_of(*quantity, "name");
    Figure figure{
        name, quantity->value("passed", false) ? "within its tolerance" : "beyond its tolerance", {"Time", unit.name}, {}};
    figure.panels.push_back({{"Difference", std::string(unit_of_name(name)), AxisScale::logarithmic},
                             {{"tolerance", t, numbers(curve.at("tolerance"), 1), LineColor::vermillion, LineStyle::filled},
                              {"difference", t, numbers(curve.at("difference"), 1)}},
                             130});
    html += page.chart(fmt::format("p{}q{}", number, count++), std::move(figure), name);
  }
  return html;
}

std::string pair_html(const Json& pair, std::size_t number, Page& page) {
  std::string html =
      fmt::format("<p class=\"verdict {0}\"><strong>{0}</strong>: {1} against {2}</p>\n", escaped(text_of(pair, "verdict")),
                  escaped(text_of(pair, "new")), escaped(text_of(pair, "reference")));
  if (!text_of(pair, "refusal").empty()) html += "<p>" + escaped(text_of(pair, "refusal")) + "</p>\n";
  std::string list;
  for (const Json& finding : pair.value("findings", Json::array()))
    list +=
        fmt::format("<li><strong>{}</strong>: {}</li>\n", escaped(text_of(finding, "kind")), escaped(text_of(finding, "text")));
  for (const char* kind : {"hints", "notes"})
    for (const Json& line : pair.value(kind, Json::array()))
      if (line.is_string()) list += "<li>" + escaped(line.get<std::string>()) + "</li>\n";
  if (!list.empty()) html += "<ul>" + list + "</ul>\n";
  html += pair_charts(pair, number, page) + quantities_table(pair);
  std::vector<std::vector<std::string>> cost;
  for (const Json& ratio : pair.value("cost", Json::array()))
    cost.push_back({escaped(text_of(ratio, "name")), number_of(ratio, "reference", 4), number_of(ratio, "new", 4),
                    number_of(ratio, "ratio")});
  return cost.empty() ? html : html + table_html({"cost", "reference", "new", "ratio"}, cost);
}

}  // namespace

Report comparison_page(const Json& document) {
  constexpr std::size_t kMostPairs = 20;  // limit, so that the page stays readable; some of these pairs get charts
  const std::string verdict = text_of(document, "verdict");
  Page page("comparison", "Comparison of " + text_of(document, "new") + " with " + text_of(document, "reference"));
  const Json pairs = document.value("pairs", Json::array());
  std::map<std::string, std::size_t> counts;
  for (const Json& pair : pairs) ++counts[text_of(pair, "verdict")];
  page.headline(fmt::format("<strong>{}</strong>: {} compared, {} the same, {} different, {} refused; profile {}.",
                            escaped(verdict),
                            pairs.size() == 1 ? "one pair of results" : fmt::format("{} pairs of results", pairs.size()),
                            counts["same"], counts["differs"], counts["refused"], escaped(text_of(document, "profile"))));
  page.verdict(verdict, escaped(verdict));
  std::vector<const Json*> shown;
  for (const bool wanted : {false, true})  // pairs that differ first
    for (const Json& pair : pairs)
      if ((text_of(pair, "verdict") == "same") == wanted && shown.size() < kMostPairs) shown.push_back(&pair);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::string name = text_of(*shown[i], "name");
    page.section(fmt::format("pair{}", i), name.empty() ? "Differences" : name, pair_html(*shown[i], i, page));
  }
  if (shown.size() < pairs.size())
    page.section("more", "More", fmt::format("<p>{} more results are in the document.</p>\n", pairs.size() - shown.size()));
  return page.finish();
}

namespace {

/// An entry's error of the compared kind, but at least the error of the reference.
double error_of(const Json& entry, const Json& scene) {
  const std::string key = text_of(scene, "compared_error") + "_rad";
  const Json error = entry.value("error", Json()), floor = scene.value(Json::json_pointer("/reference/error"), Json());
  if (!error.is_object() || !error.value(key, Json()).is_number()) return NAN;
  const double least = floor.is_object() && floor.value(key, Json()).is_number() ? floor.at(key).get<double>() : 0;
  return std::max(error.at(key).get<double>(), least);
}

Figure bench_chart(const Json& scene) {
  constexpr LineColor kColors[] = {LineColor::blue,   LineColor::vermillion, LineColor::green,
                                   LineColor::purple, LineColor::orange,     LineColor::sky};
  constexpr Marker kMarkers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  Figure figure{text_of(scene, "scenario") + ": error against cost",
                text_of(scene, "workload"),
                {"Processor time", "s", AxisScale::logarithmic},
                {}};
  Panel panel{{"Largest error", "rad", AxisScale::logarithmic}, {}, 430};
  std::map<std::string, std::vector<std::pair<double, double>>> families;
  for (const Json& entry : scene.value("entries", Json::array())) {
    const double error = error_of(entry, scene);
    const Json seconds = entry.value("seconds", Json());
    if (error > 0 && seconds.is_number())
      families[text_of(entry, "method") + ", " + text_of(entry, "equations") + ", " + text_of(entry, "precision")].emplace_back(
          seconds.get<double>(), error);
  }
  std::size_t i = 0;
  for (auto& [name, points] : families) {
    std::sort(points.begin(), points.end());
    Line line{
        name, {}, {}, kColors[i % std::size(kColors)], LineStyle::thin, kMarkers[i / std::size(kColors) % std::size(kMarkers)]};
    for (const auto& [seconds, error] : points) {
      line.x.push_back(seconds);
      line.y.push_back(error);
    }
    panel.lines.push_back(std::move(line));
    ++i;
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

std::string entries_table(const Json& scene) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& entry : scene.value("entries", Json::array()))
    rows.push_back({entry.value("on_front", false) ? "front" : "", entry.value("auto", false) ? "auto" : "",
                    escaped(text_of(entry, "method")), escaped(text_of(entry, "equations")),
                    escaped(text_of(entry, "precision")), number_of(entry, "relative_tolerance"),
                    number_html(error_of(entry, scene), "", 3), number_of(entry, "seconds"), number_of(entry, "evaluations", 8),
                    escaped(text_of(entry, "outcome"))});
  return table_html(
      {"", "", "method", "equations", "precision", "tolerance", "error (rad)", "seconds", "evaluations", "outcome"}, rows);
}

}  // namespace

Report bench_page(const Json& document) {
  const Json scenes = document.value("scenarios", Json::array());
  Page page("bench", "Speed against error");
  page.headline(fmt::format("{}; {}.", scenes.size() == 1 ? "One scenario" : fmt::format("{} scenarios", scenes.size()),
                            escaped(text_of(document, "processor"))));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Json& scene = scenes[i];
    const Json reference = scene.value("reference", Json::object());
    page.section(fmt::format("scene{}", i), text_of(scene, "scenario"),
                 fmt::format("<p>{}. Reference: {}; its witness: {}.</p>\n", escaped(text_of(scene, "title")),
                             escaped(text_of(reference, "source")), escaped(text_of(reference, "witness"))) +
                     page.chart(fmt::format("bench{}", i), bench_chart(scene),
                                "Error against processor time; below and to the left is better.") +
                     entries_table(scene));
  }
  return page.finish();
}

}  // namespace earthtop::report
