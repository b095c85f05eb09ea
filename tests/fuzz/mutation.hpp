// SPDX-License-Identifier: GPL-3.0-or-later
/// Changes of an input that leave it of its kind, so that more than the outermost reader gets to see it. The same seed makes the
/// same change.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>

namespace earthtop::fuzz {

/// Changes one part of an input: of a JSON document a value, member or key; of a CSV table a cell, row or column.
std::string mutated_text(std::string_view input, std::uint32_t seed);
/// Changes the results of a run: members of the summary, cells, rows and columns of the tables. Most keep what belongs together:
/// the number of rows is that of the table, and the checksums are right.
std::string mutated_results(std::string_view input, std::uint32_t seed);
/// Changes an SQLite database: a cell, a fact, a row, a column, its study, or whether it has checksums, which most often fit.
/// Empty where it is no database.
std::string mutated_store(std::string_view input, std::uint32_t seed);
/// Damages a database as disks and kills do, bits, pages and the end of the file, or changes it without making the checksums fit.
std::string damaged_store(std::string_view input, std::uint32_t seed);
/// Changes which words of which document are replaced, and by which texts.
std::string mutated_page_text(std::string_view input, std::uint32_t seed);

// What the changes are made of.

using Random = std::mt19937;

inline std::size_t below(Random& random, std::size_t count) { return count == 0 ? 0 : random() % count; }
inline bool one_in(Random& random, std::size_t count) { return below(random, count) == 0; }
template <class List>
const auto& one_of(Random& random, const List& list) {
  return list[below(random, std::size(list))];
}

/// A JSON document or a CSV table, changed.
std::string changed_text(std::string_view text, Random& random);
/// A cell that few tables have.
std::string odd_cell(Random& random);
/// A text that is hard to put into a page, a terminal or a table.
std::string odd_words(Random& random);

}  // namespace earthtop::fuzz
