/// The two things a reader needs to know about UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::scenario {

/// Offset of the first byte that is not part of well-formed UTF-8 (overlong forms, surrogates and values over U+10FFFF
/// included), npos if there is none.
std::size_t first_invalid_utf8(std::string_view text);

void append_utf8(char32_t code, std::string& out);

}  // namespace earthtop::scenario
