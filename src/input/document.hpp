// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the JSON documents that the program itself writes, such as summary.json, as strictly as a scenario.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "input/reader.hpp"

namespace earthtop::input {

inline constexpr std::size_t kMostMembers = 10'000;  ///< a document with more members in one of its objects is refused

/// A kind of document, as messages name it.
struct DocumentKind {
  std::string_view noun;                  ///< e.g. "summary"
  std::size_t most_MiB = 16;              ///< larger ones are refused
  std::size_t most_values = kMostValues;  ///< as are those with more values
};

/// Reads a document: one JSON object in UTF-8, perhaps after a byte order mark, and nothing behind it. Limits of depth and size,
/// numbers beyond a double, duplicate keys and NUL bytes are judged as in a scenario; no key is a comment.
/// @param file  name of the file in error messages   @throws ScenarioError with the places of all that is wrong
nlohmann::ordered_json read_document(std::string_view text, const std::string& file, const DocumentKind& kind);

}  // namespace earthtop::input
