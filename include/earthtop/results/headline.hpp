// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario's headline figure, known from elsewhere, held against the computed one.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "earthtop/run.hpp"

namespace earthtop {

struct HeadlineCheck {
  HeadlineSpec stated;
  std::optional<double> at_s;        ///< of a column: the row's time (s); none for a figure of summary.json
  std::optional<double> computed;    ///< unit of the quantity; none where the run has no such number
  std::optional<double> difference;  ///< computed - stated
  bool met = false;                  ///< the run came to its end, and the difference is within the tolerance
};

/// A run's number by its name: a column of trajectory.csv in the row of time `t_s`, or a figure of summary.json, which has no
/// time. None where the run has no such number, or it is not finite.
std::optional<double> find_figure(const RunResult& result, std::string_view quantity, double t_s);

/// None where the scenario states no headline. A value that is missing or not finite is "not met".
std::optional<HeadlineCheck> check_headline(const RunResult& result);

}  // namespace earthtop
