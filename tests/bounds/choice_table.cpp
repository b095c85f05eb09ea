// SPDX-License-Identifier: GPL-3.0-or-later
/// earthtop-effect-choice [COUNT [LEAST_PHASE LARGEST_PHASE]] [--scenes]
/// For COUNT random scenes in each stratum (16 by default), compares the drift with effects "auto" to the drift with all
/// effects on: the difference against the accuracy asked for, and the cost. Prints a Markdown table by accuracy.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <exception>
#include <map>
#include <vector>

#include "bounds/strata.hpp"
#include "earthtop/frames/earth_orientation.hpp"
#include "earthtop/run.hpp"

namespace {

using namespace earthtop;
using namespace earthtop::testing;

constexpr const char* kStart = "2026-03-20T14:46:00Z";

/// Switches on all effects that need no parameter: the gradient of the normal field, Moon and Sun, the secular pole.
Scenario with_everything(Scenario s) {
  s.start_utc = kStart;
  s.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  s.effects.tide = TideSpec{};
  s.site.pole = secular_pole(julian_epoch_year(*parse_utc(kStart)));
  return s;
}
Scenario with_choice(Scenario s, double accuracy_rad) {
  s.start_utc = kStart;
  s.effects.automatic = true;
  s.accuracy_rad = accuracy_rad;
  return s;
}

struct Timed {
  RunResult result;
  double seconds;
};
Timed timed(const Scenario& scenario) {
  const std::clock_t start = std::clock();
  RunResult result = run(scenario);
  return {std::move(result), static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
}

struct Compared {
  double accuracy, difference, cost_ratio;
  bool reached, reliable;
  std::size_t switched_on;
  std::string name;
};

/// The largest difference over the rows that both runs consider reliable.
double difference_of(const RunResult& a, const RunResult& b) {
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.rows.size(), b.rows.size()); ++i)
    if (a.rows[i].drift_reliable && b.rows[i].drift_reliable)
      largest = std::max(largest, std::abs(a.rows[i].drift_axis_rad - b.rows[i].drift_axis_rad));
  return largest;
}

Compared compare(const Scenario& scenario, double accuracy_rad) {
  const Timed chosen = timed(with_choice(scenario, accuracy_rad)), full = timed(with_everything(scenario));
  return {accuracy_rad,
          difference_of(chosen.result, full.result),
          chosen.seconds / full.seconds,
          chosen.result.accuracy->reached(),
          full.result.verdict.verdict == Verdict::reliable,
          chosen.result.selection->switched_on.size(),
          scenario.name};
}

double median(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void print_row(const std::string& name, const std::vector<Compared>& scenes) {
  std::vector<double> ratios;
  int within = 0, reached = 0, choosing = 0, reliable = 0;
  double worst = 0;
  for (const Compared& c : scenes) {
    within += c.difference <= c.accuracy;
    reached += c.reached;
    choosing += c.switched_on > 0;
    reliable += c.reliable;
    worst = std::max(worst, c.difference / c.accuracy);
    ratios.push_back(c.cost_ratio);
  }
  fmt::print("| {} | {} | {} | {} | {} | {} | {:.2g} | {:.3f} |\n", name, scenes.size(), reliable, within, reached, choosing,
             worst, median(ratios));
}

}  // namespace

int main(int argc, char** argv) {
  bool list = false;
  std::vector<double> numbers;
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "--scenes") == 0)
      list = true;
    else
      numbers.push_back(std::atof(argv[i]));
  numbers.resize(3);
  const auto count = static_cast<std::uint64_t>(numbers[0] > 0 ? numbers[0] : 15);
  const double least = numbers[1] > 0 ? numbers[1] : 3e3, largest = numbers[2] > 0 ? numbers[2] : 1e5;
  std::map<int, std::vector<Compared>> by_decade;
  std::vector<Compared> all;
  int failed = 0;
  for (const Stratum& stratum : strata()) {
    if (stratum.name == "long horizon" || stratum.name == "in long double" || stratum.own_effects)
      continue;  // their method, precision or effects are their point
    for (std::uint64_t index = 0; index < count; ++index) {
      const Scenario scenario = random_scene_of(stratum, 5000 + index, least, largest);
      Random random(index * 77 + static_cast<std::uint64_t>(&stratum - strata().data()));
      const double accuracy = random.log_uniform(1e-8, 1e-4);
      try {
        const Compared c = compare(scenario, accuracy);
        by_decade[static_cast<int>(std::floor(std::log10(accuracy) / 2)) * 2].push_back(c);
        all.push_back(c);
        if (list || !(c.difference <= c.accuracy))
          fmt::print(stderr, "{} ({}): accuracy {:.1e}, difference {:.1e}, cost {:.3f}, on {}{}{}\n", c.name, stratum.name,
                     c.accuracy, c.difference, c.cost_ratio, c.switched_on, c.reached ? "" : ", not reached",
                     c.reliable ? "" : ", not reliable");
      } catch (const std::exception& error) {
        ++failed;
        fmt::print(stderr, "{} ({}): {}\n", scenario.name, stratum.name, error.what());
      }
    }
  }
  fmt::print(
      "| accuracy asked (rad) | scenes | reliable | within it | bound within it | effects switched on in | largest difference "
      "/ "
      "accuracy | median cost / everything on |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const auto& [decade, scenes] : by_decade) print_row(fmt::format("1e{} to 1e{}", decade, decade + 2), scenes);
  print_row("all", all);
  if (failed > 0) fmt::print("{} scenes could not be run\n", failed);
  return 0;
}
