// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/check.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "earthtop/error.hpp"
#include "input/fields.hpp"
#include "input/pointers.hpp"
#include "input/reader.hpp"
#include "input/suggest.hpp"

namespace earthtop::input {
namespace {

/// Returns a node's value as messages show it; short values are shown in full.
std::string shown(const Node& node) {
  switch (node.kind) {
    case JsonKind::number: return fmt::format("{}", node.number);
    case JsonKind::string: return fmt::format("\"{}\"", excerpt(node.text));
    case JsonKind::boolean: return node.boolean ? "true" : "false";
    case JsonKind::array: return fmt::format("an array of {}", node.children.size());
    default: return std::string(name_of(node.kind));
  }
}

class Checker {
 public:
  Checker(Findings& findings, const FieldTable& table) : findings_(findings), table_(table) {}

  void members(Node& node, std::string_view pattern, const std::string& pointer) {
    for (Node& child : node.children) {
      if (is_comment(child.key)) continue;
      const std::string child_pointer = pointer + pointer_step(child.key);
      const bool plain = child.key.size() < 80 && child.key.find('/') == std::string::npos && child.key != "*";
      const Field* field = plain ? table_.find(std::string(pattern) + "/" + child.key) : nullptr;
      if (field)
        value(child, *field, child_pointer);
      else
        unknown_key(child, pattern, child_pointer, pointer);
    }
  }

 private:
  void refuse(Node& node, const std::string& pointer, std::string message) {
    if (node.kind != JsonKind::refused && !node.refused) findings_.add(node.place, pointer, std::move(message));
    node.refused = true;
  }
  void wrong_type(Node& node, const Field& field, const std::string& pointer) {
    refuse(node, pointer, fmt::format("is {}; must be {}", shown(node), allowed_values(field)));
  }

  void unknown_key(Node& node, std::string_view pattern, const std::string& pointer, const std::string& parent_pointer) {
    node.refused = true;
    if (findings_.full()) return findings_.add(node.key_place, "", "");
    UnknownKey unknown = input::unknown_key(table_, node.key, pattern);
    if (unknown.meant) findings_.expect(parent_pointer + "/" + std::string(*unknown.meant));
    if (unknown.elsewhere) findings_.expect(std::string(*unknown.elsewhere));
    findings_.add(node.key_place, pointer, std::move(unknown.message));
  }

  void value(Node& node, const Field& field, const std::string& pointer) {
    using enum FieldKind;
    switch (field.kind) {
      case object:
        if (node.kind != JsonKind::object) return wrong_type(node, field, pointer);
        return members(node, field.pointer, pointer);
      case object_or_word:
        if (node.kind == JsonKind::object) return members(node, field.pointer, pointer);
        return one_word(node, field, pointer);
      case flag_or_object:
        if (node.kind == JsonKind::object) return members(node, field.pointer, pointer);
        if (node.kind == JsonKind::boolean) return;
        return one_word(node, field, pointer);
      case list: return objects(node, field, pointer);
      case text:
        if (node.kind != JsonKind::string) wrong_type(node, field, pointer);
        return;
      case name:
        if (node.kind != JsonKind::string || !is_name(node.text)) wrong_type(node, field, pointer);
        return;
      case word: return one_word(node, field, pointer);
      case flag:
        if (node.kind != JsonKind::boolean) wrong_type(node, field, pointer);
        return;
      case number: return one_number(node, field, pointer);
      case number_or_vector3:
        if (node.kind == JsonKind::array) return number_list(node, field, pointer, 3, 3);
        return one_number(node, field, pointer);
      case vector2: return number_list(node, field, pointer, 2, 2);
      case vector3: return number_list(node, field, pointer, 3, 3);
      case FieldKind::numbers: return number_list(node, field, pointer, 1, 4);
      case series: return number_list(node, field, pointer, 1, kLongestSeries);
      case points: return rows(node, field, pointer, 1, kLongestSeries);
      case FieldKind::changes: return change_list(node, field, pointer);
      case matrix3: return rows(node, field, pointer, 3, 3);
      case anything: return;
    }
  }

