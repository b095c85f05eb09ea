// SPDX-License-Identifier: GPL-3.0-or-later
/// The scenario that a command names: a file, standard input, or one that comes with the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "earthtop/scenario/scenario.hpp"
#include "examples.hpp"

namespace earthtop::tool {

/// The help says this of such an operand.
inline constexpr std::string_view kScenarioOperand =
    "scenario file (JSON), or the name of a scenario that comes with the program; - is standard input";

inline constexpr std::string_view kScenarioOperands =
    "scenario files (JSON), or names of scenarios that come with the program; - is standard input";

std::vector<std::string> example_names();

/// @throws ScenarioError where no such scenario comes with the program; it says which are meant, or all there are
const Example& find_example(std::string_view name);

/// A scenario or a study that comes with the program, as if it had been read from its file.
ScenarioSource source_of(const Example& example);

/// Reads a scenario file, or standard input for "-". A name that is no file may be that of a scenario which comes with the program.
/// @throws as read_scenario_source
ScenarioSource scenario_of(const std::string& operand);

}  // namespace earthtop::tool
