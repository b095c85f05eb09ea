// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/html.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "earthtop/results/provenance.hpp"
#include "plot/svg_text.hpp"
#include "report/assets.hpp"
#include "report/content_policy.hpp"
#include "results/meanings.hpp"
#include "text/number_words.hpp"
#include "text/utf8.hpp"

namespace earthtop::report {
namespace {

constexpr std::size_t kMostTableRows = 200;

/// A number with seven digits, which is more than a picture shows.
Json short_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return Json::parse(fmt::format("{:.7g}", value));
}

std::string cell(double value) { return number_html(value, "", 7); }

std::string name_with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

/// All x values of a figure, ascending and without repetition.
std::vector<double> all_x(const Figure& figure) {
  std::set<double> values;
  for (const Panel& panel : figure.panels)
    for (const Line& line : panel.lines)
      for (const double x : line.x)
        if (std::isfinite(x)) values.insert(x);
  return {values.begin(), values.end()};
}

/// The values of one line at the common x values of a figure; NaN where the line has none.
struct Series {
  std::string label, unit;
  std::vector<double> y;
};
std::vector<Series> series_of(const Figure& figure, const std::vector<double>& x) {
  std::vector<Series> list;
  for (const Panel& panel : figure.panels)
    for (const Line& line : panel.lines) {
      Series series{line.label.empty() ? panel.y.label : line.label, panel.y.unit,
                    std::vector<double>(x.size(), std::numeric_limits<double>::quiet_NaN())};
      for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i) {
        const auto at = std::lower_bound(x.begin(), x.end(), line.x[i]);
        if (at != x.end() && *at == line.x[i]) series.y[static_cast<std::size_t>(at - x.begin())] = line.y[i];
      }
      list.push_back(std::move(series));
    }
  return list;
}

std::string table_of(const Figure& figure, const std::vector<double>& x, const std::vector<Series>& list) {
  std::vector<std::string> header = {name_with_unit(figure.x.label, figure.x.unit)};
  for (const Series& series : list) header.push_back(name_with_unit(series.label, series.unit));
  std::vector<std::vector<std::string>> rows;
  const std::size_t stride = (x.size() + kMostTableRows - 1) / kMostTableRows;
  for (std::size_t i = 0; i < x.size(); i += std::max<std::size_t>(stride, 1)) {
    std::vector<std::string> row = {cell(x[i])};
    for (const Series& series : list) row.push_back(cell(series.y[i]));
    rows.push_back(std::move(row));
  }
  const std::string note = stride > 1 ? fmt::format("<p>Every {}th of {} points.</p>", stride, x.size()) : "";
  return table_html(header, rows) + note;
}

Json frame_json(const PlotFrame& frame) {
  const auto word = [](AxisScale scale) { return scale == AxisScale::logarithmic ? "log" : "linear"; };
  return {{"left", frame.left},    {"right", frame.right},           {"width", frame.width},          {"x_min", frame.x_low},
          {"x_max", frame.x_high}, {"x_scale", word(frame.x_scale)}, {"floor", frame.floor},          {"top", frame.top},
          {"y_min", frame.y_low},  {"y_max", frame.y_high},          {"y_scale", word(frame.y_scale)}};
}

/// Returns the part of a chart, without its values, with which the page finds the values under a pointer.
Json plot_json(const Figure& figure) {
  return {{"x_unit", figure.x.unit},
          {"x_label", figure.x.label},
          {"plot", frame_json(frame_of(figure))},
          {"narrow", frame_json(frame_of(figure, PlotWidth::narrow))}};
}

Json chart_json(const Figure& drawn, const std::vector<double>& x, const std::vector<Series>& list) {
  Json json = plot_json(drawn);
  Json& list_x = json["x"] = Json::array();
  for (const double value : x) list_x.push_back(short_number(value));
  Json& list_series = json["series"] = Json::array();
  for (const Series& series : list) {
    Json y = Json::array();
    for (const double value : series.y) y.push_back(short_number(value));
    list_series.push_back({{"label", series.label}, {"unit", series.unit}, {"y", std::move(y)}});
  }
  return json;
}

/// Both drawings; the page's style shows one of them.
std::string drawings_html(const Drawings& drawings) {
  if (drawings.narrow.empty()) return without_style(drawings.wide);
  return "<div class=\"wide\">" + without_style(drawings.wide) + "</div>\n<div class=\"narrow\">" +
         without_style(drawings.narrow) + "</div>\n";
}

