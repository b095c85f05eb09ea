// SPDX-License-Identifier: GPL-3.0-or-later
/// `--set /json/pointer=VALUE`: values put into the tree before it is validated.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "input/findings.hpp"
#include "input/node.hpp"

namespace earthtop::input {

/// Replaces or adds values in order, creating missing objects on the way. A value that is not JSON is a string. Finds
/// malformed pointers, pointers that lead through what is no container, and values out of a double's range.
void apply_overrides(Node& root, const std::vector<std::pair<std::string, std::string>>& overrides, Findings& findings);

}  // namespace earthtop::input
