// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the estimated and the actual work of scenes, random ones or from files.
// Usage: earthtop-work-table SCENES [KIND]   |   earthtop-work-table json KIND INDEX   |   earthtop-work-table promise FILE...
// |   earthtop-work-table FILE...
#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "work/work_scenes.hpp"

namespace {

using namespace earthtop;
using namespace earthtop::testing;

/// Steps estimated and taken, and their ratio; the ratio of the evaluations.
std::string cell(const Work& promised, const Work& used) {
  if (used.evaluations == 0) return fmt::format("{:>9.2g}{:>9}{:>6}{:>6}", promised.steps, "-", "-", "-");
  return fmt::format("{:>9.2g}{:>9.2g}{:>6.2f}{:>6.2f}", promised.steps, used.steps, used.steps / promised.steps,
                     used.evaluations / promised.evaluations);
}

void print_line(const std::string& name, const Scenario& scenario, const WorkDone& done) {
  fmt::print("{:28.28} {:14.14}|{}|{}|{}| {:>8.2g}s {:>8.2g}s {:>6.2g} {} {}{}\n", name,
             to_string(Scene(scenario).choice().options.method), cell(done.promised[0], done.used[0]),
             cell(done.promised[1], done.used[1]), cell(done.promised[2], done.used[2]), done.promised_s, done.used_s,
             done.used_s / done.promised_s, to_string(done.status[0]), to_string(done.status[1]),
             done.growth_completed ? "" : " growth-not-completed");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::span arguments(argv, static_cast<std::size_t>(argc));
  const std::string first = argc > 1 ? arguments[1] : "20";
  if (first == "json") {
    for (const WorkKind& kind : work_kinds())
      if (kind.name == arguments[2])
        fmt::print("{}\n", canonical_json(work_scene(kind, static_cast<std::uint64_t>(std::atoi(arguments[3])))));
    return 0;
  }
  if (first == "promise") {
    for (const char* file : arguments.subspan(2)) try {
        const Scenario scenario = parse_scenario(read_scenario_source(file));
        const RunEstimate e = Scene(scenario).estimate();
        fmt::print("{}: {:.2g} + {:.2g} steps, {:.2g} + {:.2g} + {:.2g} evaluations, {}\n", file, e.solution.steps,
                   e.certificate.steps, e.solution.evaluations, e.certificate.evaluations, e.growth.evaluations,
                   about_seconds(e.seconds.all()));
      } catch (const ScenarioError& error) {
        fmt::print("{}: {}\n", file, error.what());
      }
    return 0;
  }
  const int scenes = std::atoi(first.c_str());
  if (scenes > 0) {
    for (const WorkKind& kind : work_kinds()) {
      if (argc > 2 && kind.name.find(arguments[2]) == std::string_view::npos) continue;
      for (int i = 0; i < scenes; ++i) try {
          const Scenario scenario = work_scene(kind, static_cast<std::uint64_t>(i));
          print_line(fmt::format("{} {}", kind.name, i), scenario, work_done(scenario));
        } catch (const ScenarioError& error) {
          fmt::print("{} {}: {}\n", kind.name, i, error.what());
        }
    }
    return 0;
  }
  for (const char* file : arguments.subspan(1)) try {
      const Scenario scenario = parse_scenario(read_scenario_source(file));
      const std::string name = file;
      print_line(name.substr(name.rfind('/') + 1), scenario, work_done(scenario));
    } catch (const ScenarioError& error) {
      fmt::print("{}: {}\n", file, error.what());
    }
}
