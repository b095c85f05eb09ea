// SPDX-License-Identifier: GPL-3.0-or-later
/// The structure of a scenario held against the table of fields: unknown keys, types, ranges, words.
#pragma once

#include <string_view>

#include "scenario/findings.hpp"
#include "scenario/node.hpp"

namespace earthtop::scenario {

/// Marks every node with a finding as refused, so that later rules pass it over.
/// @param pattern  of the root: empty for a scenario, `kStudy` for a study, ...
void check_structure(Node& root, Findings& findings, std::string_view pattern = "");

/// The tree of a file that is no scenario, its structure checked. @param text  loses its byte order mark, if it has one
/// @throws ScenarioError where reading stopped; what else is wrong is in the findings, and the tree is whole
Node read_checked(std::string_view& text, const std::string& file, std::string_view pattern, Findings& findings);

/// Whether a text may be a scenario's name: [a-z0-9][a-z0-9-]{0,63}.
bool is_scenario_name(std::string_view text);

}  // namespace earthtop::scenario
