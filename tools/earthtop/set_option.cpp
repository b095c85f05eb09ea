// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "command_line.hpp"
#include "earthtop/error.hpp"
#include "earthtop/scenario/reference.hpp"
#include "verbs.hpp"

namespace earthtop::tool {

void add_set_option(Verb& verb, std::vector<std::string>& sets) {
  verb.add("--set", &sets, "change one value of the scenario, e.g. tilt_deg=25 or /site/latitude_deg=60; may be repeated")
      .called("KEY=VALUE");
}

std::vector<std::pair<std::string, std::string>> split_sets(const std::vector<std::string>& sets) {
  std::vector<std::pair<std::string, std::string>> overrides;
  std::vector<Diagnostic> errors;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos) {
      errors.push_back({0, 0, "", fmt::format("--set {}: is not KEY=VALUE", set)});
      continue;
    }
    try {
      overrides.emplace_back(scenario_pointer(set.substr(0, equals)), set.substr(equals + 1));
    } catch (const ScenarioError& error) {
      errors.push_back({0, 0, "", fmt::format("--set {}: {}", set, error.diagnostics().front().message)});
    }
  }
  if (!errors.empty()) throw ScenarioError(std::move(errors));
  return overrides;
}

}  // namespace earthtop::tool
