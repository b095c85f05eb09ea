// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/gathering.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/elementary.hpp"
#include "study/design.hpp"

namespace earthtop::study {
namespace {

constexpr std::size_t kMaxListedPoints = 1000;  // points listed in the document
constexpr std::size_t kMostLevels = 500;        // groups of one axis for which means are listed
constexpr std::size_t kMostFailures = 20;
constexpr int kBins = 10;  // intervals of a range from which the design draws

Json cell_json(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return nullptr;
}

template <class List>
std::size_t index_of(const List& list, const std::string& name) {
  return static_cast<std::size_t>(std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.name == name; }) -
                                  list.begin());
}

/// The curve of a fit as a formula.
std::string law_of(const StudyFit& fit) {
  const std::string& x = fit.axis;
  switch (fit.kind) {
    case FitKind::linear: return fmt::format("{} = a + b {}", fit.quantity, x);
    case FitKind::sin_latitude: return fmt::format("{} = a + b sin({}°)", fit.quantity, x);
    case FitKind::cos_latitude: return fmt::format("{} = a + b cos({}°)", fit.quantity, x);
    case FitKind::logarithmic: return fmt::format("{} = a + b ln|{}|", fit.quantity, x);
    case FitKind::power_law: return fmt::format("|{}| = a |{}|^b", fit.quantity, x);
  }
  return "";
}

}  // namespace