  void one_word(Node& node, const Field& field, const std::string& pointer) {
    if (node.kind != JsonKind::string) return wrong_type(node, field, pointer);
    const auto words = split_words(field.words);
    if (std::find(words.begin(), words.end(), node.text) != words.end()) return;
    std::string message = fmt::format("is {}; must be {}", shown(node), allowed_values(field));
    if (const auto near = suggest(node.text, words)) message += fmt::format("; did you mean \"{}\"", *near);
    refuse(node, pointer, std::move(message));
  }

  void objects(Node& node, const Field& field, const std::string& pointer) {
    if (node.kind != JsonKind::array || node.children.empty()) return wrong_type(node, field, pointer);
    const Field& element = *table_.find(std::string(field.pointer) + "/*");
    for (std::size_t i = 0; i < node.children.size(); ++i) value(node.children[i], element, fmt::format("{}/{}", pointer, i));
    propagate(node);
  }

  void one_number(Node& node, const Field& field, const std::string& pointer) {
    if (node.kind != JsonKind::number) {
      node.kind == JsonKind::array || node.kind == JsonKind::object
          ? wrong_type(node, field, pointer)
          : refuse(node, pointer, fmt::format("is {}; must be {}", shown(node), number_text(field)));
      return;
    }
    if (!field.range.contains(node.number))
      refuse(node, pointer,
             fmt::format("{} is out of range; must be {}{}{}", shown(node), number_text(field),
                         field.reason.empty() ? "" : "; ", field.reason));
  }
  static std::string number_text(const Field& field) {
    Field one = field;
    one.kind = FieldKind::number;
    return allowed_values(one);
  }

  void number_list(Node& node, const Field& field, const std::string& pointer, std::size_t least, std::size_t most) {
    const std::size_t size = node.children.size();
    if (node.kind != JsonKind::array || size < least || size > most) return wrong_type(node, field, pointer);
    for (std::size_t i = 0; i < size; ++i) one_number(node.children[i], field, fmt::format("{}/{}", pointer, i));
    propagate(node);
  }

  void rows(Node& node, const Field& field, const std::string& pointer, std::size_t least, std::size_t most) {
    const std::size_t size = node.children.size();
    if (node.kind != JsonKind::array || size < least || size > most) return wrong_type(node, field, pointer);
    for (std::size_t i = 0; i < size; ++i) number_list(node.children[i], field, fmt::format("{}/{}", pointer, i), 3, 3);
    propagate(node);
  }

  void change_list(Node& node, const Field& field, const std::string& pointer) {
    if (node.kind != JsonKind::array || node.children.empty()) return wrong_type(node, field, pointer);
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      Node& child = node.children[i];
      if (child.kind != JsonKind::string || !child.text.starts_with('/') || child.text.find('=') == std::string::npos)
        refuse(child, fmt::format("{}/{}", pointer, i), fmt::format("is {}; must be \"/json/pointer=value\"", shown(child)));
    }
    propagate(node);
  }

  /// Marks an array with a refused element as refused, so that later rules skip it.
  static void propagate(Node& array) {
    for (const Node& child : array.children)
      if (child.refused) array.refused = true;
  }

  Findings& findings_;
  const FieldTable& table_;
};

}  // namespace

bool is_name(std::string_view text) {
  const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  return !text.empty() && text.size() <= 64 && text.front() != '-' && std::all_of(text.begin(), text.end(), allowed);
}

void check_structure(Node& root, Findings& findings, const FieldTable& table) {
  if (root.kind == JsonKind::object) return Checker(findings, table).members(root, "", "");
  if (root.kind != JsonKind::refused)
    findings.add(root.place, "", fmt::format("the text is {}; a {} is an object {{...}}", name_of(root.kind), table.noun));
  root.refused = true;
}

Node read_checked(std::string_view& text, const std::string& file, const FieldTable& table, Findings& findings) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Node root;
  const ReadOutcome outcome = read_json(text, "", false, root, findings, {.noun = table.noun});
  if (outcome == ReadOutcome::not_json || outcome == ReadOutcome::refused) throw ScenarioError(findings.errors(text), file);
  check_structure(root, findings, table);
  return root;
}

}  // namespace earthtop::input
