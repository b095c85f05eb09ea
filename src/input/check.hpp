// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks the structure of a document against its table of fields: unknown keys, types, ranges, words.
#pragma once

#include <string_view>

#include "input/fields.hpp"
#include "input/findings.hpp"
#include "input/node.hpp"

namespace earthtop::input {

/// Checks a tree and marks every node with a finding as refused, so that later rules skip it.
void check_structure(Node& root, Findings& findings, const FieldTable& table);

/// Reads the tree of a file and checks its structure. @param text  its byte order mark, if any, is removed
/// @throws ScenarioError where reading stopped; other errors are added to the findings, and the tree is complete
Node read_checked(std::string_view& text, const std::string& file, const FieldTable& table, Findings& findings);

/// Returns whether a text may name a scenario or a study: [a-z0-9][a-z0-9-]{0,63}.
bool is_name(std::string_view text);

}  // namespace earthtop::input
