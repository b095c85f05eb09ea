// SPDX-License-Identifier: GPL-3.0-or-later
#include "study_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "earthtop/error.hpp"
#include "text/number_words.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

using Json = nlohmann::ordered_json;
using Row = std::vector<std::string>;

std::string cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_number_integer() || value.is_number_unsigned()) return fmt::format("{}", value.get<std::int64_t>());
  if (value.is_number()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_string()) return printable(value.get<std::string>());
  return printable(value.dump());
}

/// How a value of an axis is told: with the digits that were meant.
class AxisText {
 public:
  explicit AxisText(const Json& axis, const Json& design) {
    const std::string kind = design.at("kind").get<std::string>();
    drawn_ = kind == "random" || kind == "latin_hypercube" || kind == "sobol";
    for (const bool logarithmic : {false, true})
      if (const char* key = logarithmic ? "log_range" : "range"; axis.contains(key)) {
        logarithmic_ = logarithmic;
        is_range_ = true;
        from_ = axis.at(key).at("from").at(0).get<double>();
        to_ = axis.at(key).at("to").at(0).get<double>();
      }
  }
  std::string operator()(const Json& value) const {
    if (!value.is_number() || drawn_) return cell(value);
    const auto number = value.get<double>();
    std::string text =
        fmt::format("{}", is_range_ ? meant_number(number, rounding_of_step(from_, to_, logarithmic_, number)) : number);
    constexpr std::size_t kLong = 12;
    return is_range_ && text.size() > kLong ? fmt::format("{:.9g}", number) : text;
  }

 private:
  bool drawn_ = false, is_range_ = false, logarithmic_ = false;
  double from_ = 0, to_ = 0;
};

/// Lays out columns as wide as their widest cells, with numbers to the right.
std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format(" {:>{}}", row[i], widths[i]);
    text += line + '\n';
  }
  return text;
}

std::string with_error(const Json& value, const Json& error) {
  if (value.is_null()) return "-";
  return error.is_null() ? fmt::format("{:.8g}", value.get<double>())
                         : fmt::format("{:.8g} +- {:.2g}", value.get<double>(), error.get<double>());
}

std::string statistics_text(const Json& document) {
  std::vector<Row> rows = {{"quantity", "count", "mean", "std. dev.", "min", "5 %", "median", "95 %", "max"}};
  for (const auto& [name, s] : document.at("statistics").items())
    rows.push_back({name, cell(s.at("count")), cell(s.at("mean")), cell(s.at("standard_deviation")), cell(s.at("min")),
                    cell(s.at("quantile_05")), cell(s.at("median")), cell(s.at("quantile_95")), cell(s.at("max"))});
  return rows.size() > 1 ? "\nStatistics\n" + table(rows) : "";
}

/// The points one by one, or for a grid of two axes the first quantity as a matrix.
std::string points_text(const Json& document) {
  const Json& axes = document.at("axes");
  const Json& points = document.at("points");
  constexpr std::size_t kMostRows = 60, kMostColumns = 10;
  if (points.is_null() || axes.size() > 2) return "";
  const std::string quantity = document.at("quantities").at(0).at("name").get<std::string>();
  if (axes.size() == 2 && document.at("design").at("kind") == "grid") {
    const std::string down = axes[0].at("name").get<std::string>(), across = axes[1].at("name").get<std::string>();
    const AxisText text_down(axes[0], document.at("design")), text_across(axes[1], document.at("design"));
    std::vector<Row> rows = {{fmt::format("{} \\ {}", down, across)}};
    for (const Json& point : points) {
      const std::string x = text_across(point.at(across)), y = text_down(point.at(down));
      const auto column = std::find(rows[0].begin() + 1, rows[0].end(), x) - rows[0].begin();
      if (column == static_cast<std::ptrdiff_t>(rows[0].size())) rows[0].push_back(x);
      if (rows.size() == 1 || rows.back()[0] != y) rows.push_back({y});
      rows.back().resize(std::max(rows.back().size(), static_cast<std::size_t>(column) + 1));
      rows.back()[static_cast<std::size_t>(column)] = cell(point.at(quantity));
    }
    if (rows.size() <= kMostRows && rows[0].size() <= kMostColumns + 1) return fmt::format("\n{}\n", quantity) + table(rows);
  }
  if (points.size() > kMostRows) return "";
  Row head = {"point"};
  for (const Json& axis : axes) head.push_back(axis.at("name").get<std::string>());
  for (const Json& q : document.at("quantities")) head.push_back(q.at("name").get<std::string>());
  std::vector<Row> rows = {head};
  std::vector<AxisText> texts;
  for (const Json& axis : axes) texts.emplace_back(axis, document.at("design"));
  for (const Json& point : points) {
    Row row;
    for (std::size_t i = 0; i < head.size(); ++i)
      row.push_back(i > 0 && i <= axes.size() ? texts[i - 1](point.at(head[i])) : cell(point.at(head[i])));
    rows.push_back(std::move(row));
  }
  return "\nPoints\n" + table(rows);
}

