// SPDX-License-Identifier: GPL-3.0-or-later
/// Breaks prose into lines.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace earthtop::tool {

/// The columns that a text in UTF-8 takes on a terminal; the sequences that set its colours take none.
std::size_t columns_of(std::string_view text);

/// The text in lines of at most `width` columns, without a final line end. It is broken at spaces only, so a longer word makes a
/// longer line; and a number is not parted from its error and its unit. Lines after the first one begin with `hanging` spaces, or with four where that would leave too little room.
std::string wrapped(std::string_view text, std::size_t width, std::size_t hanging = 0);

/// One entry of a list, with a line end: the label, and beside it, from column `indent` on, the text. A label that reaches so far
/// has a line of its own.
std::string wrapped_entry(std::string_view label, std::string_view text, std::size_t width, std::size_t indent);

}  // namespace earthtop::tool
