// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the findings of a comparison in sentences: the same in the terminal, in the document and on the page.
#pragma once

#include <string>
#include <string_view>

#include "earthtop/compare/compare.hpp"

namespace earthtop::compare {

/// A quantity in words: what the table of the rows' quantities says of it, or the path of a figure of the summary without its
/// underscores and its unit.
std::string in_words(std::string_view quantity);

/// How many quantities failed and which one most, and what else is wrong.
std::string conclusion_of(const PairReport& pair);

/// How the changed numbers compare with their error bounds, if they have any, and whether there are other differences, to which
/// no bound applies: a key, a word, a missing value, the scenario, the cost.
std::string changes_of(const CompareReport& report);

}  // namespace earthtop::compare
