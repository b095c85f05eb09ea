// SPDX-License-Identifier: GPL-3.0-or-later
/// Many scenarios at once, for studies.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop {

/// What came of one scenario of a batch.
struct BatchOutcome {
  std::optional<RunResult> result;
  std::string refusal;  ///< why there is none: what the ScenarioError said
};

/// Runs scenarios; the outcome of each depends on it alone, not on its neighbours or on how many there are. An interrupt
/// (of the watch) leaves outcomes with RunStatus::interrupted.
/// @throws ArithmeticError as `run` does.
std::vector<BatchOutcome> run_batch(std::span<const Scenario> scenarios, const Watch& watch = {});

}  // namespace earthtop
