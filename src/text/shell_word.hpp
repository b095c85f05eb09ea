// SPDX-License-Identifier: GPL-3.0-or-later
/// Words of commands that are copied into a shell.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace earthtop {

/// A text for use within single quotes of a shell.
inline std::string within_quotes(std::string_view text) {
  std::string quoted;
  for (const char letter : text) letter == '\'' ? quoted += R"('\'')" : quoted += letter;
  return quoted;
}

/// A text as one word of a command: as it stands, or in quotes where a shell would change it.
inline std::string shell_word(std::string_view text) {
  constexpr std::string_view kPlain = "_-+=./:,@%";
  const bool is_plain = !text.empty() && std::ranges::all_of(text, [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || kPlain.find(c) != kPlain.npos;
  });
  return is_plain ? std::string(text) : "'" + within_quotes(text) + "'";
}

}  // namespace earthtop
