/// What readers and messages need to know about UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace earthtop {

/// Takes one well-formed character off the front of a text: its code point and its length in bytes. Length 0 where there is
/// none: at the end, and at a byte that is not part of well-formed UTF-8 (overlong forms, surrogates and values over
/// U+10FFFF included).
struct Utf8Character {
  char32_t code = 0;
  std::size_t length = 0;
};
Utf8Character first_character(std::string_view text);

/// Offset of the first byte that is not part of well-formed UTF-8, npos if there is none.
std::size_t first_invalid_utf8(std::string_view text);

void append_utf8(char32_t code, std::string& out);

}  // namespace earthtop
