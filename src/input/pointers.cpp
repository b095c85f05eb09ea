// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/pointers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <tuple>

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
    case FieldKind::number_or_vector3:
    case FieldKind::vector3: return {3};
    case FieldKind::matrix3: return {3, 3};
    case FieldKind::numbers: return {4};
    case FieldKind::series: return {kAnyLength};
    case FieldKind::points: return {kAnyLength, 3};
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
std::optional<Suggestion> meant_key(const FieldTable& table, std::string_view key, std::string_view pattern,
                                    std::vector<std::string_view> keys) {
  if (const auto meant = abbreviated(table, key, pattern)) return Suggestion{*meant, Nearness::same};
  if (!nearest(key, keys)) return std::nullopt;
  for (const std::string_view second : keys_in_second_units(table, pattern)) {
    if (is_one_letter_off(key, second)) return Suggestion{second, Nearness::misspelt};
    std::erase(keys, second);
  }
  return nearest(key, keys);
}

/// The object's field with this key; null if there is none.
const Field* key_of(const FieldTable& table, std::string_view key, std::string_view pattern) {
  const bool plain = key.find('/') == std::string_view::npos && key != "*";
  return plain ? table.find(fmt::format("{}/{}", pattern, key)) : nullptr;
}

/// An object of the file, seen from the one in which a key stands.
struct Elsewhere {
  std::string_view pattern;
  bool below;      ///< whether it is a part of that object
  bool describes;  ///< whether no result depends on it
  std::ptrdiff_t depth;
};
/// The other objects of the file: first what is below the one with this pattern, last what only describes; by depth, and in the
/// table's order.
std::vector<Elsewhere> objects_elsewhere(const FieldTable& table, std::string_view pattern) {
  std::vector<Elsewhere> objects;
  if (!pattern.empty()) objects.push_back({"", false, false, 0});
  const Field* describing = nullptr;  // the last field that only describes; its members follow it
  for (const Field& field : table.fields) {
    if (field.describes_only) describing = &field;
    if (field.pointer == pattern || !(may_be_object(field.kind) || field.key() == "*")) continue;
    const bool below =
        !pattern.empty() && field.pointer.starts_with(pattern) && field.pointer.substr(pattern.size()).starts_with('/');
    objects.push_back({field.pointer, below, describing && field.pointer.starts_with(describing->pointer),
                       std::count(field.pointer.begin(), field.pointer.end(), '/') -
                           std::count(field.pointer.begin(), field.pointer.end(), '*')});
  }
  const auto order = [](const Elsewhere& object) { return std::tuple(object.describes, !object.below, object.depth); };
  std::stable_sort(objects.begin(), objects.end(), [&](const Elsewhere& a, const Elsewhere& b) { return order(a) < order(b); });
  return objects;
}

/// The field of another object that has this key, or the one that it probably means; null if there is none. A key may begin with
/// the name of its object: "platform_rate".
const Field* meant_elsewhere(const FieldTable& table, std::string_view key, const std::vector<Elsewhere>& objects,
                             bool describes) {
  const Field* best = nullptr;
  Nearness least{};
  bool alone = true;
  const auto take = [&](std::string_view pattern, const std::optional<Suggestion>& meant) {
    if (!meant || (best && meant->nearness > least)) return;
    alone = !best || meant->nearness < least;
    if (alone) best = table.find(fmt::format("{}/{}", pattern, meant->word)), least = meant->nearness;
  };
  for (const Elsewhere& object : objects)
    if (object.describes == describes)
      if (const Field* field = key_of(table, key, object.pattern)) return field;
  for (const Elsewhere& object : objects) {
    if (object.describes != describes) continue;
    const std::vector<std::string_view> keys = table.keys_below(object.pattern);
    take(object.pattern, meant_key(table, key, object.pattern, keys));
    const std::string name = lower_case(object.pattern.substr(object.pattern.rfind('/') + 1)) + "_";
    if (name.size() > 1 && lower_case(key.substr(0, name.size())) == name)
      take(object.pattern, meant_key(table, key.substr(name.size()), object.pattern, keys));
  }
  return best && (alone || least != Nearness::incomplete) ? best : nullptr;
}

/// Finds the key that is probably meant: of the object, or else of the whole file.
void advise(UnknownKey& unknown, const FieldTable& table, std::string_view key, std::string_view pattern,
            const std::vector<std::string_view>& keys) {
  const std::vector<Elsewhere> objects = objects_elsewhere(table, pattern);
  const bool is_below = std::any_of(objects.begin(), objects.end(), [&](const Elsewhere& other) {
    return other.below && key_of(table, key, other.pattern) != nullptr;
  });
  const auto here = meant_key(table, key, pattern, keys);
  if (here && (here->nearness != Nearness::incomplete || !is_below)) {
    unknown.meant = here->word;
    unknown.advice = fmt::format("did you mean \"{}\"", *unknown.meant);
    return;
  }
  for (const Elsewhere& other : objects)
    if (auto foreign = foreign_unit(table, key, other.pattern, true)) {
      unknown.advice = std::move(foreign->message);
      return;
    }
  const Field* there = meant_elsewhere(table, key, objects, false);
  if (!there) there = meant_elsewhere(table, key, objects, true);
  if (!there) return;
  unknown.elsewhere = there->pointer;
  unknown.advice = fmt::format("did you mean \"{}\"", there->pointer);
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
  UnknownKey unknown;
  const Wish* wish = table.wish(lower_case(key));
  if (auto foreign = wish ? std::nullopt : foreign_unit(table, key, pattern)) {
    unknown.message = unknown.advice = std::move(foreign->message);
    unknown.meant = foreign->meant;
    return unknown;
  }
  const std::vector<std::string_view> keys = table.keys_below(pattern);
  const Field* object = table.find(pattern);
  unknown.message = fmt::format("{}; allowed here: {}", object ? object->unknown : Field{}.unknown, fmt::join(keys, ", "));
  if (wish)
    unknown.advice = wish->sentence;
  else
    advise(unknown, table, key, pattern, keys);
  if (!unknown.advice.empty()) unknown.message += "; " + unknown.advice;
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
    target.is_number = kind == FieldKind::number || kind == FieldKind::number_or_vector3;
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
