// SPDX-License-Identifier: GPL-3.0-or-later
/// Splits CSV text into lines and cells, and reads numbers from cells.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

namespace earthtop::input {

/// Removes the first line from a text. @returns the line without its end, LF or CRLF
std::string_view take_line(std::string_view& text);

/// Splits a line into its cells, spaces included; an empty line has one empty cell.
/// @param most  the cells after this many are left out
void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells,
                 std::size_t most = std::numeric_limits<std::size_t>::max());

/// The result of reading a whole cell as a number.
struct CellNumber {
  bool is_number = false;      ///< "nan" and "inf" are numbers here
  bool fits_a_double = false;  ///< false for numbers such as 1e999 and 1e-400
  double value = 0;            ///< the number, if it fits a double
};
CellNumber cell_number(std::string_view cell);

}  // namespace earthtop::input
