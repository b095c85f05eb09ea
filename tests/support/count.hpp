// SPDX-License-Identifier: GPL-3.0-or-later
/// Counts words in what the program writes.
#pragma once

#include <cstddef>
#include <string_view>

namespace earthtop::testing {

/// Returns how often a text contains a word.
inline std::size_t count(std::string_view text, std::string_view what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

}  // namespace earthtop::testing
