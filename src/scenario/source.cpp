// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/scenario/scenario.hpp"
#include "input/file.hpp"

namespace earthtop {

ScenarioSource read_scenario_source(const std::string& path) {
  constexpr input::FileUse kScenarioFile = {"scenario file", true};
  if (path == "-") return {"<stdin>", input::read_standard_input(kScenarioFile)};
  return {path, input::read_regular_file(path, path, kScenarioFile)};
}

}  // namespace earthtop
