/// A run's result as a page for people.
#pragma once

#include <string>

#include "earthtop/run.hpp"

namespace earthtop::tool {

/// @param directory  where the result files are   @param color  with terminal colours
std::string summary_text(const RunResult& result, const std::string& directory, bool color);

}  // namespace earthtop::tool
