// SPDX-License-Identifier: GPL-3.0-or-later
/// The figures of a top (scene/top_figures.hpp) as the terminal and the pages show them, and as JSON.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "earthtop/scene/top_figures.hpp"

namespace earthtop {

/// The figures in words, one line each: what it is, and its numbers with their units.
std::vector<std::pair<std::string, std::string>> top_lines(const TopFigures& top);

/// The object `top` of summary.json, as JSON text. @throws ScenarioError where the scene's release does not exist
std::string top_json(const Scene& scene);

}  // namespace earthtop
