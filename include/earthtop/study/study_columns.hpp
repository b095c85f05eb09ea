// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of a study's points by columns, for programs that compute with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "earthtop/watch.hpp"

namespace earthtop {

/// One column of a study's table: a cell holds a number, a word, or nothing. A value that is neither a number nor a word, such as
/// true or a list, is a word: its JSON text.
struct StudyColumn {
  std::string name;
  std::vector<double> numbers;       ///< one a row; NaN in a cell without a number
  std::vector<std::string> words;    ///< the different words of the column, in the order in which they first stand there
  std::vector<std::int32_t> places;  ///< one a row: which of the words the cell holds, -1 for none; empty if there are no words
  bool has_numbers = false;
};

/// The columns of study.csv: point, axes, quantities, status, reason. Numbers have the same bits, and words are as in the store.
/// @param watch may stop the reading
/// @throws ScenarioError if the file is not a store or is damaged; ReadError; Interrupted
std::vector<StudyColumn> study_columns(const std::filesystem::path& store, const Watch& watch = {});

}  // namespace earthtop
