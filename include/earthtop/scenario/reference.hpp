// SPDX-License-Identifier: GPL-3.0-or-later
/// Descriptions of the scenario format for editors, manuals and shells, generated from the same field table as the decoder's.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// Returns the JSON Schema (draft 7) of a scenario. Some errors cannot be expressed in it (an inertia that no body has, too
/// many rows, a steady precession that does not exist, duplicate keys ...); only `examine_scenario` finds these.
std::string scenario_schema();

/// Returns a Markdown table of every key with its unit, range, default and meaning.
std::string scenario_reference_markdown();

/// Returns a scenario with every key that applies, defaults filled in, and a comment at each key with its meaning and its
/// allowed values. Purpose, headline, criteria and the author's own comments are left out: they describe the original only.
/// @throws ScenarioError for a text that is not a valid scenario
std::string annotated_scenario(const ScenarioSource& source);

/// Returns what to do about a name that is no key of a scenario: which one was probably meant, or what there is instead. Empty if
/// nothing is known.
std::string advice_on_key(const std::string& name);

/// Returns the JSON pointers of all single values, for `--set`; list elements have index 0.
std::vector<std::string> scenario_pointers();

/// Returns the JSON pointer of the key that a user names: "/site/latitude_deg", "site/latitude_deg", "site.latitude_deg", or the bare
/// name of a key that only one section has; "mass_kg", which a rotor has, too, is the body's. A pointer is not examined.
/// @throws ScenarioError for a bare name that no section has, or several have
std::string scenario_pointer(std::string_view key);

}  // namespace earthtop
