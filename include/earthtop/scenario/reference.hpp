// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scenario may say, for editors, manuals and shells: generated from the table of fields that the decoder reads.
#pragma once

#include <string>
#include <vector>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// JSON Schema (draft 7) of a scenario. What it cannot say (an inertia that no body has, too many rows, a steady precession
/// that does not exist, duplicate keys ...) only `examine_scenario` finds.
std::string scenario_schema();

/// Every key with its unit, range, default and meaning, as a Markdown table.
std::string scenario_reference_markdown();

/// A scenario with every key that applies, defaults filled in, and a comment beside each that says what it means and what is
/// allowed. Purpose, headline, criteria and the author's own comments are left out: they are about the
/// original.
/// @throws ScenarioError for a text that is no valid scenario
std::string annotated_scenario(const ScenarioSource& source);

/// JSON pointers of all single values, for `--set`; a list's elements by index 0.
std::vector<std::string> scenario_pointers();

}  // namespace earthtop
