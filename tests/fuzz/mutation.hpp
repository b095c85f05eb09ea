// SPDX-License-Identifier: GPL-3.0-or-later
/// Changes of an input that leave it of its kind, so that more than the outermost reader gets to see it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace earthtop::fuzz {

/// Changes one part of an input: of a JSON document a value, member or key; of a CSV table a cell, row or column.
std::string mutated_text(std::string_view input, std::uint32_t seed);
/// Changes an SQLite database: a cell, a fact, a row, a column, or whether it has checksums. Empty where it is no database.
std::string mutated_store(std::string_view input, std::uint32_t seed);

}  // namespace earthtop::fuzz
