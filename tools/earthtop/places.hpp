// SPDX-License-Identifier: GPL-3.0-or-later
/// The files that a command reads with a scenario.
#pragma once

#include <string>
#include <vector>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop::tool {

/// A scenario's own file, and the one that it names.
std::vector<std::string> files_of(const std::string& file, const Scenario& scenario);

}  // namespace earthtop::tool
