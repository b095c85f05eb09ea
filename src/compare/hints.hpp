// SPDX-License-Identifier: GPL-3.0-or-later
/// Guesses at the cause of a large difference from its numbers alone: another unit, an opposite sign, shifted rows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/rows.hpp"

namespace earthtop::compare {

/// One line of text for each guess that explains the differences of a quantity other than those of `diagnose`; empty where none does.
/// @param seen  the first rows of both results, paired by time
std::vector<std::string> hints(std::span<const SeenPair> seen);

}  // namespace earthtop::compare
