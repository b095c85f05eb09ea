// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats the result of a run for a terminal.
#pragma once

#include <string>

namespace earthtop {
struct RunResult;
}

namespace earthtop::tool {

struct Screen;

/// @param directory where the result files are
/// @param changed the scenario differs from its file, so that a headline figure that is not met says nothing about the program
std::string summary_text(const RunResult& result, const std::string& directory, bool changed, const Screen& screen);

}  // namespace earthtop::tool