/// Means and quantiles along each axis, which can be shown even if there are too many points or axes to list.
std::string marginals_text(const Json& document) {
  std::string text;
  constexpr std::size_t kMostRows = 40, kMostQuantities = 4;
  for (const auto& [axis, levels] : document.at("marginals").items()) {
    if (levels.size() < 2 || levels.size() > kMostRows) continue;
    std::size_t shown = 0;
    for (const Json& q : document.at("quantities")) {
      const std::string name = q.at("name").get<std::string>();
      if (!document.at("statistics").contains(name) || ++shown > kMostQuantities) continue;
      std::vector<Row> rows = {{axis, "count", "mean", "5 %", "median", "95 %"}};
      for (const Json& level : levels) {
        Row row = {cell(level.at("value"))};
        for (const char* key : {"count", "mean", "quantile_05", "median", "quantile_95"})
          row.push_back(level.contains(name) ? cell(level.at(name).value(key, Json())) : "");
        rows.push_back(std::move(row));
      }
      text += fmt::format("\nMeans and quantiles of {} along {}\n", name, axis) + table(rows);
    }
  }
  return text;
}

std::string fits_text(const Json& document) {
  std::string text;
  for (const Json& fit : document.at("fits")) {
    const bool power = fit.at("kind") == "power_law";
    text += fmt::format("  {}, {} points\n    a = {}\n    b = {}\n    residual {} (rms{})\n", cell(fit.at("law")),
                        cell(fit.at("points")), with_error(fit.at("a"), fit.at("a_standard_error")),
                        with_error(fit.at("b"), fit.at("b_standard_error")),
                        cell(fit.at(power ? "residual_rms_of_logarithm" : "residual_rms")), power ? ", of the logarithm" : "");
  }
  return text.empty() ? "" : "\nFits (standard errors from the scatter)\n" + text;
}

/// A sentence of the document, as lines of its own.
std::string told(std::string_view begin, const Json& sentence, std::size_t width) {
  return wrapped(fmt::format("  {}{}", begin, cell(sentence)), width, 4) + '\n';
}

std::string value_with_error(const Json& value, const Json& error, int digits) {
  return fmt::format("{:.{}f} +- {:.{}f}", value.get<double>(), digits, error.get<double>(), digits);
}

std::string indices_text(const Json& document, std::size_t width) {
  std::string text;
  if (document.contains("indices_note")) text += '\n' + told("", document.at("indices_note"), width);
  if (!document.contains("indices_basis")) return text;
  for (const auto& [quantity, basis] : document.at("indices_basis").items()) {
    if (!document.at("indices").contains(quantity)) {
      if (!document.contains("indices_note"))
        text += '\n' + told(fmt::format("No Sobol indices of {}: ", quantity), basis.at("no_indices"), width);
      continue;
    }
    std::vector<Row> rows = {{"input", "first order", "total order"}};
    for (const auto& [axis, index] : document.at("indices").at(quantity).items())
      rows.push_back({axis, value_with_error(index.at("first_order"), index.at("first_order_standard_error"), 4),
                      value_with_error(index.at("total_order"), index.at("total_order_standard_error"), 4)});
    text += fmt::format("\nSobol indices of {}, {}\n", quantity, cell(basis.at("basis"))) + table(rows);
    if (basis.contains("warning")) text += told("Warning: ", basis.at("warning"), width);
    text += told("", basis.at("sentence"), width);
  }
  return text;
}

