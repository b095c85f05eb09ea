// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/scenario/inputs.hpp"

#include "earthtop/real.hpp"

namespace earthtop {

bool has_input(const Scenario& scenario, std::size_t input) {
  const InputRow& row = kInputs[input];
  if (row.kind == InputKind::pivot_offset) {
    const auto& platform = scenario.platform;
    return platform && real::hypot(platform->pivot_offset_m[0], platform->pivot_offset_m[1], platform->pivot_offset_m[2]) > 0;
  }
  if (row.kind == InputKind::tilt)  // a level gimbal holds it, and others have angles of their own
    return !scenario.effects.applied.gimbal && !scenario.gimbals;
  if (row.kind != InputKind::number) return true;
  Scenario copy = scenario;  // the rows lead to numbers that may be changed
  return row.number(copy) != nullptr;
}

std::vector<std::size_t> inputs_of(const Scenario& scenario) {
  std::vector<std::size_t> inputs;
  for (std::size_t i = 0; i < kInputCount; ++i)
    if (has_input(scenario, i)) inputs.push_back(i);
  return inputs;
}

}  // namespace earthtop
