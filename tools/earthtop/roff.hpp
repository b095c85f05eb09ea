// SPDX-License-Identifier: GPL-3.0-or-later
/// Escapes text for roff.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::tool {

/// Text that a user types, character for character: hyphens become minus signs, quotes upright ones.
std::string roff_literal(std::string_view text);

/// Sentences, one per line. A word that begins with a hyphen is an option, and therefore literal.
std::string roff_text(std::string_view text);

}  // namespace earthtop::tool
