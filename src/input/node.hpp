// SPDX-License-Identifier: GPL-3.0-or-later
/// A JSON text as a tree whose every node knows where it stands, so that a complaint can point at it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop::input {

/// `refused` stands where the text had a number that is none (1e999, NaN): it has been complained about already.
enum class JsonKind { null, boolean, number, string, array, object, refused };

/// The place at which a key or a value stands: byte offset in the file, or "not in the file, but from --set".
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
  std::string key;  ///< of a member of an object
  Place key_place;
  std::vector<Node> children;  ///< elements of an array, members of an object
  bool refused = false;        ///< complained about: later rules pass it over

  const Node* find(std::string_view name) const {
    for (const Node& child : children)
      if (child.key == name) return &child;
    return nullptr;
  }
  Node* find(std::string_view name) { return const_cast<Node*>(static_cast<const Node*>(this)->find(name)); }
};

/// Keys that begin with `_` or `//` are comments.
inline bool is_comment(std::string_view key) { return key.starts_with('_') || key.starts_with("//"); }

/// "a number", "an object", ...: for messages.
std::string_view name_of(JsonKind kind);

/// At most `limit` bytes of a text, cut between UTF-8 characters, with "..." where something was cut: for messages.
std::string excerpt(std::string_view text, std::size_t limit = 40);

/// A key as one more step of a JSON pointer ("/" in front, ~ and / escaped, cut to a printable length).
std::string pointer_step(std::string_view key);

}  // namespace earthtop::input
