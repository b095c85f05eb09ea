// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON pointers: their steps, where they lead, and which of them a kind of file can have.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/fields.hpp"
#include "input/node.hpp"

namespace earthtop::input {

/// The reference tokens of a JSON pointer (RFC 6901), nothing where it is malformed.
std::optional<std::vector<std::string>> tokens_of(std::string_view pointer);

/// The index that a token is of an array of this size, nothing where it is none.
std::optional<std::size_t> array_index(std::string_view token, std::size_t size);

/// The answer to a key that an object does not have: which keys are allowed there, and which one was probably meant.
struct UnknownKey {
  std::string message;
  std::optional<std::string_view> meant;  ///< a key of the same object
};
/// @param pattern  of the object
UnknownKey unknown_key(const FieldTable& table, std::string_view key, std::string_view pattern);

/// The field or number that a pointer leads to in a file of the table's kind, whatever the file's other keys are.
struct PointerTarget {
  const Field* field = nullptr;      ///< the last one on the way; elements of a vector, a matrix or a list of numbers have its
  bool is_number = false;            ///< a field that is a number, or one number of a field that has several
  std::optional<std::string> fault;  ///< why there cannot be a value; nothing where there may be one
};
PointerTarget pointer_target(const FieldTable& table, std::string_view pointer);

/// The node that a pointer leads to, null where the tree has none.
const Node* node_at(const Node& root, std::string_view pointer);

}  // namespace earthtop::input
