// SPDX-License-Identifier: GPL-3.0-or-later
/// Text as roff takes it.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::tool {

/// What a user types, character for character: every hyphen is a minus sign, every quote an upright one.
std::string roff_literal(std::string_view text);

/// Sentences: a line each. A word that begins with a hyphen is an option, and literal.
std::string roff_text(std::string_view text);

}  // namespace earthtop::tool
