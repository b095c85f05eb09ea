// SPDX-License-Identifier: GPL-3.0-or-later
/// Wall time of `run` on shipped scenarios at default settings, with both predictions, the drift and its bound.

#include <benchmark/benchmark.h>

#include <string>

#include "earthtop/run.hpp"

namespace {

void run_scenario(benchmark::State& state, const char* name) {
  const earthtop::Scenario scenario =
      earthtop::parse_scenario(earthtop::read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + name + ".json"));
  double evaluations = 0;
  for (auto _ : state) {
    const earthtop::RunResult result = earthtop::run(scenario);
    evaluations = static_cast<double>(result.solution.counters.evaluations + result.certificate.counters.evaluations);
    benchmark::DoNotOptimize(result.drift.axis_final_rad);
  }
  state.counters["rhs_evaluations"] = evaluations;
}

BENCHMARK_CAPTURE(run_scenario, toy_top, "toy-top")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_scenario, free_gyro, "free-gyro")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_scenario, asymmetric_top, "asymmetric-top")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_scenario, turntable, "turntable")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