std::string derivatives_text(const Json& document, std::size_t width) {
  std::string text;
  if (!document.contains("derivative_indices")) return text;
  for (const auto& [quantity, axes] : document.at("derivative_indices").items()) {
    std::vector<Row> rows = {{"input", "points", "mean of squared derivative", "total order at most"}};
    for (const auto& [axis, index] : axes.items())
      rows.push_back({axis, cell(index.at("points")),
                      fmt::format("{:.4e} +- {:.1e}", index.at("mean_square").get<double>(),
                                  index.at("mean_square_standard_error").get<double>()),
                      value_with_error(index.at("total_order_bound"), index.at("total_order_bound_standard_error"), 4)});
    text += fmt::format("\nDerivative-based indices of {}\n", quantity) + table(rows);
  }
  const Json& notes = document.at("derivative_notes");
  if (!notes.empty() && text.empty()) text += '\n';
  for (const Json& note : notes) text += told("", note, width);
  return text;
}

std::string figures_text(const Json& document, std::size_t width) {
  std::string text;
  for (const Json& figure : document.at("figures"))
    text +=
        wrapped(fmt::format("  {}: {} {}; stated {:.10g} +- {:.2g}, {}", figure.at("met").get<bool>() ? "met" : "NOT MET",
                            cell(figure.at("figure")),
                            figure.at("computed").is_null() ? "is missing"
                                                            : fmt::format("= {:.10g}", figure.at("computed").get<double>()),
                            figure.at("value").get<double>(), figure.at("tolerance").get<double>(), cell(figure.at("origin"))),
                width, 6) +
        '\n';
  return text.empty() ? "" : "\nFigures known from elsewhere\n" + text;
}

std::string failures_text(const Json& document, std::size_t width) {
  std::string text;
  for (const Json& failure : document.at("failures"))
    text += wrapped(fmt::format("  point {}: {}: {}", cell(failure.at("point")), cell(failure.at("status")),
                                cell(failure.at("reason"))),
                    width, 6) +
            '\n';
  const auto failed = document.at("points_failed").get<std::uint64_t>(), shown = std::uint64_t{document.at("failures").size()};
  if (failed > shown) text += fmt::format("  and {} more\n", failed - shown);
  return text.empty() ? "" : "\nFailed points\n" + text;
}

}  // namespace

std::string study_text(std::string_view json, std::size_t width) {
  const Json document = Json::parse(json);
  const std::string title = printable(document.at("title").get<std::string>());
  std::string text = wrapped(title.empty() ? document.at("name").get<std::string>() : title, width, 2) + '\n';
  if (const std::string finding = printable(document.at("finding").get<std::string>()); !finding.empty())
    text += wrapped_entry("Finding", finding, width, 12);
  text += fmt::format("Points      {} of {}, {} failed\n", cell(document.at("points_computed")),
                      cell(document.at("points_planned")), cell(document.at("points_failed")));
  const std::string points = points_text(document);
  return text + points + statistics_text(document) + (points.empty() ? marginals_text(document) : "") + fits_text(document) +
         indices_text(document, width) + derivatives_text(document, width) + figures_text(document, width) +
         failures_text(document, width);
}

std::string selected_points_text(std::string_view json) {
  const Json document = Json::parse(json);
  std::vector<Row> rows = {{}};
  for (const Json& column : document.at("columns")) rows[0].push_back(column.get<std::string>());
  for (const Json& point : document.at("points")) {
    Row row;
    for (const std::string& column : rows[0]) row.push_back(cell(point.at(column)));
    rows.push_back(std::move(row));
  }
  const auto matching = document.at("matching").get<std::uint64_t>(), listed = document.at("listed").get<std::uint64_t>();
  if (document.contains("worst"))
    return fmt::format("Worst points by {}, {} first\n", cell(document.at("worst")), cell(document.at("worst_means"))) +
           table(rows);
  std::string text = fmt::format("Points that meet the conditions: {}\n", matching);
  if (listed > 0) text += table(rows);
  if (listed < matching) text += fmt::format("  and {} more\n", matching - listed);
  return text;
}

StudyCounts study_counts(std::string_view json) {
  const Json document = Json::parse(json);
  const auto count = [&](const char* name) { return document.at(name).get<std::uint64_t>(); };
  return {count("points_planned"), count("points_computed"), count("points_failed")};
}

}  // namespace earthtop::tool
