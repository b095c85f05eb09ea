// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares the reduced model of a symmetric top (without its spin) with the general model, over those shipped scenarios that
/// are symmetric tops. Prints the cost of each and its distance from the certified reference, as Markdown.
///
/// earthtop-reduced-general [SECONDS [REPETITIONS]]

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "earthtop/bench/bench.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"

namespace {

using namespace earthtop;

Contender contender(ModelForm form, Observer observer) {
  Contender c;
  c.options.method = Method::rkf78;
  c.options.relative_tolerance = 1e-14;
  c.options.form = form;
  c.options.observer = observer;
  return c;
}

void print_row(const Scenario& scenario, const BenchOptions& options) {
  const std::vector<Contender> contenders{contender(ModelForm::reduced, Observer::laboratory),
                                          contender(ModelForm::general, Observer::laboratory),
                                          contender(ModelForm::general, Observer::body)};
  const BenchReport report = bench(scenario, contenders, options);
  const BenchEntry &reduced = report.entries[0], &laboratory = report.entries[1], &body = report.entries[2];
  const auto evaluations = [](const BenchEntry& entry) { return static_cast<double>(entry.counters.evaluations); };
  const auto errors = [](const BenchEntry& entry) {
    return fmt::format("{:.0e}, {:.0e}", entry.errors.drift.value_or(0), entry.errors.attitude.value_or(0));
  };
  fmt::print("| `{}` | {:.2f} | {:.1f}, {:.1f} | {:.1f}, {:.1f} | {} | {} | {} |\n", report.scenario, 1e3 * reduced.seconds,
             laboratory.seconds / reduced.seconds, body.seconds / reduced.seconds,
             evaluations(laboratory) / evaluations(reduced), evaluations(body) / evaluations(reduced), errors(reduced),
             errors(laboratory), errors(body));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const double most_seconds = argc > 1 ? std::atof(argv[1]) : 10;
  BenchOptions options;
  options.repetitions = argc > 2 ? std::atoi(argv[2]) : 5;
  options.checkpoints = 100;
  fmt::print(
      "| both motions and the drift, rkf78 at 1e-14 | reduced, ms | general / reduced, time: laboratory, body | evaluations | "
      "reduced: error of drift, attitude (rad) | general, laboratory | general, body |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  std::vector<std::filesystem::path> files;
  for (const auto& file : std::filesystem::directory_iterator(EARTHTOP_SCENARIOS))
    if (file.path().extension() == ".json") files.push_back(file.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    Scenario scenario = parse_scenario(read_scenario_source(file.string()));
    scenario.duration_s = std::min(scenario.duration_s, most_seconds);
    if (is_reducible(Scene(scenario).model<double>())) print_row(scenario, options);
  }
}
