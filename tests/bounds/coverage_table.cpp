// SPDX-License-Identifier: GPL-3.0-or-later
/// earthtop-bound-coverage [COUNT [LEAST_PHASE LARGEST_PHASE]] [--by-hand] [--scenes] [random-STRATUM-INDEX]
/// Counts how often the true error is below the stated bound, over COUNT random scenes in each stratum (46 by default), and
/// prints a Markdown table by stratum. --by-hand: the scenes' method, tolerance, observer and form are chosen at random among
/// those a user may name, and the table is by method. --scenes: lists every scene first. random-STRATUM-INDEX: only this scene.
/// A scene whose error exceeds its bound is printed with all its input.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>

#include "bounds/coverage.hpp"
#include "bounds/strata.hpp"

namespace {

using namespace earthtop;
using namespace earthtop::testing;

struct Row {
  int scenes = 0, reliable = 0, reliable_beyond = 0, beyond = 0, beyond_three = 0, tight = 0;
  double worst = 0;
  std::vector<double> drift_ratios, state_ratios;  ///< bound divided by error
};

void include(const Coverage& coverage, Row& row) {
  ++row.scenes;
  const bool reliable = coverage.verdict.verdict == Verdict::reliable;
  row.reliable += reliable;
  row.reliable_beyond += reliable && !(coverage.used <= 1);
  row.beyond += !(coverage.used <= 1);
  row.beyond_three += !(coverage.used <= 3);
  row.tight += coverage.tight();
  row.worst = std::max(row.worst, coverage.used);
  const auto ratio = [](const BoundedError& e, std::vector<double>& ratios) {
    if (e.error > 0) ratios.push_back(e.bound / e.error);
  };
  ratio(coverage.attitude, row.drift_ratios), ratio(coverage.states, row.state_ratios);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void print(std::string_view name, const Row& row) {
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.2g} | {:.2g}, {:.2g} |\n", name, row.scenes, row.reliable,
             row.reliable_beyond, row.beyond, row.beyond_three, row.tight, row.worst, median(row.drift_ratios),
             median(row.state_ratios));
}

void print_scene(std::string_view stratum, const Scenario& scenario, const Coverage& c) {
  fmt::print(
      "{:24} {:14} {:13} {:7.1e} {:11} {:9.3g} drift {:.2e} axis {:.1e} of {:.1e}, attitude {:.1e} of {:.1e}, attitudes "
      "themselves {:.1e} of {:.1e}, used {:.2g}{}\n",
      stratum, scenario.name, to_string(c.method), scenario.numerics.relative_tolerance, to_string(c.verdict.verdict),
      Scene(scenario).fastest_rate_rad_s() * scenario.duration_s, c.drift, c.axis.error, c.axis.bound, c.attitude.error,
      c.attitude.bound, c.states.error, c.states.bound, c.used, c.tight() ? "" : " LOOSE");
}

}  // namespace

int main(int argc, char** argv) {
  bool scenes = false, by_hand = false;
  std::string only;
  std::vector<double> numbers;
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "random-", 7) == 0 || std::strncmp(argv[i], "by-hand-", 8) == 0)
      only = argv[i];
    else if (std::strcmp(argv[i], "--scenes") == 0)
      scenes = true;
    else if (std::strcmp(argv[i], "--by-hand") == 0)
      by_hand = true;
    else
      numbers.push_back(std::atof(argv[i]));
  }
  const auto count = static_cast<std::uint64_t>(numbers.empty() ? 46 : numbers[0]);
  const double least = numbers.size() > 2 ? numbers[1] : 3, largest = numbers.size() > 2 ? numbers[2] : 1500;
  std::vector<std::pair<std::string, Row>> table;
  std::map<std::string, int> verdicts, methods;
  Row all;
  int failed = 0;
  for (const Stratum& stratum : strata()) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const bool long_run = !by_hand && stratum.name == "long horizon";
      const auto make = by_hand ? random_scene_by_hand : random_scene_of;
      const Scenario scenario = make(stratum, i, long_run ? 2e4 : least, long_run ? 1e6 : largest);
      if (!only.empty() && scenario.name != only) continue;
      const std::string name(by_hand ? to_string(scenario.numerics.method) : stratum.name);
      auto row = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.first == name; });
      if (row == table.end()) row = table.insert(row, {name, {}});
      try {
        const Coverage c = bound_coverage(scenario, by_hand ? Truth::bits64 : Truth::bits113);
        include(c, row->second);
        include(c, all);
        ++verdicts[std::string(to_string(c.verdict.verdict))];
        ++methods[std::string(to_string(c.method))];
        if (scenes || !(c.used <= 1)) print_scene(stratum.name, scenario, c);
        if (!(c.used <= 1)) fmt::print("beyond its bound: {}\n", canonical_json(scenario));
      } catch (const std::exception& error) {
        ++failed;
        fmt::print(stderr, "{}: {}\n", scenario.name, error.what());
      }
    }
  }
  fmt::print(
      "| {} | scenes | reliable | of these beyond the bound | all beyond | beyond 3 times | not loose | largest error / bound "
      "| "
      "median bound / error: drift, attitudes |\n",
      by_hand ? "method" : "stratum");
  fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const auto& [name, row] : table) print(name, row);
  print("all", all);
  fmt::print("\nverdicts:");
  for (const auto& [verdict, number] : verdicts) fmt::print(" {} {}", verdict, number);
  fmt::print("\nmethods:");
  for (const auto& [method, number] : methods) fmt::print(" {} {}", method, number);
  fmt::print("\nnot completed: {}\n", failed);
}
