// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "earthtop/elementary.hpp"
#include "earthtop/study/run_study.hpp"
#include "input/text_edit.hpp"
#include "report/finding.hpp"
#include "report/known_html.hpp"
#include "report/pages.hpp"
#include "report/shell.hpp"
#include "report/study_finding.hpp"
#include "report/study_picture.hpp"
#include "report/study_points.hpp"
#include "report/study_words.hpp"
#include "study/store.hpp"
#include "text/json.hpp"

namespace earthtop::report {
namespace {

/// The column with a key; one that only has that key where the study does not have it.
StudyColumn column_of(const std::vector<StudyColumn>& columns, const std::string& key) {
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const StudyColumn& column) { return column.key == key; });
  return at == columns.end() ? StudyColumn{key, key, key, ""} : *at;
}

/// A number as the document has it, in SI units.
std::string shown(const Json& value) { return StudyColumn{}.number(value); }

std::string statistics_section(const Json& study) {
  std::vector<std::vector<std::string>> rows;
  const std::vector<StudyColumn> quantities = quantities_of(study);
  const Json all = study.value("statistics", Json::object());
  for (const auto& [name, statistics] : all.items()) {
    const StudyColumn quantity = column_of(quantities, name);
    std::vector<std::string> row = {quantity.html(), shown(statistics.value("count", Json()))};
    for (const char* key : {"mean", "standard_deviation", "min", "quantile_05", "median", "quantile_95", "max"})
      row.push_back(quantity.number(statistics.value(key, Json())));
    rows.push_back(std::move(row));
  }
  return table_html({"quantity", "points", "mean", "standard deviation", "minimum", "5 %", "median", "95 %", "maximum"}, rows);
}

/// A fit's law in words.
std::string law_in_words(const Json& fit, const std::vector<StudyColumn>& settings,
                         const std::vector<StudyColumn>& quantities) {
  const std::string x = column_of(settings, fit.value("axis", "")).words,
                    y = column_of(quantities, fit.value("quantity", "")).words;
  const std::string kind = fit.value("kind", "");
  if (kind == "linear") return fmt::format("{} = a + b × {}", y, x);
  if (kind == "sin_latitude") return fmt::format("{} = a + b sin({})", y, x);
  if (kind == "cos_latitude") return fmt::format("{} = a + b cos({})", y, x);
  if (kind == "logarithmic") return fmt::format("{} = a + b ln({})", y, x);
  return kind == "power_law" ? fmt::format("{} = a × ({} to the power b)", y, x) : fit.value("law", "");
}

std::string fits_section(const Json& study) {
  std::vector<std::vector<std::string>> rows;
  const std::vector<StudyColumn> settings = settings_of(study), quantities = quantities_of(study);
  for (const Json& fit : study.value("fits", Json::array())) {
    const auto number = [&](const char* name) {
      const Json value = fit.value(name, Json());
      return value.is_number() ? value.get<double>() : NAN;
    };
    const auto with_error = [&](const char* name, const char* error) {
      return std::isfinite(number(error)) ? known_html(number(name), number(error), ReadableUnit{"", "", 1})
                                          : shown(fit.value(name, Json()));
    };
    const bool power = fit.value("kind", "") == "power_law";
    rows.push_back(
        {fmt::format("<span title=\"{}\">{}</span>", escaped(fit.value("law", "")),
                     escaped(law_in_words(fit, settings, quantities))),
         with_error("a", "a_standard_error"), with_error("b", "b_standard_error"),
         shown(fit.value(power ? "residual_rms_of_logarithm" : "residual_rms", Json())) + (power ? " of the logarithm" : "")});
  }
  return rows.empty() ? ""
                      : table_html({"law", "a", "b", "scatter"}, rows) +
                            "<p>The fits are of numbers in SI units: radians, metres, seconds; of a latitude in degrees.</p>\n";
}

/// The words for a pointer into the results: "drift of the axis at the end (″), point 3", and the column whose unit it has.
std::pair<std::string, StudyColumn> named_figure(const std::string& pointer, const std::vector<StudyColumn>& quantities) {
  std::vector<std::string> steps;
  for (std::size_t at = 0; at < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    steps.push_back(pointer.substr(at + 1, end - at - 1));
    at = end;
  }
  if (steps.size() == 3 && (steps[0] == "points" || steps[0] == "statistics")) {
    const bool is_point = steps[0] == "points";
    const StudyColumn quantity = column_of(quantities, is_point ? steps[2] : steps[1]);
    return {quantity.label() + (is_point ? ", point " + steps[1] : ", " + steps[2]), quantity};
  }
  if (steps.size() == 3 && steps[0] == "fits") return {fmt::format("{} of fit {}", steps[2], steps[1]), {}};
  return {pointer, {}};
}

std::string figures_section(const Json& study) {
  constexpr int kDigits = 7;  // such numbers are known well
  std::vector<std::vector<std::string>> rows;
  const std::vector<StudyColumn> quantities = quantities_of(study);
  for (const Json& figure : study.value("figures", Json::array())) {
    const std::string pointer = figure.value("figure", "");
    const auto named = named_figure(pointer, quantities);
    const auto number = [&](const char* key, int digits) { return named.second.number(figure.value(key, Json()), digits); };
    rows.push_back({fmt::format("<span title=\"{}\">{}</span>", escaped(pointer), escaped(named.first)),
                    number("value", kDigits), number("computed", kDigits), number("tolerance", 2),
                    figure.value("met", false) ? "met" : "NOT MET", with_powers(escaped(figure.value("origin", "")))});
  }
  return rows.empty() ? "" : table_html({"figure", "stated", "computed", "tolerance", "", "origin"}, rows);
}

