// SPDX-License-Identifier: GPL-3.0-or-later
#include "wrapped.hpp"

#include <algorithm>
#include <cctype>

namespace earthtop::tool {
namespace {

bool is_quantity(std::string_view word) {
  return word.find_first_of("0123456789") != std::string_view::npos &&
         word.find_first_not_of("0123456789.,e+-") == std::string_view::npos;
}

/// Whether a unit goes on after its first factor: N m, kg m².
bool goes_on_with(std::string_view factor, std::string_view rest) {
  return (factor == "N" || factor == "kg") && rest.starts_with('m') &&
         (rest.size() == 1 || !std::isalpha(static_cast<unsigned char>(rest[1])));
}

/// The end of what stands at the beginning of a text and is not broken: a word, or a number with its error and its unit.
std::size_t end_of_piece(std::string_view text) {
  constexpr std::string_view kSign = "±";
  std::size_t end = 0;
  for (bool goes_on = true; goes_on;) {
    const std::size_t begin = end == 0 ? 0 : end + 1;
    end = std::min(text.find(' ', begin), text.size());
    const std::string_view word = text.substr(begin, end - begin), rest = text.substr(std::min(end + 1, text.size()));
    goes_on = !rest.empty() && !rest.starts_with(' ') &&
              (word == kSign || is_quantity(word) || rest.starts_with("± ") || goes_on_with(word, rest));
  }
  return end;
}

}  // namespace

std::size_t columns_of(std::string_view text) {
  std::size_t columns = 0;
  bool is_escape = false;
  for (const char c : text) {
    if (c == '\x1b') is_escape = true;
    const bool goes_on = (static_cast<unsigned char>(c) & 0xC0) == 0x80;  // a further byte of a character
    if (!is_escape && !goes_on) ++columns;
    if (c == 'm') is_escape = false;
  }
  return columns;
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t hanging) {
  constexpr std::size_t kRoom = 24, kLittle = 4;
  if (hanging + kRoom > width) hanging = std::min(hanging, kLittle);
  std::string lines;
  std::size_t column = 0;  // at which the line ends so far
  while (text.find_first_not_of(' ') != std::string_view::npos) {
    const std::size_t spaces = text.find_first_not_of(' ');
    const std::string_view piece = text.substr(spaces, end_of_piece(text.substr(spaces)));
    text.remove_prefix(spaces + piece.size());
    const std::size_t columns = columns_of(piece);
    if (!lines.empty() && column + spaces + columns > width) {
      lines += '\n' + std::string(hanging, ' ');
      column = hanging;
    } else {
      lines.append(spaces, ' ');
      column += spaces;
    }
    lines += piece;
    column += columns;
  }
  return lines;
}

std::string wrapped_entry(std::string_view label, std::string_view text, std::size_t width, std::size_t indent) {
  const std::size_t end = columns_of(label);
  if (end >= indent) return std::string(label) + '\n' + wrapped_entry("", text, width, indent);
  return wrapped(std::string(label) + std::string(indent - end, ' ') + std::string(text), width, indent) + '\n';
}

}  // namespace earthtop::tool
