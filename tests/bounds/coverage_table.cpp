/// earthtop-bound-coverage [COUNT [LEAST_PHASE LARGEST_PHASE]] [--scenes] [random-STRATUM-INDEX]: over COUNT random scenes in
/// each stratum (46 by default) how often the true error is below the stated bound, as a Markdown table; with --scenes every
/// scene first; or of one scene only.

#include <fmt/format.h>

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
  int scenes = 0, reliable = 0, reliable_beyond = 0, beyond = 0, beyond_three = 0, tight = 0, failed = 0;
  double worst = 0;
  std::string worst_scene;
  void add(const Row& other) {
    scenes += other.scenes, reliable += other.reliable, reliable_beyond += other.reliable_beyond, beyond += other.beyond;
    beyond_three += other.beyond_three, tight += other.tight, failed += other.failed;
    if (other.worst > worst) worst = other.worst, worst_scene = other.worst_scene;
  }
};

void include(const Scenario& scenario, const Coverage& coverage, Row& row) {
  ++row.scenes;
  const bool reliable = coverage.verdict.verdict == Verdict::reliable;
  row.reliable += reliable;
  row.reliable_beyond += reliable && !(coverage.used <= 1);
  row.beyond += !(coverage.used <= 1);
  row.beyond_three += !(coverage.used <= 3);
  row.tight += coverage.tight;
  if (!(coverage.used <= row.worst)) row.worst = coverage.used, row.worst_scene = scenario.name;
}

void print(std::string_view name, const Row& row) {
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.2g} |\n", name, row.scenes, row.reliable, row.reliable_beyond, row.beyond,
             row.beyond_three, row.tight, row.worst);
}

}  // namespace

int main(int argc, char** argv) {
  bool scenes = false;
  std::string only;
  std::vector<double> numbers;
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "random-", 7) == 0)
      only = argv[i];
    else if (std::strcmp(argv[i], "--scenes") == 0)
      scenes = true;
    else
      numbers.push_back(std::atof(argv[i]));
  }
  const auto count = static_cast<std::uint64_t>(numbers.empty() ? 46 : numbers[0]);
  const double least = numbers.size() > 2 ? numbers[1] : 3, largest = numbers.size() > 2 ? numbers[2] : 1500;
  std::vector<std::pair<std::string_view, Row>> table;
  std::map<std::string, int> verdicts, methods;
  Row all;
  for (const Stratum& stratum : strata()) {
    Row row;
    for (std::uint64_t i = 0; i < count; ++i) {
      const bool long_run = stratum.name == "long horizon";
      const Scenario scenario = random_scene_of(stratum, i, long_run ? 2e4 : least, long_run ? 1e6 : largest);
      if (!only.empty() && scenario.name != only) continue;
      try {
        const Coverage c = bound_coverage(scenario);
        include(scenario, c, row);
        ++verdicts[std::string(to_string(c.verdict.verdict))];
        ++methods[std::string(to_string(c.method))];
        if (scenes)
          fmt::print(
              "{:24} {:13} {:12} {:11} {:9.3g} drift {:.2e} axis {:.1e} of {:.1e}, attitude {:.1e} of {:.1e}, used {:.2g}{}\n",
              stratum.name, scenario.name, to_string(c.method), to_string(c.verdict.verdict),
              fastest_rate_rad_s(scenario) * scenario.duration_s, c.drift, c.error, c.bound, c.attitude_error, c.attitude_bound,
              c.used, c.tight ? "" : " LOOSE");
      } catch (const std::exception& error) {
        ++row.failed;
        fmt::print(stderr, "{}: {}\n", scenario.name, error.what());
      }
    }
    all.add(row);
    table.emplace_back(stratum.name, row);
  }
  fmt::print(
      "| stratum | scenes | reliable | of these beyond the bound | all beyond | beyond 3 times | not loose | largest error / "
      "bound |\n");
  fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const auto& [name, row] : table) print(name, row);
  print("all", all);
  fmt::print("\nverdicts:");
  for (const auto& [verdict, number] : verdicts) fmt::print(" {} {}", verdict, number);
  fmt::print("\nmethods:");
  for (const auto& [method, number] : methods) fmt::print(" {} {}", method, number);
  fmt::print("\nnot completed: {}\n", all.failed);
}
