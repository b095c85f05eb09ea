// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/csv_text.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

namespace earthtop::input {

std::string_view take_line(std::string_view& text) {
  std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells, std::size_t most) {
  cells.clear();
  for (std::size_t at = 0; at <= line.size() && cells.size() < most;) {
    const auto* end = static_cast<const char*>(std::memchr(line.data() + at, delimiter, line.size() - at));
    const std::size_t stop = end ? static_cast<std::size_t>(end - line.data()) : line.size();
    cells.push_back(line.substr(at, stop - at));
    at = stop + 1;
  }
}

CellNumber cell_number(std::string_view cell) {
  CellNumber number;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number.value);
  number.is_number = end == cell.data() + cell.size() && error != std::errc::invalid_argument;
  number.fits_a_double = number.is_number && error == std::errc();
  return number;
}

}  // namespace earthtop::input
