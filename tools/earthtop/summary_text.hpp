// SPDX-License-Identifier: GPL-3.0-or-later
/// A run's result as a page for people.
#pragma once

#include <string>

namespace earthtop {
struct RunResult;
}

namespace earthtop::tool {

/// @param directory  where the result files are   @param changed  the scenario is not the file's: a headline figure that is
/// not met says nothing about the program then   @param color  with terminal colours
std::string summary_text(const RunResult& result, const std::string& directory, bool changed, bool color);

}  // namespace earthtop::tool
