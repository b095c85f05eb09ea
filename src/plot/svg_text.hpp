// SPDX-License-Identifier: GPL-3.0-or-later
/// Text in a form that XML allows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace earthtop {

/// Escapes markup. Bytes that are not UTF-8 become U+FFFD, invisible characters (is_unseen) visible escapes such as \u200b.
std::string escape_xml(std::string_view text);

/// At most `count` characters of a UTF-8 text; if it was cut, the last one is an ellipsis.
std::string shorten(std::string_view text, std::size_t count);

/// A text in at most `most` lines of at most `count` characters, broken at spaces, or, where a line has none, after one of "_./";
/// what is left over is cut as by `shorten`.
std::vector<std::string> lines_of(std::string_view text, std::size_t count, std::size_t most);

/// Number of characters of a UTF-8 text.
std::size_t character_count(std::string_view text);

}  // namespace earthtop
