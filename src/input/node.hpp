// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON text as a tree. Every node knows its place in the text, so that error messages can point to it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop::input {

/// The kind of a JSON value. `refused` marks an invalid number (1e999, NaN), which has been reported already.
enum class JsonKind { null, boolean, number, string, array, object, refused };

/// The place of a key or a value: its byte offset in the file, or the mark that it comes from --set.
struct Place {
  std::size_t offset = 0;
  bool from_set = false;
};

struct Node {
  JsonKind kind = JsonKind::null;
  Place place;
  bool boolean = false;
  double number = 0;
  std::string text;
  std::string key;  ///< key of the node in its object, if it is a member of one
  Place key_place;
  std::vector<Node> children;  ///< elements of an array, members of an object
  bool refused = false;        ///< an error has been reported: later rules skip the node

  const Node* find(std::string_view name) const {
    for (const Node& child : children)
      if (child.key == name) return &child;
    return nullptr;
  }
  Node* find(std::string_view name) { return const_cast<Node*>(static_cast<const Node*>(this)->find(name)); }
};

/// Returns whether a key is a comment: it begins with `_` or `//`.
inline bool is_comment(std::string_view key) { return key.starts_with('_') || key.starts_with("//"); }

/// Returns the name of a kind for messages: "a number", "an object", ...
std::string_view name_of(JsonKind kind);

/// Returns at most `limit` bytes of a text for messages, cut between UTF-8 characters, with "..." if something was cut.
std::string excerpt(std::string_view text, std::size_t limit = 40);

/// Returns names for messages, separated by commas: excerpts of the first ones, and the number of the others.
std::string listed(const std::vector<std::string>& names);

/// Returns a key as a step of a JSON pointer ("/" in front, ~ and / escaped, cut to a printable length).
std::string pointer_step(std::string_view key);

}  // namespace earthtop::input
