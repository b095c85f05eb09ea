// SPDX-License-Identifier: GPL-3.0-or-later
/// Differences between two scenarios.
#pragma once

#include <string>
#include <vector>

#include "compare/comparand.hpp"

namespace earthtop::compare {

struct ScenarioChange {
  std::string pointer;
  std::string reference, candidate;  ///< values as JSON; "nothing" where the key is missing
};

/// The differences of two canonical scenarios, except in the keys that do not change the motion (name, title, purpose,
/// headline, criteria).
std::vector<ScenarioChange> scenario_changes(const Json& reference, const Json& candidate);

/// Whether a JSON pointer is one of those in `allowed`, or below one of them; "/" allows all.
bool is_below(const std::string& pointer, const std::vector<std::string>& allowed);

}  // namespace earthtop::compare
