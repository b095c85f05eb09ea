// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads JSON text to a tree of nodes with their places, or checks it without keeping a tree.
#pragma once

#include <cstddef>
#include <string_view>

#include "input/findings.hpp"
#include "input/node.hpp"

namespace earthtop::input {

inline constexpr std::size_t kLargestText = std::size_t{16} << 20;  // bytes
inline constexpr int kGreatestDepth = 64;
inline constexpr std::size_t kMostValues = 200'000;  // keeps the tree of a hostile 16 MiB file below 256 MiB

/// The name of a kind of JSON text in messages, and its limits.
struct TextKind {
  std::string_view noun = "scenario";
  std::size_t most_bytes = kLargestText;
  std::size_t most_values = kMostValues;
  std::size_t most_members = kMostValues;  ///< of one object
  bool has_comments = true;  ///< whether members whose keys begin with `_` or `//` are comments, which may share a key
};

enum class ReadOutcome {
  complete,    ///< valid JSON and a complete tree; out-of-range numbers and duplicate keys are findings
  not_finite,  ///< as `complete`, except for literals such as NaN that JSON does not have
  not_json,    ///< a syntax error, where reading stopped
  refused,     ///< NUL bytes, encoding, depth or size: reading stopped
};

/// Reads strict JSON (RFC 8259, UTF-8 without byte order mark). nlohmann::json is not used for this: it loses positions,
/// keeps the last of duplicate keys, stops at NUL bytes, turns 1e-400 into 0 and recurses without limit.
/// @param pointer  JSON pointer of the root   @param from_set  whether the text comes from --set
ReadOutcome read_json(std::string_view text, std::string_view pointer, bool from_set, Node& root, Findings& findings,
                      const TextKind& kind = {});

/// Checks a text as `read_json` does, without keeping its tree: memory is needed for the keys of the objects that are open only.
/// @param outermost  the kind of the outermost value
ReadOutcome check_json(std::string_view text, Findings& findings, const TextKind& kind, JsonKind& outermost);

}  // namespace earthtop::input
