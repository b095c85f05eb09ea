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

/// Returns the reference tokens of a JSON pointer (RFC 6901); empty if it is malformed.
std::optional<std::vector<std::string>> tokens_of(std::string_view pointer);

/// Returns the index that a token denotes in an array of this size; empty if it denotes none.
std::optional<std::size_t> array_index(std::string_view token, std::size_t size);

/// The answer to a key that an object does not have: which keys are allowed there, and which one was probably meant.
struct UnknownKey {
  std::string message;
  std::string advice;                         ///< the end of the message, what to do; empty if nothing is known
  std::optional<std::string_view> meant;      ///< a key of the same object
  std::optional<std::string_view> elsewhere;  ///< or the pointer pattern of one in another object
};
/// Finds the allowed keys and the probable one for an unknown key: a wish that cannot be met; a key of the object; else one of the
/// whole file. @param pattern  pattern of the object
UnknownKey unknown_key(const FieldTable& table, std::string_view key, std::string_view pattern);

/// The field or number that a pointer leads to in files of the table's kind, independent of a file's other keys.
struct PointerTarget {
  const Field* field = nullptr;      ///< last field on the way; numbers in a vector, matrix or list belong to its field
  bool is_number = false;            ///< whether it is a number, or one of the numbers of a field
  std::optional<std::string> fault;  ///< why there cannot be a value; empty if there can
};
PointerTarget pointer_target(const FieldTable& table, std::string_view pointer);

/// Returns the node that a pointer leads to; null if the tree has none.
const Node* node_at(const Node& root, std::string_view pointer);

}  // namespace earthtop::input
