// SPDX-License-Identifier: GPL-3.0-or-later
/// Many scenes at once, for studies.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop {

/// What came of one scene of a batch.
struct BatchOutcome {
  std::optional<RunResult> result;
  std::string refusal;  ///< why there is none: what the ScenarioError said
};

/// Runs scenes; the outcome of each depends on it alone, not on its neighbours or on how many there are. An interrupt
/// (of the watch) leaves outcomes with RunStatus::interrupted.
/// @throws ArithmeticError as `run` does.
std::vector<BatchOutcome> run_batch(std::span<const Scene> scenes, const Watch& watch = {});

}  // namespace earthtop
