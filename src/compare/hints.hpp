// SPDX-License-Identifier: GPL-3.0-or-later
/// Guesses at the cause of a large difference: conventions that are often mixed up.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/rows.hpp"

namespace earthtop::compare {

/// One line of text for each mix-up of conventions that explains the differences; empty where none does.
/// @param seen  the first rows of both results, paired by time
std::vector<std::string> hints(std::span<const SeenPair> seen);

}  // namespace earthtop::compare
