// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/figure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "results/meanings.hpp"
#include "results/unit_of_name.hpp"
#include "study/design.hpp"
#include "study/json_text.hpp"
#include "text/json.hpp"
#include "text/number_words.hpp"

namespace earthtop::study {
namespace {

constexpr std::size_t kMostLines = 7, kMostPanels = 3, kMostMarked = 60;
constexpr LineColor kColors[kMostLines] = {LineColor::blue,   LineColor::vermillion, LineColor::green, LineColor::purple,
                                           LineColor::orange, LineColor::sky,        LineColor::grey};

/// How many different numbers the axis takes; 0 if it takes words.
std::size_t numbers_of(const std::string& axis, const Json& points) {
  std::set<double> numbers;
  for (const Json& point : points) {
    if (!point.at(axis).is_number()) return 0;
    numbers.insert(point.at(axis).get<double>());
  }
  return numbers.size();
}

std::string shown(const StudyAxis& axis, const Json& value) {
  if (value.is_number()) return plain_text(meant_value(axis, value.get<double>()));
  return value.is_string() ? value.get<std::string>() : written(value);
}

/// Keys that vary together have the name that the study gives them, and no unit.
QuantityWords words_of(const StudyAxis& axis) {
  QuantityWords words = words_of_setting(axis.name, axis.pointers.front());
  if (axis.pointers.size() > 1) words.unit = unit_of_name(axis.name);
  return words;
}

/// "latitude 30°"
std::string other_label(const StudyAxis& axis, const Json& value) {
  const QuantityWords words = words_of(axis);
  const std::string unit = value.is_number() ? unit_in_signs(words.unit) : "";
  return fmt::format("{} {}{}{}", words.words, with_powers(shown(axis, value)), unit.empty() || unit == "°" ? "" : " ", unit);
}

/// Logarithmic if all numbers are positive and the largest exceeds a hundred times the smallest, else linear.
AxisScale scale_of(const std::vector<Line>& lines) {
  constexpr double kManySizes = 100;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Line& line : lines)
    for (const double y : line.y) {
      if (!std::isfinite(y)) continue;
      if (!(y > 0)) return AxisScale::linear;
      least = std::min(least, y);
      most = std::max(most, y);
    }
  return most > kManySizes * least ? AxisScale::logarithmic : AxisScale::linear;
}

}  // namespace

std::optional<Figure> study_figure(const Study& study, const Json& document) {
  const Json& points = document.at("points");
  if (points.is_null() || points.size() < 3 || study.axes.size() > 2 || study.design.kind != DesignKind::grid)
    return std::nullopt;
  std::size_t across = 0, most = 0;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (const std::size_t count = numbers_of(study.axes[a].name, points); count > most) across = a, most = count;
  if (most < 3) return std::nullopt;
  const StudyAxis& x = study.axes[across];
  const StudyAxis* other = study.axes.size() == 2 ? &study.axes[1 - across] : nullptr;
  if (other && other->size() > kMostLines) return std::nullopt;

  const QuantityWords x_words = words_of(x);
  Figure figure{study.title.empty() ? study.name : study.title,
                with_powers(study.finding),
                {x_words.words, unit_in_signs(x_words.unit),
                 x.range && x.range->logarithmic && x.range->from.front() > 0 ? AxisScale::logarithmic : AxisScale::linear},
                {}};
  for (const StudyQuantity& quantity : study.quantities) {
    if (quantity.name.ends_with("bound_rad") || quantity.name.ends_with("bound_m") || quantity.name.ends_with("bound_s") ||
        figure.panels.size() == kMostPanels)
      continue;
    std::vector<Line> lines;
    std::map<std::string, std::size_t> line_of;
    for (const Json& point : points) {
      const std::string label = other ? other_label(*other, point.at(other->name)) : "";
      const auto [at, is_new] = line_of.try_emplace(label, lines.size());
      if (is_new)
        lines.push_back({label,
                         {},
                         {},
                         kColors[lines.size() % kMostLines],
                         LineStyle::solid,
                         most <= kMostMarked ? Marker::circle : Marker::none});
      Line& line = lines[at->second];
      const Json& y = point.at(quantity.name);
      line.x.push_back(point.at(x.name).get<double>());
      line.y.push_back(y.is_number() ? y.get<double>() : std::numeric_limits<double>::quiet_NaN());
    }
    const bool any = std::any_of(lines.begin(), lines.end(), [](const Line& line) {
      return std::any_of(line.y.begin(), line.y.end(), [](double y) { return std::isfinite(y); });
    });
    if (!any) continue;
    const QuantityWords words = words_of_quantity(quantity.name, quantity.path);
    figure.panels.push_back({{words.words, unit_in_signs(words.unit), scale_of(lines)}, std::move(lines)});
  }
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

}  // namespace earthtop::study
