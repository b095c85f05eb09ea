// SPDX-License-Identifier: GPL-3.0-or-later
/// Guesses at the cause of a large difference: conventions that are often mixed up.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/rows.hpp"

namespace earthtop::compare {

/// One line for each mix-up that explains the rows, if there is one. @param seen  the first rows of both
std::vector<std::string> hints(std::span<const SeenPair> seen);

}  // namespace earthtop::compare
