// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/chunk.hpp"

#include <algorithm>
#include <exception>
#include <span>

namespace earthtop::study {
namespace {

/// Rows that results of a batch may have together: some 100 MB.
constexpr double kMostRows = 200'000;

double rows_of(const Scenario& scenario) { return 2 + scenario.duration_s / scenario.output_step_s; }

std::vector<BatchOutcome> run_guarded(std::span<const Scenario> scenarios, const Watch& watch) {
  try {
    return run_batch(scenarios, watch);
  } catch (const std::exception& error) {
    if (scenarios.size() == 1) {
      std::vector<BatchOutcome> outcome(1);
      outcome.front().refusal = error.what();
      return outcome;
    }
  }
  // One of them is to blame: each by itself.
  std::vector<BatchOutcome> outcomes;
  outcomes.reserve(scenarios.size());
  for (const Scenario& scenario : scenarios) outcomes.push_back(std::move(run_guarded({&scenario, 1}, watch).front()));
  return outcomes;
}

}  // namespace

std::vector<PointResult> compute(const Study& study, const Collector& collector, const Chunk& chunk, const Watch& watch) {
  std::vector<PointResult> results;
  results.reserve(chunk.size());
  std::vector<Scenario> scenarios;
  scenarios.reserve(chunk.size());
  std::vector<std::size_t> of_scenario;  // index in `results`
  of_scenario.reserve(chunk.size());
  for (const PlannedPoint& point : chunk) {
    PointResult& result = results.emplace_back();
    result.number = point.number;
    result.values.resize(study.quantities.size());
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      result.axis_values.push_back(axis_value(study.axes[a], point.settings[a]));
    if (watch.asks_to_stop()) {
      result.status = to_string(RunStatus::interrupted);
    } else if (auto scenario = collector.scenario(point_changes(study, point), result.reason)) {
      of_scenario.push_back(results.size() - 1);
      scenarios.push_back(*std::move(scenario));
    } else {
      result.status = "refused";
    }
  }
  Parts parts(watch, static_cast<double>(scenarios.size()));
  for (std::size_t begin = 0; begin < scenarios.size();) {
    std::size_t end = begin + 1;
    for (double rows = rows_of(scenarios[begin]); end < scenarios.size(); ++end)
      if (rows += rows_of(scenarios[end]); rows > kMostRows) break;
    const auto outcomes =
        run_guarded(std::span(scenarios).subspan(begin, end - begin), parts.next(static_cast<double>(end - begin)));
    for (std::size_t i = begin; i < end; ++i) collector.collect(outcomes[i - begin], results[of_scenario[i]]);
    begin = end;
  }
  std::erase_if(results, [](const PointResult& point) { return point.status == to_string(RunStatus::interrupted); });
  return results;
}

}  // namespace earthtop::study