std::string details(const std::string& table) {
  return "<details class=\"data\"><summary>Data table</summary>" + table + "</details>";
}

/// Data as JSON text in which no `<` can end the element that contains it.
std::string data_text(const Json& data) {
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
  safe.reserve(text.size());
  for (const char c : json_with_escapes(text)) {
    if (c == '<')
      safe += "\\u003c";
    else if (c == '&')
      safe += "\\u0026";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

std::string escaped(std::string_view text) { return escape_xml(text); }

std::string without_style(std::string picture) {
  const std::size_t begin = picture.find("<style>"), end = picture.find("</style>");
  if (begin != picture.npos && end != picture.npos) picture.erase(begin, end + std::string_view("</style>\n").size() - begin);
  return picture;
}

std::string facts_html(const Facts& facts) {
  std::string html = "<dl class=\"facts\">";
  for (const auto& [term, what] : facts) html += fmt::format("<dt>{}</dt><dd>{}</dd>", escaped(term), what);
  return html + "</dl>\n";
}

std::string table_html(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  std::string columns;
  for (const std::string& cell : header)
    if (!cell.empty()) columns += (columns.empty() ? "" : ", ") + cell;
  std::string html = fmt::format("<div class=\"scroll table\" role=\"region\" tabindex=\"0\" aria-label=\"Table: {}\">",
                                 escaped(shorten(columns, 120))) +
                     "<table><thead><tr>";
  for (const std::string& cell : header) html += fmt::format("<th scope=\"col\">{}</th>", escaped(cell));
  html += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (const std::string& text : row) html += fmt::format("<td>{}</td>", text);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string number_html(double value, std::string_view unit, int digits) {
  if (!std::isfinite(value)) return "";
  const std::string sign = unit_in_signs(unit);
  return fmt::format("<data value=\"{}\">{}</data>{}{}", value, with_powers(fmt::format("{:.{}g}", value, digits)),
                     sign.empty() || sign == "°" ? "" : " ", escaped(sign));
}

std::string number_html(const Json& value, std::string_view unit, int digits) {
  return value.is_number() ? number_html(value.get<double>(), unit, digits) : "";
}

Page::Page(std::string kind, std::string title, std::vector<std::string> notes)
    : title_(std::move(title)), notes_(std::move(notes)) {
  data_["kind"] = std::move(kind);
  data_["charts"] = Json::object();
}

void Page::verdict(std::string_view word, std::string html) {
  verdict_ = fmt::format("<div class=\"verdict {}\">{}</div>\n", escaped(word), std::move(html));
}

void Page::section(std::string_view id, std::string_view title, std::string html) {
  const bool is_folded = !folded_.empty();
  (is_folded ? folded_navigation_ : navigation_) +=
      fmt::format("<li><a href=\"#section-{0}\">{1}</a></li>", id, escaped(title));
  sections_ += fmt::format(
      "<section id=\"section-{0}\" aria-labelledby=\"title-{0}\">\n<h{3} id=\"title-{0}\">{1}</h{3}>\n{2}</section>\n", id,
      escaped(title), html, is_folded ? 3 : 2);
}

void Page::fold(std::string_view id, std::string_view title) {
  navigation_ += fmt::format("<li><a href=\"#section-{0}\">{1}</a></li>", id, escaped(title));
  folded_ = std::move(sections_) +
            fmt::format("<details class=\"folded\" id=\"section-{}\"><summary><h2>{}</h2></summary>\n", id, escaped(title));
  sections_.clear();
}

std::string Page::chart(const std::string& name, Figure figure, std::string_view caption, std::vector<double> at) {
  const std::vector<double> x = at.empty() ? all_x(figure) : std::move(at);
  const std::vector<Series> list = series_of(figure, x);
  data_["charts"][name] = chart_json(figure, x, list);
  const std::string table = details(table_of(figure, x, list));
  return drawn(name, std::move(figure), caption, table);
}

std::string Page::chart(const std::string& name, Figure figure, const Figure& listed, std::string_view caption) {
  const std::vector<double> x = all_x(listed);
  const std::vector<Series> list = series_of(listed, x);
  data_["charts"][name] = chart_json(figure, x, list);
  const std::string table = details(table_of(listed, x, list));
  return drawn(name, std::move(figure), caption, table);
}

std::string Page::chart_of_marks(const std::string& name, Figure figure, const std::vector<Mark>& marks,
                                 std::string_view caption) {
  Json& json = data_["charts"][name] = plot_json(figure);
  json["marks"] = Json::array();
  for (const Mark& mark : marks) json["marks"].push_back({mark.x, mark.y, mark.text});
  return drawn(name, std::move(figure), caption, "");
}

std::string Page::drawn(const std::string& name, Figure figure, std::string_view caption, const std::string& table) {
  figure.id = name;
  Drawings drawings{svg(figure), {}};
  figure.id += "-narrow";
  drawings.narrow = svg(figure, PlotWidth::narrow);
  std::string html = fmt::format("<figure class=\"chart\" data-chart=\"{}\">\n{}{}{}</figure>\n", name, drawings_html(drawings),
                                 caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>\n", table);
  if (small_.empty()) {  // one panel of it, which can be read
    figure.subtitle.clear();
    if (figure.title == title_) figure.title = "The drift of its axis";
    figure.panels.resize(1);
    small_ = svg(figure, PlotWidth::narrow);
  }
  keep(name, drawings);
  return html;
}

void Page::keep(const std::string& name, const Drawings& drawings) {
  if (small_.empty()) small_ = drawings.narrow;
  pictures_.emplace_back(name, drawings.wide);
}

void Page::belongs_to(const std::string& index, const std::string& html) {
  above_ = fmt::format("<p class=\"above\"><a href=\"{}\">The gallery</a> {}</p>\n", escaped(index), html);
}

std::string Page::picture(const std::string& name, Drawings drawings, std::string_view caption, const std::string& table) {
  std::string html = fmt::format("<figure class=\"chart\">\n{}<figcaption>{}</figcaption>\n{}</figure>\n",
                                 drawings_html(drawings), escaped(caption), details(table));
  keep(name, drawings);
  return html;
}

std::string Page::still(const std::string& name, Drawings drawings) {
  std::string html = "<div class=\"still\">\n" + drawings_html(drawings) + "</div>\n";
  keep(name, drawings);
  return html;
}

std::string Page::command(std::string_view text) {
  return fmt::format(
      "<pre class=\"command\" tabindex=\"0\"><code>{}</code></pre>\n<button type=\"button\" class=\"copy\">Copy</button>\n",
      escaped(text));
}

Report Page::finish() {
  const BuildInfo& build = build_info();
  std::string notes;
  for (const std::string& note : notes_) notes += fmt::format("<p class=\"note\">Note: {}.</p>\n", escaped(note));
  const std::string heading = finding_.empty()
                                  ? fmt::format("<h1>{}</h1>", escaped(title_))
                                  : fmt::format("<p class=\"subject\">{}</p>\n<h1>{}</h1>", escaped(title_), finding_);
  if (!folded_.empty())
    sections_ = folded_ + "<nav aria-label=\"Parts\"><ul>" + folded_navigation_ + "</ul></nav>\n" + sections_ + "</details>\n";
  const std::string body = fmt::format(
      "<a class=\"skip\" href=\"#main\">Skip to the content</a>\n<header>\n{}{}\n{}{}{}</header>\n"
      "<nav aria-label=\"Sections\"><ul>{}</ul></nav>\n<main id=\"main\">\n{}</main>\n<footer><p>earthtop {}, "
      "{}</p></footer>\n",
      above_, heading, headline_.empty() ? "" : "<p class=\"headline\">" + headline_ + "</p>\n", verdict_, notes, navigation_,
      sections_, escaped(build.version), escaped(build.commit));
  const Json& kind = data_["kind"];
  const std::string script = fmt::format("(() => {{\n\"use strict\";\n{}}})();\n", kind == "run"     ? run_script()
                                                                                   : kind == "study" ? study_script()
                                                                                                     : other_script());
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<link rel=\"icon\" "
      "href=\"data:,\">\n"
      "<style>{}</style>\n</head>\n<body>\n{}<script type=\"application/json\" "
      "id=\"earthtop-data\">{}</script>\n<script>{}</script>\n"
      "</body>\n</html>\n",
      kPolicyPlace, escaped(title_), page_style(), body, data_text(data_), script);
  set_content_policy(html);
  return {std::move(html),   std::move(pictures_), std::move(notes_), std::move(title_),
          std::move(group_), std::move(finding_),  std::move(small_)};
}

}  // namespace earthtop::report
