// SPDX-License-Identifier: GPL-3.0-or-later
/// earthtop-trend-coverage [COUNT [TIMES [SECONDS [FIRST]]]] [--list]
/// Counts over COUNT random tops of each kind how often the rate of a run TIMES as long lies within the trend's bound, and how often
/// first-order theory is within its error of the computed rate. Tops whose longer run is estimated to take more than SECONDS are left
/// out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "trend/trend_tops.hpp"

namespace {

using namespace earthtop::testing;

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// The counts over the tops of a kind.
struct Counted {
  std::string kind;
  int tops = 0, inside = 0, inside_both = 0, longer_knows_less = 0;
  std::vector<double> errors, bounds;  ///< relative to the rate
  void add(const TrendJudged& judged) {
    const double error = judged.error(), bound = *judged.trend.azimuth_rate_bound_95_rad_s;
    ++tops;
    inside += error <= bound;
    inside_both += error <= bound + judged.true_bound_rad_s;
    longer_knows_less += judged.true_bound_rad_s > bound;
    errors.push_back(error / std::abs(judged.true_rate_rad_s)), bounds.push_back(bound / std::abs(judged.true_rate_rad_s));
  }
  void print() const {
    fmt::print("{:10} {:5} {:8.1f} % {:8.1f} % {:9.1e} {:9.1e} {:7.1f} {:10}\n", kind, tops, 100.0 * inside / tops,
               100.0 * inside_both / tops, median(errors), median(bounds), median(bounds) / median(errors), longer_knows_less);
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::array<double, 4> numbers{20, 100, 1, 0};
  bool list = false;
  std::size_t given = 0;
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "--list") == 0)
      list = true;
    else if (given < numbers.size())
      numbers[given++] = std::atof(argv[i]);
  std::vector<Counted> counted(kTrendKinds.size());
  Counted all;
  all.kind = "all";
  int of_theory = 0, applies = 0, theory_holds = 0;
  const int asked = static_cast<int>(numbers[0]);
  for (auto index = static_cast<std::uint64_t>(numbers[3]); all.tops < asked * static_cast<int>(counted.size()); ++index) {
    Counted& kind = counted[index % counted.size()];
    kind.kind = kTrendKinds[index % counted.size()];
    if (kind.tops == asked) continue;
    const auto scenario = random_trend_top(index, numbers[1], numbers[2]);
    if (!scenario) continue;
    const auto judged = judge_trend(*scenario, numbers[1]);
    if (!judged) continue;
    kind.add(*judged), all.add(*judged);
    double used = 0;
    if (!judged->theory.name.empty() && judged->theory.computed) {
      ++of_theory;
      used = std::abs(judged->theory.predicted - *judged->theory.computed) /
             (judged->theory.predicted_error + *judged->theory.computed_error);
      if (judged->theory.applies) ++applies, theory_holds += used <= 1;
    }
    if (!list) continue;
    const double error = judged->error(), bound = *judged->trend.azimuth_rate_bound_95_rad_s;
    fmt::print("{:16} turns {:7.2f} rate {:+.3e} error {:.1e} bound {:.1e} longer run's {:.1e}{} theory {} uses {:.2g}{}\n",
               scenario->name, judged->trend.turns_seen.value_or(0), judged->true_rate_rad_s, error, bound,
               judged->true_bound_rad_s, error <= bound ? "" : " BEYOND", judged->theory.applies ? "applies" : "does not", used,
               used > 1 && judged->theory.applies ? " THEORY" : "");
    std::fflush(stdout);
  }
  fmt::print("{:10} {:>5} {:>10} {:>10} {:>9} {:>9} {:>7} {:>10}\n", "kind", "tops", "inside", "both", "error", "bound",
             "ratio", "less known");
  for (const Counted& kind : counted) kind.print();
  all.print();
  fmt::print("theory: for {} tops, applies to {}, within its error for {}\n", of_theory, applies, theory_holds);
}
