// SPDX-License-Identifier: GPL-3.0-or-later
/// The data of a run that its page is made of.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/comparand.hpp"
#include "earthtop/scene/scene.hpp"
#include "earthtop/watch.hpp"
#include "results/time_unit.hpp"

namespace earthtop::report {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Index of a column of trajectory.csv in a row.
inline std::size_t column(std::string_view name) { return *compare::trajectory_table().find(name); }
inline double value(const compare::Row& row, std::size_t at) {
  return row.kind[at] == compare::CellKind::number ? row.value[at] : kNoNumber;
}

struct Run {
  compare::Comparand results;
  std::optional<Scene> scene;  ///< none where the summary's text is not one that this version reads
  std::vector<compare::Row> rows;
  bool has_contact = false;  ///< whether the rows have the columns of a top on a table
  TimeUnit time{"s", 1};
  Watch watch;  ///< may stop the work on the page
  std::string word(const std::string& pointer) const { return results.word(pointer); }
  std::optional<double> number(const std::string& pointer) const { return results.number(pointer); }
};

/// The values of a column in all rows, times a factor.
inline std::vector<double> values(const Run& run, std::string_view name, double factor = 1) {
  std::vector<double> list;
  list.reserve(run.rows.size());
  const std::size_t at = column(name);
  for (const compare::Row& row : run.rows) list.push_back(value(row, at) * factor);
  return list;
}

/// The size of the number that is farthest from 0; 0 where none is finite.
inline double largest_size(const std::vector<double>& list) {
  double most = 0;
  for (const double number : list)
    if (std::isfinite(number)) most = std::max(most, std::abs(number));
  return most;
}

/// The rows' times, in the run's unit.
inline std::vector<double> times(const Run& run) {
  std::vector<double> list;
  list.reserve(run.rows.size());
  for (const compare::Row& row : run.rows) list.push_back(row.t_s * run.time.per_s);
  return list;
}

}  // namespace earthtop::report
