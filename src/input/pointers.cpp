// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/pointers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "input/foreign_units.hpp"
#include "input/node.hpp"
#include "input/suggest.hpp"

namespace earthtop::input {
namespace {

constexpr std::size_t kAnyLength = std::numeric_limits<std::size_t>::max();

/// Returns the lengths of the nested arrays in a value of this kind, outer first; empty if it is not an array of plain values.
std::vector<std::size_t> lengths_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::vector2: return {2};
    case FieldKind::vector3: return {3};
    case FieldKind::matrix3: return {3, 3};
    case FieldKind::numbers: return {4};
    case FieldKind::changes: return {kAnyLength};
    default: return {};
  }
}

bool may_be_object(FieldKind kind) {
  return kind == FieldKind::object || kind == FieldKind::object_or_word || kind == FieldKind::flag_or_object;
}

std::string no_index(std::string_view token, std::size_t size) {
  const std::string shown = excerpt(token);
  return size == kAnyLength
             ? fmt::format("\"{}\" is not an index of an array", shown)
             : fmt::format("\"{}\" is not an index of an array of {}; allowed here: 0 to {}", shown, size, size - 1);
}

/// The key that was probably meant. A quantity without unit, or with a misspelled one, means its first key; another key for the
/// same quantity is meant by a misspelling of that key only.
std::optional<std::string_view> meant_key(const FieldTable& table, std::string_view key, std::string_view pattern,
                                          std::vector<std::string_view> keys) {
  if (const auto meant = abbreviated(table, key, pattern)) return meant;
  for (const std::string_view second : keys_in_second_units(table, pattern)) {
    if (is_one_letter_off(key, second)) return second;
    std::erase(keys, second);
  }
  return suggest(key, keys);
}

}  // namespace

std::optional<std::vector<std::string>> tokens_of(std::string_view pointer) {
  if (pointer.empty() || pointer.front() != '/') return std::nullopt;
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      tokens.emplace_back();
    } else if (pointer[i] == '~') {
      ++i;
      if (i >= pointer.size() || (pointer[i] != '0' && pointer[i] != '1')) return std::nullopt;
      tokens.back() += pointer[i] == '0' ? '~' : '/';
    } else {
      tokens.back() += pointer[i];
    }
  }
  return tokens;
}

std::optional<std::size_t> array_index(std::string_view token, std::size_t size) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), index);
  const bool canonical = token.size() == 1 || !token.starts_with('0');
  if (error != std::errc() || end != token.data() + token.size() || !canonical || index >= size) return std::nullopt;
  return index;
}

UnknownKey unknown_key(const FieldTable& table, std::string_view key, std::string_view pattern) {
  if (auto foreign = foreign_unit(table, key, pattern)) return {std::move(foreign->message), foreign->meant};
  const std::vector<std::string_view> keys = table.keys_below(pattern);
  const Field* object = table.find(pattern);
  UnknownKey unknown{std::string(object ? object->unknown : Field{}.unknown), meant_key(table, key, pattern, keys)};
  unknown.message += fmt::format("; allowed here: {}", fmt::join(keys, ", "));
  if (unknown.meant) {
    unknown.message += fmt::format("; did you mean \"{}\"", *unknown.meant);
    return unknown;
  }
  for (const Field& field : table.fields) {  // the right key in the wrong place
    if (field.key() != key || field.pointer.find('*') != std::string_view::npos) continue;
    unknown.message += fmt::format("; did you mean \"{}\"", field.pointer);
    break;
  }
  return unknown;
}

PointerTarget pointer_target(const FieldTable& table, std::string_view pointer) {
  PointerTarget target;
  const auto fault = [&](std::string message) {
    target.fault = std::move(message);
    target.is_number = false;
    return target;
  };
  const auto tokens = tokens_of(pointer);
  if (!tokens) return fault("is not a JSON pointer; write e.g. /site/latitude_deg");
  std::string pattern;  // pattern of the value that the tokens so far lead to
  FieldKind kind = FieldKind::object;
  std::vector<std::size_t> lengths;  // lengths of the arrays that the next tokens index
  for (const std::string& token : *tokens) {
    if (!lengths.empty()) {
      if (!array_index(token, lengths.front())) return fault(no_index(token, lengths.front()));
      lengths.erase(lengths.begin());
      target.is_number = lengths.empty() && target.field->kind != FieldKind::changes;
      kind = FieldKind::number;
      continue;
    }
    if (kind == FieldKind::list) {
      if (!array_index(token, kAnyLength)) return fault(no_index(token, kAnyLength));
      pattern += "/*";
    } else if (may_be_object(kind)) {
      if (is_comment(token)) return fault(fmt::format("\"{}\" is a comment: it changes nothing", excerpt(token)));
      const bool plain = token.find('/') == std::string::npos && token != "*";
      if (!plain || table.find(fmt::format("{}/{}", pattern, token)) == nullptr)
        return fault(fmt::format("\"{}\": {}", excerpt(token), unknown_key(table, token, pattern).message));
      pattern += "/" + token;
    } else {
      return fault(fmt::format("{} has no members, so there is no \"{}\"", pattern, excerpt(token)));
    }
    target.field = table.find(pattern);
    kind = target.field->kind;
    lengths = lengths_of(kind);
    target.is_number = kind == FieldKind::number;
  }
  return target;
}

const Node* node_at(const Node& root, std::string_view pointer) {
  const auto tokens = tokens_of(pointer);
  if (!tokens) return nullptr;
  const Node* node = &root;
  for (const std::string& token : *tokens) {
    if (node->kind == JsonKind::array) {
      const auto index = array_index(token, node->children.size());
      node = index ? &node->children[*index] : nullptr;
    } else {
      node = node->find(token);
    }
    if (!node) return nullptr;
  }
  return node;
}

}  // namespace earthtop::input
