// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario_operand.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "earthtop/error.hpp"
#include "input/suggest.hpp"

namespace earthtop::tool {
namespace {

constexpr std::string_view kExtension = ".json";

const Example* example_called(std::string_view name) {
  const auto all = tool::examples();
  const auto found = std::ranges::find(all, name, &Example::name);
  return found == all.end() ? nullptr : &*found;
}

std::optional<std::string_view> meant_example(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Example& example : tool::examples()) names.push_back(example.name);
  const auto same = std::ranges::find_if(names, [&](std::string_view known) {
    const auto bare = [](std::string_view text) {
      std::string letters = input::lower_case(text);
      std::erase(letters, '_');
      return letters;
    };
    return bare(known) == bare(name);
  });
  return same != names.end() ? *same : input::suggest(name, names);
}

}  // namespace

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for (const Example& example : tool::examples()) names.emplace_back(example.name);
  return names;
}

const Example& find_example(std::string_view name) {
  if (const Example* known = example_called(name)) return *known;
  const auto meant = meant_example(name);
  const std::string remedy =
      meant ? fmt::format("did you mean {}?", *meant) : fmt::format("there are: {}", fmt::join(example_names(), ", "));
  throw ScenarioError("", fmt::format("there is no example \"{}\"; {}", name, remedy));
}

ScenarioSource source_of(const Example& example) {
  return {std::string(example.name) + std::string(kExtension), std::string(example.text)};
}

ScenarioSource scenario_of(const std::string& operand) {
  const bool is_path = operand.find('/') != std::string::npos;
  std::error_code error;
  if (operand == "-" || is_path || std::filesystem::is_regular_file(operand, error)) return read_scenario_source(operand);
  if (const Example* known = example_called(operand)) return source_of(*known);
  if (std::filesystem::symlink_status(operand, error).type() != std::filesystem::file_type::not_found)
    return read_scenario_source(operand);
  std::string_view name = operand;
  if (name.ends_with(kExtension)) name.remove_suffix(kExtension.size());
  if (const auto meant = meant_example(name))
    refuse_file(operand, fmt::format("there is no such file; a scenario that comes with the program is called {}", *meant));
  return read_scenario_source(operand);
}

}  // namespace earthtop::tool
