// SPDX-License-Identifier: GPL-3.0-or-later
/// The times at which an integration shows its state: those of the rows, and those at which the trend looks at the azimuths.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

template <class T>
class TimesOfLooks {
 public:
  /// @param rows  in natural units, ascending   @param method  only the series, whose steps no look shortens, looks for a trend
  TimesOfLooks(const std::vector<T>& rows, const DriftProblem<T>& problem, Method method) : times_(rows) {
    if (problem.trend_times_s.empty() || method != Method::taylor || problem.threshold_rad || problem.table) return;
    times_.clear();
    times_.reserve(rows.size() + problem.trend_times_s.size());
    row_.reserve(times_.capacity());
    std::size_t row = 0;
    const auto add_row = [&] {
      times_.push_back(rows[row]);
      row_.push_back(row++);
    };
    for (const double t_s : problem.trend_times_s) {
      const T t = problem.units.time_from_s(T(t_s));
      while (row < rows.size() && !(t < rows[row])) add_row();
      if (row == rows.size()) break;  // the run ends with a row
      times_.push_back(t);
      row_.push_back(kTrend);
      ++trend_count_;
    }
    while (row < rows.size()) add_row();
  }

  const std::vector<T>& times() const { return times_; }
  bool is_of_trend(std::size_t look) const { return !row_.empty() && row_[look] == kTrend; }
  std::size_t row(std::size_t look) const { return row_.empty() ? look : row_[look]; }
  std::size_t trend_count() const { return trend_count_; }

 private:
  static constexpr std::size_t kTrend = std::numeric_limits<std::size_t>::max();
  std::vector<T> times_;
  std::vector<std::size_t> row_;  ///< number of the row of each time, or kTrend; empty if all are rows
  std::size_t trend_count_ = 0;
};

}  // namespace earthtop