/// The value of the fitted curve at x; NaN for an unknown kind of fit.
double fitted(const Json& fit, double x) {
  const std::string kind = fit.value("kind", "");
  const double a = fit.value("a", NAN), b = fit.value("b", NAN), radians = x * 0.017453292519943295;
  if (kind == "linear") return a + b * x;
  if (kind == "sin_latitude") return a + b * real::sin(radians);
  if (kind == "cos_latitude") return a + b * real::cos(radians);
  if (kind == "logarithmic") return a + b * real::log(std::abs(x));
  return kind == "power_law" ? a * real::pow(std::abs(x), b) : NAN;
}

/// Points and the fitted curves through them, for a study with one axis. Error bounds have no curve of their own beside a quantity's.
std::string curves_section(const Json& study, Page& page) {
  if (study.at("axes").size() != 1 || !study.at("points").is_array()) return "";
  const StudyColumn setting = settings_of(study).front();
  const std::vector<StudyColumn> quantities = quantities_of(study);
  const auto is_bound = [](const StudyColumn& quantity) { return quantity.where.find("bound") != std::string::npos; };
  const bool only_bounds = std::all_of(quantities.begin(), quantities.end(), is_bound);
  std::string html;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const StudyColumn& quantity = quantities[q];
    if (is_bound(quantity) && !only_bounds) continue;
    Line points{"computed", {}, {}, LineColor::blue, LineStyle::solid, Marker::circle};
    Panel panel{{quantity.words, quantity.unit}, {}, 210};
    for (const Json& point : study.at("points")) {
      const Json x = point.value(setting.key, Json()), y = point.value(quantity.key, Json());
      if (!x.is_number() || !y.is_number()) continue;
      points.x.push_back(x.get<double>());
      points.y.push_back(y.get<double>() * quantity.factor);
    }
    if (points.x.empty()) continue;
    for (const Json& fit : study.value("fits", Json::array())) {
      if (fit.value("quantity", "") != quantity.key) continue;
      std::string law = fit.value("kind", "");
      std::replace(law.begin(), law.end(), '_', ' ');
      Line curve{"fit: " + law, points.x, {}, LineColor::grey, LineStyle::broad};
      for (const double x : curve.x) curve.y.push_back(fitted(fit, x) * quantity.factor);
      panel.lines.push_back(std::move(curve));
    }
    if (panel.lines.empty()) points.label.clear();  // a single curve needs no legend
    panel.lines.push_back(std::move(points));
    const Json axis = study.at("axes")[0].value("log_range", Json());
    Figure figure{"", "", {setting.words, setting.unit, axis.is_object() ? AxisScale::logarithmic : AxisScale::linear}, {}};
    figure.title = fmt::format("{} over the {}", quantity.words, setting.words);
    figure.title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(figure.title[0])));
    figure.panels.push_back(std::move(panel));
    html += page.chart(fmt::format("curve{}", q), std::move(figure), "");
  }
  return html;
}

/// The study with its base inside, so that the text needs no other file.
std::string self_contained(const Study& study) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  std::string_view text = study.text;
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  std::string_view base = study.base.text;
  while (!base.empty() && base.back() == '\n') base.remove_suffix(1);
  std::string whole = study.base_inside ? std::string(text) : input::with_value(text, "/base", base);
  while (!whole.empty() && whole.back() == '\n') whole.pop_back();
  return Json::parse(whole).contains("name") ? whole : input::with_value(whole, "/name", Json(study.name).dump());
}

}  // namespace

Report study_page(const std::filesystem::path& store, const Watch& watch, const std::string& gallery) {
  const StudyStoreCheck check = check_study_store(store);
  if (!check.damage.empty()) refuse_file(store, check.damage);
  study::Store points = study::Store::open(store, study::sqlite::Connection::Mode::read);
  const Json study = Json::parse(study_json(store, watch));
  const std::string title = study.value("title", "").empty() ? study.value("name", "A study") : study.value("title", "");
  std::vector<std::string> notes;
  if (!check.note.empty()) notes.push_back(check.note);
  Page page("study", title, std::move(notes));
  page.group(kStudies);
  if (!gallery.empty()) page.belongs_to(gallery, "The page to play with runs one scene at a time, and no study.");
  page.finding(escaped(study_finding(study) + "."));
  page.headline(with_powers(escaped(study.value("finding", ""))));
  const std::uint64_t failed = count_in(study.at("points_failed")), computed = count_in(study.at("points_computed")),
                      planned = count_in(study.at("points_planned"));
  page.verdict(failed == 0 && computed == planned ? "same" : "differs", escaped(study_certainty(study)));
  add_points(points, page, study, watch);
  const std::string curves = curves_section(study, page);
  page.data()["drawn_above"] = !curves.empty();
  if (!curves.empty())
    page.section("curves", "Curves", curves);
  else
    page.small_picture(study_picture(study));
  page.section("explore",
               computed > kMostSinglePoints ? "Where the points lie"
               : curves.empty()             ? "The points"
                                            : "Each point",
               "<div id=\"explorer\"></div>\n");
  page.section("statistics", "Statistics", statistics_section(study));
  if (std::string fits = fits_section(study); !fits.empty()) page.section("fits", "Fits", std::move(fits));
  if (std::string figures = figures_section(study); !figures.empty())
    page.section("figures", "Figures known from elsewhere", std::move(figures));
  const Json provenance = study.value("provenance", Json::object());
  Facts facts;
  for (const auto& [key, value] : provenance.items())
    if (value.is_string()) facts.emplace_back(key, escaped(value.get<std::string>()));
  page.section("provenance", "Provenance", facts_html(facts));
  page.section(
      "command", "Make it again",
      Page::command(with_input("earthtop study - --out again", self_contained(points.study())) + "earthtop report again\n"));
  return page.finish();
}

}  // namespace earthtop::report
