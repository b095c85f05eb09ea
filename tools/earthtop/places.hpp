// SPDX-License-Identifier: GPL-3.0-or-later
/// Keeps the files that a command writes apart from those that it reads.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace earthtop::tool {

/// The place that a path leads to, links followed.
std::string place_of(const std::string& path);

/// Checks that no output is an input, or in a directory that is one. Empty names, and - among the inputs, are passed over.
/// @param what  is said of such an output, e.g. "is one of the inputs"   @throws ScenarioError
void require_apart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs, std::string_view what);

}  // namespace earthtop::tool
