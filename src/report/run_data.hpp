// SPDX-License-Identifier: GPL-3.0-or-later
/// The data of a run that its page is made of.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/comparand.hpp"
#include "earthtop/plot/plot.hpp"
#include "earthtop/scene/scene.hpp"
#include "earthtop/watch.hpp"
#include "results/compared_words.hpp"
#include "results/time_unit.hpp"
#include "results/turns.hpp"

namespace earthtop::report {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Index of a column of trajectory.csv in a row.
inline std::size_t column(std::string_view name) { return *compare::trajectory_table().find(name); }
inline double value(const compare::Row& row, std::size_t at) {
  return row.kind[at] == compare::CellKind::number ? row.value[at] : kNoNumber;
}

/// Rows of a motion.
struct Motion {
  std::vector<compare::Row> rows;
  std::size_t a_window = 0;  ///< number of rows in each window between which and the next nothing is known; 0: there are none
  bool is_resolved = false;  ///< whether the rows resolve the fastest motion of the axes
};

struct Run {
  compare::Comparand results;
  std::optional<Scene> scene;   ///< none where the summary's text is not one that this version reads
  Motion listed;                ///< the output rows, or as many as a page can list: texts, tables and values under a pointer
  Motion drawn;                 ///< for the charts
  Motion played;                ///< for the pictures that move: without windows
  bool played_is_mean = false;  ///< whether the motion that is played is a mean over windows
  std::string drawn_words, played_words;  ///< a sentence on where each comes from
  bool has_contact = false;               ///< whether the rows have the columns of a top on a table
  TimeUnit time{"s", 1};
  Watch watch;  ///< may stop the work on the page
  std::string word(const std::string& pointer) const { return results.word(pointer); }
  std::optional<double> number(const std::string& pointer) const { return results.number(pointer); }
  const ComparedWords& compared() const { return compared_words(word("/travel/reference") == "at_rest"); }
};

inline std::string title_of(const Run& run) {
  const std::string title = run.word("/title").empty() ? run.word("/name") : run.word("/title");
  return title.empty() ? "A run" : title;
}

/// The values of a column in all rows, times a factor.
inline std::vector<double> values(const Motion& motion, std::string_view name, double factor = 1) {
  std::vector<double> list;
  list.reserve(motion.rows.size());
  const std::size_t at = column(name);
  for (const compare::Row& row : motion.rows) list.push_back(value(row, at) * factor);
  return list;
}

/// When the verdict trusts the drift. Results that state no times in which it does not say from when on.
class Trust {
 public:
  explicit Trust(const Run& run) {
    for (std::size_t i = 0;; ++i) {
      const std::string at = "/drift/verdict_intervals/" + std::to_string(i);
      const auto from = run.number(at + "/from_s"), until = run.number(at + "/until_s");
      if (!from) break;
      untrusted_.push_back({*from, until.value_or(kEnd)});
    }
    if (const auto from = run.number("/drift/verdict_from_s"); from && untrusted_.empty()) untrusted_.push_back({*from, kEnd});
  }
  bool at(double t_s) const {
    return std::none_of(untrusted_.begin(), untrusted_.end(),
                        [&](const Interval& interval) { return t_s >= interval.from_s && t_s < interval.until_s; });
  }

 private:
  static constexpr double kEnd = std::numeric_limits<double>::infinity();
  struct Interval {
    double from_s, until_s;
  };
  std::vector<Interval> untrusted_;
};

/// The size of the number that is farthest from 0; 0 where none is finite.
inline double largest_size(const std::vector<double>& list) {
  double most = 0;
  for (const double number : list)
    if (std::isfinite(number)) most = std::max(most, std::abs(number));
  return most;
}

/// The rows' times, in the run's unit.
inline std::vector<double> times(const Run& run, const Motion& motion) {
  std::vector<double> list;
  list.reserve(motion.rows.size());
  for (const compare::Row& row : motion.rows) list.push_back(row.t_s * run.time.per_s);
  return list;
}

/// A line of a chart. The values of a resolved motion turn smoothly between its rows.
/// @param parts  as of move_to_turns
inline Line line_of(const Motion& motion, std::string label, std::vector<double> t, std::vector<double> y,
                    LineColor color = LineColor::blue, LineStyle style = LineStyle::solid,
                    std::span<const std::vector<double>> parts = {}) {
  Line line{std::move(label), std::move(t), std::move(y), color, style};
  line.a_column = motion.a_window;
  if (motion.is_resolved) move_to_turns(line.x, line.y, parts);
  return line;
}

}  // namespace earthtop::report
