// SPDX-License-Identifier: GPL-3.0-or-later
/// Lines, cells and numbers of CSV text.
#pragma once

#include <string_view>
#include <vector>

namespace earthtop::input {

/// Takes the first line off the front of a text. @returns it without its end, LF or CRLF
std::string_view take_line(std::string_view& text);

/// The cells of a line as they stand there, spaces included; an empty line has one, which is empty.
void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells);

/// A cell read as a number from its first character to its last.
struct CellNumber {
  bool is_number = false;      ///< "nan" and "inf" are numbers here
  bool fits_a_double = false;  ///< not for 1e999, and not for 1e-400
  double value = 0;            ///< where it fits
};
CellNumber cell_number(std::string_view cell);

}  // namespace earthtop::input
