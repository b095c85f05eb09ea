// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/section.hpp"

#include <fmt/core.h>

#include "input/fields.hpp"
#include "input/reader.hpp"

namespace earthtop::input {
namespace {

std::array<double, 3> three_numbers(const Node& array) {
  return {array.children[0].number, array.children[1].number, array.children[2].number};
}

}  // namespace

Section::Section(const Node& root, Findings& findings, const FieldTable& table)
    : Section(root.refused ? nullptr : &root, root.place, root.refused, "", "", findings, table) {}

Section Section::section(std::string_view key) const {
  const std::string step = fmt::format("/{}", key);
  const Node* child = node_ ? node_->find(key) : nullptr;
  const bool refused = refused_ || (child && (child->refused || child->kind != JsonKind::object));
  return Section(refused ? nullptr : child, child ? child->place : place_, refused, pointer_ + step, pattern_ + step,
                 *findings_, *table_);
}

Section Section::element(std::string_view key, std::size_t index) const {
  const Node& child = node_->find(key)->children[index];
  const bool refused = child.refused || child.kind != JsonKind::object;
  return Section(refused ? nullptr : &child, child.place, refused, fmt::format("{}/{}/{}", pointer_, key, index),
                 fmt::format("{}/{}/*", pattern_, key), *findings_, *table_);
}

std::size_t Section::size(std::string_view key) const {
  const Node* list = node_ ? node_->find(key) : nullptr;
  return list && list->kind == JsonKind::array ? list->children.size() : 0;
}

const Node* Section::value(std::string_view key, Node& fallback) const {
  if (refused_) return nullptr;
  if (const Node* child = node_ ? node_->find(key) : nullptr) return child->refused ? nullptr : child;
  const Field* field = table_->find(fmt::format("{}/{}", pattern_, key));
  if (!field || field->fallback.empty()) return nullptr;
  Findings none;
  read_json(field->fallback, "", false, fallback, none);
  return &fallback;
}

template <class Get>
auto Section::read(std::string_view key, Get get) const {
  Node fallback;
  const Node* node = value(key, fallback);
  return node ? std::optional(get(*node)) : std::nullopt;
}

std::optional<double> Section::number(std::string_view key) const {
  return read(key, [](const Node& node) { return node.number; });
}
std::optional<bool> Section::flag(std::string_view key) const {
  return read(key, [](const Node& node) { return node.boolean; });
}
std::optional<std::string> Section::word(std::string_view key) const {
  return read(key, [](const Node& node) { return node.text; });
}
std::optional<std::vector<double>> Section::numbers(std::string_view key) const {
  return read(key, [](const Node& node) {
    std::vector<double> list;
    for (const Node& child : node.children) list.push_back(child.number);
    return list;
  });
}
std::optional<std::vector<std::array<double, 3>>> Section::points(std::string_view key) const {
  return read(key, [](const Node& node) {
    std::vector<std::array<double, 3>> list;
    for (const Node& child : node.children) list.push_back(three_numbers(child));
    return list;
  });
}
std::optional<std::vector<std::string>> Section::changes(std::string_view key) const {
  return read(key, [](const Node& node) {
    std::vector<std::string> list;
    for (const Node& child : node.children) list.push_back(child.text);
    return list;
  });
}
std::optional<std::array<double, 2>> Section::pair(std::string_view key) const {
  return read(key, [](const Node& node) { return std::array{node.children[0].number, node.children[1].number}; });
}
std::optional<std::array<double, 3>> Section::vector(std::string_view key) const { return read(key, three_numbers); }
std::optional<std::array<std::array<double, 3>, 3>> Section::matrix(std::string_view key) const {
  return read(key, [](const Node& node) {
    return std::array{three_numbers(node.children[0]), three_numbers(node.children[1]), three_numbers(node.children[2])};
  });
}

const Node* Section::any(std::string_view key) const {
  const Node* child = node_ && !refused_ ? node_->find(key) : nullptr;
  return child && !child->refused ? child : nullptr;
}

void Section::refuse(std::string_view key, std::string message) const {
  const Node* child = node_ ? node_->find(key) : nullptr;
  findings_->add(child ? child->place : place_, fmt::format("{}/{}", pointer_, key), std::move(message));
}

void Section::refuse_key(std::string_view key, std::string message) const {
  const Node* child = node_ ? node_->find(key) : nullptr;
  findings_->add(child ? child->key_place : place_, fmt::format("{}/{}", pointer_, key), std::move(message));
}

void Section::warn(std::string_view key, std::string message) const {
  const Node* child = node_ ? node_->find(key) : nullptr;
  findings_->warn(child ? child->place : place_, fmt::format("{}/{}", pointer_, key), std::move(message));
}

void Section::missing(std::string_view key, std::string message) const {
  std::string pointer = fmt::format("{}/{}", pointer_, key);
  if (!refused_ && !findings_->expected(pointer) && !findings_->expected(pointer_))
    findings_->add(place_, std::move(pointer), std::move(message));
}

bool Section::expects(std::string_view key) const { return findings_->expected(fmt::format("{}/{}", pointer_, key)); }

bool Section::is_required(std::string_view key) const {
  const Field* field = table_->find(fmt::format("{}/{}", pattern_, key));
  return field && field->required;
}

bool Section::require(std::string_view key) const {
  if (has(key)) return true;
  const Field* field = table_->find(fmt::format("{}/{}", pattern_, key));
  missing(key, fmt::format("is missing; must be {}", field ? allowed_values(*field) : "given"));
  return false;
}

}  // namespace earthtop::input
