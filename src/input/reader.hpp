// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads JSON text to a tree of nodes with their places.
#pragma once

#include <string_view>

#include "input/findings.hpp"
#include "input/node.hpp"

namespace earthtop::input {

inline constexpr std::size_t kLargestText = std::size_t{16} << 20;  // bytes
inline constexpr int kGreatestDepth = 64;
inline constexpr std::size_t kMostValues = 200'000;  // keeps the tree of a hostile 16 MiB file below 256 MiB

enum class ReadOutcome {
  complete,    ///< valid JSON and a complete tree; out-of-range numbers and duplicate keys are findings
  not_finite,  ///< as `complete`, except for literals such as NaN that JSON does not have
  not_json,    ///< a syntax error, where reading stopped
  refused,     ///< NUL bytes, encoding, depth or size: reading stopped
};

/// Reads strict JSON (RFC 8259, UTF-8 without byte order mark). nlohmann::json is not used for this: it loses positions,
/// keeps the last of duplicate keys, stops at NUL bytes, turns 1e-400 into 0 and recurses without limit.
/// @param pointer  JSON pointer of the root   @param from_set  whether the text comes from --set
ReadOutcome read_json(std::string_view text, std::string_view pointer, bool from_set, Node& root, Findings& findings);

}  // namespace earthtop::input
