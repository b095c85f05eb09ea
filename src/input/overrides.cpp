// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/overrides.hpp"

#include <fmt/core.h>

#include <cmath>

#include "input/pointers.hpp"
#include "input/reader.hpp"
#include "text/utf8.hpp"

namespace earthtop::input {
namespace {

constexpr Place kFromSet{0, true};

/// Returns the child node of `parent` and creates it if an object lacks it; null, with a finding, if there cannot be one.
Node* step_into(Node& parent, const std::string& token, const std::string& pointer, Findings& findings) {
  if (parent.kind == JsonKind::array) {
    if (const auto index = array_index(token, parent.children.size())) return &parent.children[*index];
    findings.add(kFromSet, pointer,
                 fmt::format("--set: \"{}\" is not an index of an array of {}", excerpt(token), parent.children.size()));
    return nullptr;
  }
  if (parent.kind != JsonKind::object) {
    findings.add(
        kFromSet, pointer,
        fmt::format("--set: the pointer leads through {}; it may lead through objects and arrays only", name_of(parent.kind)));
    return nullptr;
  }
  if (Node* child = parent.find(token)) return child;
  Node& child = parent.children.emplace_back();
  child.key = token;
  child.key_place = child.place = kFromSet;
  child.kind = JsonKind::object;
  return &child;
}

/// Makes the node that reading the number's shortest digits would give: -0 becomes 0, and NaN and infinity become null.
Node node_of(double number) {
  Node node;
  node.kind = std::isfinite(number) ? JsonKind::number : JsonKind::null;
  node.number = number == 0 ? 0 : number;
  return node;
}

/// Makes the node of a JSON text, or of a string if the text is not JSON.
Node node_of(const std::string& value, const std::string& shown, Findings& findings) {
  Node node;
  Findings ignored;
  const ReadOutcome outcome = read_json(value, shown, true, node, ignored);
  if (outcome == ReadOutcome::not_json || outcome == ReadOutcome::not_finite) {
    node = Node{};
    node.kind = JsonKind::string;
    node.text = value;
  } else if (!ignored.empty()) {
    node = Node{};  // read again to report the findings
    if (read_json(value, shown, true, node, findings) == ReadOutcome::refused) node.kind = JsonKind::refused;
  }
  return node;
}

void apply(Node& root, const std::string& pointer, const std::variant<double, std::string>& value, Findings& findings) {
  const std::string shown = excerpt(pointer, 200);
  const auto tokens = tokens_of(pointer);
  if (!tokens || tokens->size() > kGreatestDepth || first_invalid_utf8(pointer) != std::string_view::npos) {
    findings.add(kFromSet, shown, "--set: malformed JSON pointer; write --set /site/latitude_deg=45");
    return;
  }
  Node* node = &root;
  for (const std::string& token : *tokens)
    if (node = step_into(*node, token, shown, findings); !node) return;

  const auto* number = std::get_if<double>(&value);
  Node replacement = number ? node_of(*number) : node_of(std::get<std::string>(value), shown, findings);
  replacement.place = kFromSet;
  replacement.key = node->key;
  replacement.key_place = node->key_place;
  *node = std::move(replacement);
}

}  // namespace

void apply_overrides(Node& root, const std::vector<std::pair<std::string, std::string>>& overrides, Findings& findings) {
  for (const auto& [pointer, value] : overrides) apply(root, pointer, value, findings);
}

void apply_changes(Node& root, const std::vector<TreeChange>& changes, Findings& findings) {
  if (!changes.empty()) findings.leave_out_option();
  for (const TreeChange& change : changes) apply(root, change.pointer, change.value, findings);
}

}  // namespace earthtop::input
