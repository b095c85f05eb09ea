// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/study_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "report/study_finding.hpp"
#include "report/study_words.hpp"

namespace earthtop::report {
namespace {

std::string as_title(std::string words) {
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words;
}

/// A bar for each of what has no place on an axis; the subtitle says which is which.
Figure bars_of(std::string title, const StudyColumn& quantity, std::string x_label, const std::vector<Level>& levels) {
  Figure figure{as_title(std::move(title)), "", {as_title(std::move(x_label)), ""}, {}};
  Line bars{"", {}, {}, LineColor::blue, LineStyle::bars};
  for (const Level& level : levels) {
    bars.x.push_back(static_cast<double>(bars.x.size() + 1));
    bars.y.push_back(level.mean * quantity.factor);
    if (!level.name.empty())
      figure.subtitle += fmt::format("{}{:g}: {}", figure.subtitle.empty() ? "" : "; ", bars.x.back(), level.name);
  }
  figure.panels.push_back({{quantity.words, quantity.unit}, {std::move(bars)}});
  return figure;
}

/// The means over a setting that has numbers, as points.
Figure curve_of(const Json& study, const ToldMeans& told) {
  const auto& [quantity, setting, levels] = told;
  bool is_logarithmic = false;
  for (const Json& axis : study.at("axes"))
    if (axis.value("name", "") == setting.key) is_logarithmic = axis.value("log_range", Json()).is_object();
  Figure figure{fmt::format("{} over the {}", as_title(quantity.words), setting.words),
                study.at("axes").size() > 1 ? "Mean over the other settings" : "",
                {setting.words, setting.unit, is_logarithmic ? AxisScale::logarithmic : AxisScale::linear},
                {}};
  Line points{"", {}, {}, LineColor::blue, LineStyle::solid, Marker::circle};
  for (const Level& level : levels) {
    points.x.push_back(level.place.value_or(0));
    points.y.push_back(level.mean * quantity.factor);
  }
  figure.panels.push_back({{quantity.words, quantity.unit}, {std::move(points)}});
  return figure;
}

/// The quantity at each point, where no setting by itself moves it; none where there are more points than bars can show.
std::vector<Level> values_at_points(const Json& study, const StudyColumn& quantity) {
  constexpr std::size_t kMost = 24;
  std::vector<Level> levels;
  const Json points = study.value("points", Json());
  if (!points.is_array() || points.size() > kMost) return levels;
  for (const Json& point : points)
    if (const Json value = point.value(quantity.key, Json()); value.is_number())
      levels.push_back({"", {}, value.get<double>(), 1});
  return levels;
}

}  // namespace

std::string study_picture(const Json& study) {
  Figure figure;
  if (const auto told = told_means(study)) {
    const bool is_curve = std::all_of(told->levels.begin(), told->levels.end(), [](const Level& level) { return level.place; });
    if (is_curve)
      figure = curve_of(study, *told);
    else if (told->setting.words.empty())
      figure = bars_of("change of the " + told->quantity.words, told->quantity, "setting that is changed", told->levels);
    else
      figure = bars_of(told->quantity.words, told->quantity, told->setting.words, told->levels);
  } else if (const auto quantity = quantity_told(study)) {
    const std::vector<Level> levels = values_at_points(study, *quantity);
    if (levels.empty()) return "";
    figure = bars_of(quantity->words, *quantity, "point", levels);
  } else {
    return "";
  }
  figure.id = "means";
  return svg(figure, PlotWidth::narrow);
}

}  // namespace earthtop::report
