// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares a scenario's headline figure, which is known from another source, with the computed one.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "earthtop/run.hpp"

namespace earthtop {

struct HeadlineCheck {
  HeadlineSpec stated;
  std::optional<double> at_s;        ///< for a column: time of the row (s); none for a figure of summary.json
  std::optional<double> computed;    ///< in the unit of the quantity; none if the run has no such number
  std::optional<double> difference;  ///< computed - stated
  bool met = false;                  ///< the run was completed, and the difference is within the tolerance
};

/// A number of a run by its name: a column of trajectory.csv in the row at time `t_s`, or a figure of summary.json (which has
/// no time). None if the run has no such number, or if it is not finite.
std::optional<double> find_figure(const RunResult& result, std::string_view quantity, double t_s);

/// None if the scenario states no headline. A value that is missing or not finite counts as not met.
std::optional<HeadlineCheck> check_headline(const RunResult& result);

}  // namespace earthtop