std::optional<double> number_of(const Value& value) {
  const auto* number = std::get_if<double>(&value);
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<std::pair<double, std::string>> AxisLevels::of(const Value& value) {
  if (std::holds_alternative<std::monostate>(value)) return std::nullopt;
  if (!binned_) {
    const std::string text = plain_text(meant_value(axis_, value));
    const auto place = order_.try_emplace(text, static_cast<double>(order_.size())).first->second;
    const auto number = number_of(value);
    return std::pair(number ? *number : place, text);
  }
  const double from = axis_.range->from.front(), to = axis_.range->to.front(), x = number_of(value).value_or(from);
  const double part = axis_.range->logarithmic ? real::log(x / from) / real::log(to / from) : (x - from) / (to - from);
  // A value that the design cannot have drawn belongs to the interval at its end of the range, and to the first if it has no place.
  const double place = std::min<double>(part * kBins, kBins - 1);
  const int bin = place > 0 ? static_cast<int>(place) : 0;
  const auto edge = [&](int i) {
    const double share = static_cast<double>(i) / kBins;
    return axis_.range->logarithmic ? from * real::pow(to / from, share) : from + (to - from) * share;
  };
  return std::pair(static_cast<double>(bin), fmt::format("{:.6g} to {:.6g}", edge(bin), edge(bin + 1)));
}

Gathering::Gathering(const Study& study) : study_(study), moments_(study.quantities.size()) {
  levels_.reserve(study.axes.size());
  for (const StudyAxis& axis : study.axes) levels_.emplace_back(axis, is_drawn(study.design.kind));
  along_.resize(study.axes.size());
  fits_ = std::vector<LineFit>(study.fits.size());
  for (const StudyFit& fit : study.fits) {
    places_.emplace_back(index_of(study.axes, fit.axis), index_of(study.quantities, fit.quantity));
  }
}

void Gathering::include(const PointResult& point) {
  ++statuses_[point.status];
  if (point.failed()) {
    if (failures_.size() < kMostFailures)
      failures_.push_back({{"point", point.number}, {"status", point.status}, {"reason", point.reason}});
  } else {
    include_values(point);
  }
  if (points_.size() <= kMaxListedPoints) points_.push_back(point_json(study_, point));
}

Json Gathering::points() const { return points_.size() <= kMaxListedPoints ? points_ : Json(); }

std::array<std::optional<double>, 3> Gathering::Level::quantiles() {
  std::array<std::optional<double>, 3> found;
  if (numbers.size() != moments.count) return found;
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = numbers[rank_of(kShares[i], numbers.size())];
  return found;
}

void Gathering::include_in(Level& level, double number) {
  level.moments.include(number);
  if (kept_ > kMostKept) return;
  if (++kept_ <= kMostKept) return level.numbers.push_back(number == 0 ? 0.0 : number);
  for (auto& levels : along_)  // there are too many to keep them in memory
    for (auto& [place, list] : levels)
      for (Level& each : list) std::vector<double>().swap(each.numbers);
}

Json Gathering::marginals() {
  Json axes = Json::object();
  for (std::size_t a = 0; a < study_.axes.size(); ++a) {
    if (along_[a].size() > kMostLevels) continue;
    Json rows = Json::array();
    for (auto& [place, level] : along_[a]) {
      Json row = {{"value", place.second}};
      for (std::size_t q = 0; q < level.size(); ++q)
        if (const Moments& m = level[q].moments; m.count > 0) {
          const auto quantiles = level[q].quantiles();
          row[study_.quantities[q].name] = {{"count", m.count},
                                            {"mean", m.mean},
                                            {"standard_deviation", number_json(m.standard_deviation())},
                                            {"quantile_05", number_json(quantiles[0])},
                                            {"median", number_json(quantiles[1])},
                                            {"quantile_95", number_json(quantiles[2])}};
        }
      rows.push_back(std::move(row));
    }
    axes[study_.axes[a].name] = std::move(rows);
  }
  return axes;
}

Json Gathering::fits() {
  Json list = Json::array();
  for (std::size_t f = 0; f < fits_.size(); ++f) {
    const StudyFit& fit = study_.fits[f];
    Json json = {{"kind", to_string(fit.kind)}, {"axis", fit.axis}, {"quantity", fit.quantity}, {"law", law_of(fit)}};
    const auto line = fits_[f].line();
    const bool power = fit.kind == FitKind::power_law;
    const std::optional<double> none;
    // For a power law, a is the exponential of the line's intercept, and its error is scaled accordingly.
    const auto a = !line ? none : power ? std::optional(real::exp(line->a)) : std::optional(line->a);
    const auto a_error = !line || !line->a_standard_error ? none
                         : power                          ? std::optional(*a * *line->a_standard_error)
                                                          : line->a_standard_error;
    json["points"] = line ? line->points : 0;
    json["a"] = number_json(a);
    json["a_standard_error"] = number_json(a_error);
    json["b"] = number_json(line ? std::optional(line->b) : none);
    json["b_standard_error"] = number_json(line ? line->b_standard_error : none);
    json[power ? "residual_rms_of_logarithm" : "residual_rms"] = number_json(line ? line->residual_rms : none);
    list.push_back(std::move(json));
  }
  return list;
}

void Gathering::include_values(const PointResult& point) {
  for (std::size_t q = 0; q < moments_.size(); ++q)
    if (const auto y = number_of(point.values[q])) moments_[q].include(*y);
  for (std::size_t a = 0; a < levels_.size(); ++a) {
    if (along_[a].size() > kMostLevels) continue;
    const auto place = levels_[a].of(point.axis_values[a]);
    if (!place) continue;
    std::vector<Level>& level = along_[a][*place];
    level.resize(moments_.size());
    for (std::size_t q = 0; q < level.size(); ++q)
      if (const auto y = number_of(point.values[q])) include_in(level[q], *y);
  }
  for (std::size_t f = 0; f < fits_.size(); ++f) {
    const auto x = number_of(point.axis_values[places_[f].first]), y = number_of(point.values[places_[f].second]);
    if (!x || !y) continue;
    switch (study_.fits[f].kind) {
      case FitKind::linear: fits_[f].include(*x, *y); break;
      case FitKind::sin_latitude: fits_[f].include(real::sin(*x * std::numbers::pi / 180), *y); break;
      case FitKind::cos_latitude: fits_[f].include(real::cos(*x * std::numbers::pi / 180), *y); break;
      case FitKind::logarithmic:
        if (*x != 0) fits_[f].include(real::log(std::abs(*x)), *y);
        break;
      case FitKind::power_law:
        if (*x != 0 && *y != 0) fits_[f].include(real::log(std::abs(*x)), real::log(std::abs(*y)));
        break;
    }
  }
}

Json point_json(const Study& study, const PointResult& point) {
  Json row = {{"point", point.number}};
  for (std::size_t a = 0; a < study.axes.size(); ++a) row[study.axes[a].name] = cell_json(point.axis_values[a]);
  for (std::size_t q = 0; q < study.quantities.size(); ++q) row[study.quantities[q].name] = cell_json(point.values[q]);
  row["status"] = point.status;
  return row;
}

}  // namespace earthtop::study
