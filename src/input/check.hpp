// SPDX-License-Identifier: GPL-3.0-or-later
/// The structure of a document held against its table of fields: unknown keys, types, ranges, words.
#pragma once

#include <string_view>

#include "input/fields.hpp"
#include "input/findings.hpp"
#include "input/node.hpp"

namespace earthtop::input {

/// Marks every node with a finding as refused, so that later rules pass it over.
void check_structure(Node& root, Findings& findings, const FieldTable& table);

/// The tree of a file, its structure checked. @param text  loses its byte order mark, if it has one
/// @throws ScenarioError where reading stopped; what else is wrong is in the findings, and the tree is whole
Node read_checked(std::string_view& text, const std::string& file, const FieldTable& table, Findings& findings);

/// Returns whether a text may name a scenario or a study: [a-z0-9][a-z0-9-]{0,63}.
bool is_name(std::string_view text);

}  // namespace earthtop::input
