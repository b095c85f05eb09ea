// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs many scenarios at once, for studies.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop {

/// The outcome of one scenario of a batch: a result, or the reason why there is none.
struct BatchOutcome {
  std::optional<RunResult> result;
  std::string refusal;  ///< message of the ScenarioError, if there is no result
};

/// Runs many scenes and returns their outcomes in the same order. Each outcome depends on its scene alone, not on the other
/// scenes of the batch. If the watch asks to stop, the unfinished outcomes have RunStatus::interrupted.
/// @param between  as in RunOptions   @throws ArithmeticError as `run` does
std::vector<BatchOutcome> run_batch(std::span<const Scene> scenes, const Watch& watch = {}, bool between = true);

}  // namespace earthtop
