// SPDX-License-Identifier: GPL-3.0-or-later
/// Text that XML can hold.
#pragma once

#include <string>
#include <string_view>

namespace earthtop {

/// Escapes markup; what is not a character of XML (control characters, bytes that are not UTF-8) becomes U+FFFD.
std::string escape_xml(std::string_view text);

/// At most `count` characters of UTF-8 text, the last one an ellipsis where something was left out.
std::string shorten(std::string_view text, std::size_t count);

/// How many characters UTF-8 text has.
std::size_t character_count(std::string_view text);

}  // namespace earthtop
