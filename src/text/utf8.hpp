// SPDX-License-Identifier: GPL-3.0-or-later
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

/// Whether a character cannot be seen, or changes how its neighbours are seen, so that a text with it is not what it looks
/// like: controls (C0, DEL, C1), line and paragraph separators, marks of writing direction, what takes no width (Unicode's
/// "default ignorable" characters: soft hyphen, zero-width space and joiners, byte order mark, fillers, variation selectors,
/// tags), annotation marks, and codes that are no characters.
bool is_unseen(char32_t code);

/// Such a character as it is shown: \u200b; above U+FFFF as the two halves that JSON has of it, so that within a JSON string it
/// reads back as what it stands for.
void append_escape(char32_t code, std::string& out);

/// A JSON document in which characters that cannot be seen stand as escapes: another spelling of the same document.
std::string json_with_escapes(std::string_view document);

}  // namespace earthtop
