// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/json_text.hpp"

#include <nlohmann/json.hpp>

#include "text/json.hpp"

namespace earthtop::study {
namespace {

Json tree_of(const input::Node& node) {
  using input::JsonKind;
  Json json;
  switch (node.kind) {
    case JsonKind::null:
    case JsonKind::refused: break;
    case JsonKind::boolean: json = node.boolean; break;
    case JsonKind::number: json = node.number; break;
    case JsonKind::string: json = node.text; break;
    case JsonKind::array:
      json = Json::array();
      for (const input::Node& child : node.children) json.push_back(tree_of(child));
      break;
    case JsonKind::object:
      json = Json::object();
      for (const input::Node& child : node.children) json[child.key] = tree_of(child);
      break;
  }
  return json;
}

}  // namespace

std::string json_text(const input::Node& node) { return written(tree_of(node)); }

std::string json_text(double number) { return written(number); }

}  // namespace earthtop::study
