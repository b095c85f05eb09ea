// SPDX-License-Identifier: GPL-3.0-or-later
/// Overrides `--set /json/pointer=VALUE`: values put into the tree before it is validated.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "input/findings.hpp"
#include "input/node.hpp"

namespace earthtop::input {

/// A value to be put into a tree: a number, or JSON text.
struct TreeChange {
  std::string pointer;
  std::variant<double, std::string> value;
  bool operator==(const TreeChange&) const = default;
};

/// Applies changes in order; messages are those for overrides with the same values, without the name of the option.
void apply_changes(Node& root, const std::vector<TreeChange>& changes, Findings& findings);

/// Replaces or adds values in order and creates missing objects on the way. A value that is not JSON is taken as a string.
/// Reports malformed pointers, pointers that lead through a value that is not an object or array, and values outside a double's
/// range.
void apply_overrides(Node& root, const std::vector<std::pair<std::string, std::string>>& overrides, Findings& findings);

}  // namespace earthtop::input
