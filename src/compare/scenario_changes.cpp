// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/scenario_changes.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "earthtop/scenario/scenario.hpp"
#include "input/node.hpp"
#include "text/json.hpp"

namespace earthtop::compare {
namespace {

std::string shown(const Json* json) { return json ? input::excerpt(written_replacing(*json)) : "nothing"; }

void collect(const Json* a, const Json* b, const std::string& pointer, std::vector<ScenarioChange>& changes) {
  if (a && b && *a == *b) return;
  const bool objects = (!a || a->is_object()) && (!b || b->is_object());
  if (!objects) {
    changes.push_back({pointer, shown(a), shown(b)});
    return;
  }
  std::map<std::string, std::pair<const Json*, const Json*>> members;
  if (a)
    for (const auto& [key, value] : a->items()) members[key].first = &value;
  if (b)
    for (const auto& [key, value] : b->items()) members[key].second = &value;
  for (const auto& [key, both] : members) collect(both.first, both.second, pointer + input::pointer_step(key), changes);
}

}  // namespace

std::vector<ScenarioChange> scenario_changes(const Json& reference, const Json& candidate) {
  std::vector<ScenarioChange> changes;
  Json a = reference, b = candidate;
  for (Json* json : {&a, &b})
    if (json->is_object()) {
      json->erase("name");
      for (const std::string_view key : describing_keys()) json->erase(std::string(key));
    }
  collect(&a, &b, "", changes);
  return changes;
}

bool is_below(const std::string& pointer, const std::vector<std::string>& allowed) {
  return std::any_of(allowed.begin(), allowed.end(), [&](const std::string& top) {
    return top == "/" || pointer == top || (pointer.starts_with(top) && pointer[top.size()] == '/');
  });
}

}  // namespace earthtop::compare
