// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/conclusion.hpp"
#include "report/document_values.hpp"
#include "report/pages.hpp"
#include "results/meanings.hpp"
#include "results/time_unit.hpp"
#include "results/unit_of_name.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

std::vector<double> numbers(const Json& list, double factor) {
  std::vector<double> values;
  for (const Json& value : list) values.push_back(value.is_number() ? value.get<double>() * factor : NAN);
  return values;
}

/// A quantity in words with its unit, and its name on demand.
std::string quantity_html(const std::string& name) {
  const std::string unit = unit_in_signs(unit_of_name(name)), words = compare::in_words(name);
  return fmt::format("<span title=\"{}\">{}</span>", escaped(name),
                     escaped(unit.empty() ? words : fmt::format("{} ({})", words, unit)));
}

/// The finding, in a sentence.
std::string finding_of(const Json& document, const Json& pairs, const std::string& verdict) {
  const std::string both = text_of(document, "new") + " and " + text_of(document, "reference");
  if (verdict == "same") return both + " are the same to within their tolerances.";
  if (pairs.size() != 1) {
    const auto differ =
        std::count_if(pairs.begin(), pairs.end(), [](const Json& pair) { return text_of(pair, "verdict") != "same"; });
    return fmt::format("{} of {} results in {} differ.", differ, pairs.size(), both);
  }
  const Json quantities = pairs.front().value("quantities", Json::array());
  const auto failed =
      std::count_if(quantities.begin(), quantities.end(), [](const Json& q) { return !q.value("passed", false); });
  if (failed == 0) return both + " differ.";
  return fmt::format("{} differ: {} of {} quantities by more than their tolerances.", both, failed, quantities.size());
}

/// A table of the quantities that failed, or of all.
std::string quantities_table(const Json& pair, bool everything) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& quantity : pair.value("quantities", Json::array())) {
    if (!everything && quantity.value("passed", false)) continue;
    rows.push_back({quantity.value("passed", false) ? "ok" : "<strong>FAILED</strong>",
                    quantity_html(text_of(quantity, "name")), number_of(quantity, "largest_difference"),
                    escaped(text_of(quantity, "where")), number_of(quantity, "tolerance"),
                    escaped(text_of(quantity, "tolerance_origin")), number_of(quantity, "share_used", 2),
                    escaped(text_of(quantity, "first_violation")), escaped(text_of(quantity, "change")),
                    escaped(text_of(quantity, "reason"))});
  }
  if (rows.empty()) return "";
  return table_html(
      {"", "quantity", "largest difference", "at", "tolerance", "from", "share used", "first beyond it", "change", ""}, rows);
}

/// The quantities for which differences over time were kept: first those that failed, then those nearest to their tolerance.
std::vector<const Json*> quantities_to_draw(const Json& pair) {
  constexpr std::size_t kMostCharts = 4;
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
    const std::string words = compare::in_words(name);
    const bool passed = quantity->value("passed", false);
    Figure figure{words, passed ? "within its tolerance" : "beyond its tolerance", {"Time", unit.name}, {}};
    figure.panels.push_back({{"Difference", unit_in_signs(unit_of_name(name)), AxisScale::logarithmic},
                             {{"tolerance", t, numbers(curve.at("tolerance"), 1), LineColor::vermillion, LineStyle::filled},
                              {"difference", t, numbers(curve.at("difference"), 1)}},
                             130});
    html += page.chart(fmt::format("p{}q{}", number, count++), std::move(figure),
                       fmt::format("Size of the difference in the {}, and its tolerance, at rows that both have.", words));
  }
  return html;
}

/// Details, which open when they are asked for.
std::string on_request(std::string_view summary, const std::string& html) {
  return html.empty() ? "" : fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(summary), html);
}

/// @param alone  whether the page has said already what was found
std::string pair_html(const Json& pair, std::size_t number, bool alone, Page& page) {
  std::string html;
  if (!alone)
    html = fmt::format("<p class=\"verdict {0}\"><strong>{0}</strong>: {1} against {2}</p>\n<p>{3}</p>\n",
                       escaped(text_of(pair, "verdict")), escaped(text_of(pair, "new")), escaped(text_of(pair, "reference")),
                       escaped(text_of(pair, "conclusion")));
  std::string list;
  for (const Json& finding : pair.value("findings", Json::array()))
    list +=
        fmt::format("<li><strong>{}</strong>: {}</li>\n", escaped(text_of(finding, "kind")), escaped(text_of(finding, "text")));
  for (const char* kind : {"hints", "notes"})
    for (const Json& line : pair.value(kind, Json::array()))
      if (line.is_string()) list += "<li>" + escaped(line.get<std::string>()) + "</li>\n";
  if (!list.empty()) html += "<ul>" + list + "</ul>\n";
  const bool same = text_of(pair, "verdict") == "same";
  const std::string charts = pair_charts(pair, number, page);
  html += quantities_table(pair, false) + (same ? on_request("Differences over time", charts) : charts) +
          on_request(fmt::format("All {} quantities", pair.value("quantities", Json::array()).size()),
                     quantities_table(pair, true));
  std::vector<std::vector<std::string>> cost;
  for (const Json& ratio : pair.value("cost", Json::array()))
    cost.push_back({escaped(text_of(ratio, "name")), number_of(ratio, "reference", 4), number_of(ratio, "new", 4),
                    number_of(ratio, "ratio")});
  return cost.empty() ? html : html + on_request("Cost", table_html({"cost", "reference", "new", "ratio"}, cost));
}

}  // namespace

Report comparison_page(const Json& document, const std::vector<std::string>& notes) {
  constexpr std::size_t kMostPairs = 20;  // limit, so that the page stays readable; some of these pairs get charts
  const std::string verdict = text_of(document, "verdict");
  Page page("comparison", "Comparison of " + text_of(document, "new") + " with " + text_of(document, "reference"), notes);
  const Json pairs = document.value("pairs", Json::array());
  std::string conclusion;
  for (const Json& sentence : document.value("conclusion", Json::array()))
    if (sentence.is_string()) conclusion += (conclusion.empty() ? "" : " ") + escaped(sentence.get<std::string>());
  page.finding(escaped(finding_of(document, pairs, verdict)));
  page.headline(with_powers(conclusion));
  page.verdict(verdict, fmt::format("<strong>{}</strong>: {} against {}, profile {}.", escaped(verdict),
                                    escaped(text_of(document, "new")), escaped(text_of(document, "reference")),
                                    escaped(text_of(document, "profile"))));
  std::vector<const Json*> shown;
  for (const bool wanted : {false, true})  // pairs that differ first
    for (const Json& pair : pairs)
      if ((text_of(pair, "verdict") == "same") == wanted && shown.size() < kMostPairs) shown.push_back(&pair);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::string name = text_of(*shown[i], "name");
    page.section(fmt::format("pair{}", i), name.empty() ? "Differences" : name,
                 pair_html(*shown[i], i, pairs.size() == 1, page));
  }
  if (shown.size() < pairs.size())
    page.section("more", "More",
                 fmt::format("<p>Results shown: {} of {}; the others are in the document.</p>\n", shown.size(), pairs.size()));
  return page.finish();
}

}  // namespace earthtop::report
