// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a scenario, runs it for a tenth of a second and prints the drift.
#include <cstdio>
#include <earthtop/run.hpp>
#include <earthtop/scene/scene.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto scenario = earthtop::parse_scenario(earthtop::read_scenario_source(argv[1]),
                                                 {{"/motion/duration_s", "0.1"}, {"/motion/output_step_s", "0.01"}});
  const earthtop::RunResult result = earthtop::run(scenario);
  std::printf("%s: %zu rows, drift %.3g rad\n", scenario.name.c_str(), result.rows.size(), result.drift.axis_final_rad);
  // Eleven rows at 0, 0.01, ..., 0.1. The Earth's rotation makes a drift, which is small after a tenth of a second.
  const bool plausible = result.status == earthtop::RunStatus::completed && result.rows.size() == 11 &&
                         result.drift.axis_final_rad > 0 && result.drift.axis_final_rad < 1e-3;
  return plausible ? 0 : 1;
}
