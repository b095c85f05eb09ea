// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <cmath>

#include "scenario/decode.hpp"
#include "text/number_words.hpp"

namespace earthtop {

std::vector<double> output_times(double duration_s, double output_step_s) {
  if (!(duration_s > 0) || !std::isfinite(duration_s))
    throw ScenarioError("/motion/duration_s", fmt::format("{} is not a duration; must be above 0 (s)", duration_s));
  if (!(output_step_s > 0))
    throw ScenarioError("/motion/output_step_s", fmt::format("{} is not a time step; must be above 0 (s)", output_step_s));
  const double rows = scenario::output_row_count(duration_s, output_step_s);
  if (rows > scenario::kMostRows)
    throw ScenarioError("/motion/output_step_s",
                        fmt::format("about {} output rows; at most {:.0f} are allowed",
                                    told_apart(rows, scenario::kMostRows, 3).first, scenario::kMostRows));
  std::vector<double> times = {0.0};
  for (std::int64_t k = 1;; ++k) {
    const double t = static_cast<double>(k) * output_step_s;
    if (!(duration_s - t > 1e-9 * output_step_s)) break;
    times.push_back(t);
  }
  times.push_back(duration_s);
  return times;
}

}  // namespace earthtop
