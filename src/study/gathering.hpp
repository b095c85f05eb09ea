// SPDX-License-Identifier: GPL-3.0-or-later
/// Gathers all results of a study in one pass over its points: counts, moments, means along each axis, fitted lines.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/collect.hpp"
#include "study/json_text.hpp"
#include "study/statistics.hpp"

namespace earthtop::study {

inline Json number_json(const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(); }
std::optional<double> number_of(const Value& value);

/// The quantiles that are told of a quantity, and the place of one in the ascending order of `count` numbers.
inline constexpr std::array<double, 3> kShares = {0.05, 0.5, 0.95};
inline std::uint64_t rank_of(double share, std::uint64_t count) {
  return count == 0 ? 0 : static_cast<std::uint64_t>(std::llround(share * static_cast<double>(count - 1)));
}

/// The group in which a point counts for the means along an axis: its value, or one of ten intervals if the axis is a range
/// from which the design draws.
class AxisLevels {
 public:
  AxisLevels(const StudyAxis& axis, bool drawn) : axis_(axis), binned_(drawn && axis.range) {}
  /// The group's sort key and its label; nothing for a point at the base.
  std::optional<std::pair<double, std::string>> of(const Value& value);

 private:
  const StudyAxis& axis_;
  bool binned_;
  std::map<std::string, double> order_;
};

/// A point as a document lists it.
Json point_json(const Study& study, const PointResult& point);

class Gathering {
 public:
  explicit Gathering(const Study& study);
  void include(const PointResult& point);

  const std::map<std::string, std::uint64_t>& statuses() const { return statuses_; }
  const std::vector<Moments>& moments() const { return moments_; }  ///< one for each quantity
  const Json& failures() const { return failures_; }                ///< the first few
  Json points() const;                                              ///< all of them; null if they are too many
  Json marginals();
  Json fits();

 private:
  /// The numbers of one quantity at one value of an axis.
  struct Level {
    Moments moments;
    std::vector<double> numbers;  ///< all of them; fewer where there are too many to keep
    std::array<std::optional<double>, 3> quantiles();
  };
  void include_in(Level& level, double number);
  void include_values(const PointResult& point);

  const Study& study_;
  std::vector<Moments> moments_;
  std::vector<AxisLevels> levels_;
  std::vector<std::map<std::pair<double, std::string>, std::vector<Level>>> along_;
  std::size_t kept_ = 0;                             // numbers in all levels
  static constexpr std::size_t kMostKept = 150'000;  // with what vectors reserve, 2 MB
  std::vector<LineFit> fits_;
  std::vector<std::pair<std::size_t, std::size_t>> places_;  // indices of axis and quantity of each fit
  std::map<std::string, std::uint64_t> statuses_;
  Json failures_ = Json::array(), points_ = Json::array();
};

}  // namespace earthtop::study
