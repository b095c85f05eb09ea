// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "command_line.hpp"
#include "earthtop/error.hpp"
#include "verbs.hpp"

namespace earthtop::tool {

void add_set_option(Verb& verb, std::vector<std::string>& sets) {
  verb.add("--set", &sets, "change one value of the scenario, e.g. /site/latitude_deg=60; may be repeated")
      .called("/POINTER=VALUE");
}

std::vector<std::pair<std::string, std::string>> split_sets(const std::vector<std::string>& sets) {
  std::vector<std::pair<std::string, std::string>> overrides;
  std::vector<Diagnostic> errors;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || !set.starts_with('/'))
      errors.push_back({0, 0, "", fmt::format("--set {}: is not /json/pointer=VALUE", set)});
    else
      overrides.emplace_back(set.substr(0, equals), set.substr(equals + 1));
  }
  if (!errors.empty()) throw ScenarioError(std::move(errors));
  return overrides;
}

}  // namespace earthtop::tool
