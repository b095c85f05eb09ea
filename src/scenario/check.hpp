/// The structure of a scenario held against the table of fields: unknown keys, types, ranges, words.
#pragma once

#include <string_view>

#include "scenario/findings.hpp"
#include "scenario/node.hpp"

namespace earthtop::scenario {

/// Marks every node with a finding as refused, so that later rules pass it over.
/// @param pattern  of the root: empty for a scenario, `kStudy` for a study
void check_structure(Node& root, Findings& findings, std::string_view pattern = "");

/// Whether a text may be a scenario's name: [a-z0-9][a-z0-9-]{0,63}.
bool is_scenario_name(std::string_view text);

}  // namespace earthtop::scenario
