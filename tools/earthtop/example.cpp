// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <memory>
#include <optional>
#include <string_view>

#include "command_line.hpp"
#include "earthtop/scenario/reference.hpp"
#include "earthtop/scene/scene.hpp"
#include "output.hpp"
#include "scenario_operand.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct ExampleArguments {
  std::optional<std::string> name;
  bool annotated = false;
  bool list = false;
};

int example_verb(const ExampleArguments& arguments) {
  if (arguments.list) {
    std::string list;
    for (const Example& example : examples())
      list += fmt::format("{:<32}{}\n", example.name, parse_scenario(source_of(example)).title);
    print(list);
    return kDone;
  }
  const Example& example = find_example(arguments.name.value_or("toy-top"));
  print(arguments.annotated || !arguments.name ? annotated_scenario(source_of(example)) : std::string(example.text));
  return kDone;
}

}  // namespace

Verb describe_example() {
  auto arguments = std::make_shared<ExampleArguments>();
  Verb example("example", "print a scenario to begin with; without a name, one that explains itself",
               [arguments] { return example_verb(*arguments); });
  example.add("NAME", &arguments->name, "one of the scenarios that come with the program").completed_to(example_names());
  example.add("--annotated", &arguments->annotated, "print every key that applies, with an explanation and its default");
  example.add("--list", &arguments->list, "print the names and titles of all these scenarios")
      .without("NAME")
      .without("--annotated");
  example.describe(
      "The scenarios are built into the program. One that is named is printed as it stands in the program's source; with "
      "--annotated, every key that applies is there, with an explanation and its default.");
  example.example("earthtop example > mine.json", "writes a scenario to begin with, which explains itself");
  example.example("earthtop example --list", "lists the names and titles");
  example.example("earthtop example foucault-pendulum | earthtop run -", "runs one of them");
  example.ends_with(kRefused, "the command line was refused, or there is no scenario of that name");
  return example;
}

}  // namespace earthtop::tool
