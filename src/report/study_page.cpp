// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <cmath>

#include "earthtop/elementary.hpp"
#include "earthtop/study/run_study.hpp"
#include "input/text_edit.hpp"
#include "report/known_html.hpp"
#include "report/pages.hpp"
#include "report/shell.hpp"
#include "report/study_points.hpp"
#include "study/store.hpp"
#include "text/json.hpp"

namespace earthtop::report {
namespace {

std::string shown(const Json& value) {
  if (value.is_number()) return number_html(value.get<double>(), "");
  return escaped(value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump());
}

std::string statistics_section(const Json& study) {
  std::vector<std::vector<std::string>> rows;
  const Json all = study.value("statistics", Json::object());
  for (const auto& [name, statistics] : all.items()) {
    std::vector<std::string> row = {escaped(name)};
    for (const char* key : {"count", "mean", "standard_deviation", "min", "quantile_05", "median", "quantile_95", "max"})
      row.push_back(shown(statistics.value(key, Json())));
    rows.push_back(std::move(row));
  }
  return table_html({"quantity", "points", "mean", "standard deviation", "minimum", "5 %", "median", "95 %", "maximum"}, rows);
}

std::string fits_section(const Json& study) {
  std::vector<std::vector<std::string>> rows;
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
        {escaped(fit.value("law", "")), with_error("a", "a_standard_error"), with_error("b", "b_standard_error"),
         shown(fit.value(power ? "residual_rms_of_logarithm" : "residual_rms", Json())) + (power ? " of the logarithm" : "")});
  }
  return rows.empty() ? "" : table_html({"law", "a", "b", "scatter"}, rows);
}

std::string figures_section(const Json& study) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& figure : study.value("figures", Json::array()))
    rows.push_back({escaped(figure.value("figure", "")), shown(figure.value("value", Json())),
                    shown(figure.value("computed", Json())), shown(figure.value("tolerance", Json())),
                    figure.value("met", false) ? "met" : "NOT MET", escaped(figure.value("origin", ""))});
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

/// Points and the fitted curves through them, for a study with one axis.
std::string curves_section(const Json& study, Page& page) {
  if (study.at("axes").size() != 1 || !study.at("points").is_array()) return "";
  const std::string axis = study.at("axes")[0].value("name", "");
  std::string html;
  for (std::size_t q = 0; q < study.at("quantities").size(); ++q) {
    const std::string quantity = study.at("quantities")[q].value("name", "");
    Line points{"computed", {}, {}, LineColor::blue, LineStyle::solid, Marker::circle};
    Panel panel{{quantity, ""}, {}, 210};
    for (const Json& point : study.at("points")) {
      const Json x = point.value(axis, Json()), y = point.value(quantity, Json());
      if (!x.is_number() || !y.is_number()) continue;
      points.x.push_back(x.get<double>());
      points.y.push_back(y.get<double>());
    }
    if (points.x.empty()) continue;
    for (const Json& fit : study.value("fits", Json::array())) {
      if (fit.value("quantity", "") != quantity) continue;
      Line curve{"fit: " + fit.value("kind", ""), points.x, {}, LineColor::grey, LineStyle::broad};
      for (const double x : curve.x) curve.y.push_back(fitted(fit, x));
      panel.lines.push_back(std::move(curve));
    }
    panel.lines.push_back(std::move(points));
    Figure figure{quantity, study.value("finding", ""), {axis, ""}, {}};
    figure.panels.push_back(std::move(panel));
    html += page.chart(fmt::format("curve{}", q), std::move(figure), fmt::format("{} over {}", quantity, axis));
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

Report study_page(const std::filesystem::path& store, const Watch& watch) {
  const StudyStoreCheck check = check_study_store(store);
  if (!check.damage.empty()) refuse_file(store, check.damage);
  study::Store points = study::Store::open(store, study::sqlite::Connection::Mode::read);
  const Json study = Json::parse(study_json(store, watch));
  const std::string title = study.value("title", "").empty() ? study.value("name", "A study") : study.value("title", "");
  std::vector<std::string> notes;
  if (!check.note.empty()) notes.push_back(check.note);
  Page page("study", title, std::move(notes));
  page.headline(escaped(study.value("finding", "")));
  const std::uint64_t failed = count_in(study.at("points_failed")), computed = count_in(study.at("points_computed")),
                      planned = count_in(study.at("points_planned"));
  page.verdict(failed == 0 && computed == planned ? "same" : "differs",
               fmt::format("{} of {} points computed, {} failed.", computed, planned, failed));
  add_points(points, page, watch);
  const std::string curves = curves_section(study, page);
  if (!curves.empty()) page.section("curves", "Curves", curves);
  page.section("explore", computed > kMostSinglePoints ? "Where the points lie" : "The points",
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
