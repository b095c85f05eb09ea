// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading and writing of UTF-8 for readers of files and for messages.
#pragma once

#include <string>
#include <string_view>

namespace earthtop {

/// The first character of a text, if it is well-formed: its code point and its length in bytes. Length 0 if there is none: at
/// the end, and at a byte that is not part of well-formed UTF-8 (overlong forms, surrogates and values over U+10FFFF included).
struct Utf8Character {
  char32_t code = 0;
  std::size_t length = 0;
};
Utf8Character first_character(std::string_view text);

/// Offset of the first byte that is not part of well-formed UTF-8, npos if there is none.
std::size_t first_invalid_utf8(std::string_view text);

void append_utf8(char32_t code, std::string& out);

/// Whether a character is invisible, or changes how its neighbours are displayed, so that a text that contains it is not what
/// it looks like: control characters (C0, DEL, C1), line and paragraph separators, marks of writing direction, characters
/// without width (Unicode's "default ignorable" characters: soft hyphen, zero-width space and joiners, byte order mark,
/// fillers, variation selectors, tags), annotation marks, and code points that are not characters.
bool is_unseen(char32_t code);

/// Appends the visible form of such a character: \u200b; above U+FFFF two surrogates, as JSON writes it. Within a JSON string
/// it is read back as the original character.
void append_escape(char32_t code, std::string& out);

/// A JSON document in which invisible characters are written as escapes: another spelling of the same document.
std::string json_with_escapes(std::string_view document);

}  // namespace earthtop
