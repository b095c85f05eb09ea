// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <cmath>

#include "scenario/decode.hpp"
#include "text/number_words.hpp"

namespace earthtop {

OutputTimes::OutputTimes(double duration_s, double output_step_s) : duration_s_(duration_s), step_s_(output_step_s) {
  if (!(duration_s > 0) || !std::isfinite(duration_s))
    throw ScenarioError("/motion/duration_s", fmt::format("{} is not a duration; must be above 0 (s)", duration_s));
  if (!(output_step_s > 0))
    throw ScenarioError("/motion/output_step_s", fmt::format("{} is not a time step; must be above 0 (s)", output_step_s));
  const double rows = scenario::output_row_count(duration_s, output_step_s);
  if (rows > scenario::kMostRows)
    throw ScenarioError("/motion/output_step_s",
                        fmt::format("about {} output rows; at most {:.0f} are allowed",
                                    told_apart(rows, scenario::kMostRows, 3).first, scenario::kMostRows));
  const auto is_before_end = [&](double k) { return duration_s - k * output_step_s > 1e-9 * output_step_s; };
  double last = std::ceil(rows);  // the row at the end
  while (last > 1 && !is_before_end(last - 1)) --last;
  while (is_before_end(last)) ++last;
  size_ = static_cast<std::size_t>(last) + 1;
}

std::vector<double> output_times(double duration_s, double output_step_s) {
  const OutputTimes times(duration_s, output_step_s);
  std::vector<double> all(times.size());
  for (std::size_t row = 0; row < all.size(); ++row) all[row] = times.at(row);
  return all;
}

}  // namespace earthtop
