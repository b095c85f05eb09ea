// SPDX-License-Identifier: GPL-3.0-or-later
/// earthtop-trend-coverage [COUNT [TIMES [MOST_PHASE [FIRST]]]] [--list]
/// Counts over COUNT random tops how often the rate of a run TIMES as long lies within the trend's bound, and how often
/// first-order theory is within its error of the computed rate. Tops that turn by more than MOST_PHASE rad are left out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "trend/trend_tops.hpp"

namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  using namespace earthtop::testing;
  std::array<double, 4> numbers{200, 100, 2e4, 0};
  bool list = false;
  std::size_t given = 0;
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "--list") == 0)
      list = true;
    else if (given < numbers.size())
      numbers[given++] = std::atof(argv[i]);
  int judged_tops = 0, inside = 0, of_theory = 0, applies = 0, theory_holds = 0;
  std::vector<double> errors, bounds, relative_errors, relative_bounds;
  for (auto index = static_cast<std::uint64_t>(numbers[3]); judged_tops < static_cast<int>(numbers[0]); ++index) {
    const auto scenario = random_trend_top(index, numbers[2]);
    if (!scenario) continue;
    const auto judged = judge_trend(*scenario, numbers[1]);
    if (!judged) continue;
    ++judged_tops;
    const double error = judged->error(), bound = *judged->trend.azimuth_rate_bound_95_rad_s;
    const double size = std::abs(judged->true_rate_rad_s);
    const bool holds = error <= bound;
    inside += holds;
    errors.push_back(error), bounds.push_back(bound);
    relative_errors.push_back(error / size), relative_bounds.push_back(bound / size);
    double used = 0;
    if (!judged->theory.name.empty() && judged->theory.computed) {
      ++of_theory;
      used = std::abs(judged->theory.predicted - *judged->theory.computed) /
             (judged->theory.predicted_error + *judged->theory.computed_error);
      if (judged->theory.applies) ++applies, theory_holds += used <= 1;
    }
    if (list)
      fmt::print(
          "{:12} turns {:6.2f} rate {:+.3e} error {:.1e} bound {:.1e} longer run's {:.1e} {} theory {} off {:.1e} stated "
          "{:.1e} uses {:.2g}{}\n",
          scenario->name, judged->trend.turns_seen.value_or(0), judged->true_rate_rad_s, error, bound, judged->true_bound_rad_s,
          holds ? "" : "BEYOND", judged->theory.applies ? "applies" : "does not",
          judged->theory.computed ? std::abs(judged->theory.predicted - *judged->theory.computed) : 0.0,
          judged->theory.predicted_error, used, used > 1 && judged->theory.applies ? " THEORY" : "");
  }
  fmt::print("{} tops: the rate of a run {} times as long is within the bound of {} ({:.1f} %)\n", judged_tops, numbers[1],
             inside, 100.0 * inside / judged_tops);
  fmt::print("median error {:.2e}, median bound {:.2e} rad/s (ratio {:.2f}); relative {:.2e}, {:.2e} (ratio {:.2f})\n",
             median(errors), median(bounds), median(bounds) / median(errors), median(relative_errors), median(relative_bounds),
             median(relative_bounds) / median(relative_errors));
  fmt::print("theory: for {} tops, applies to {}, within its error for {}\n", of_theory, applies, theory_holds);
}
