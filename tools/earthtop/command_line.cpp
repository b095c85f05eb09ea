// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <type_traits>

namespace earthtop::tool {
namespace {

/// Adds an option that writes to its target, without the conditions that the table states for it.
CLI::Option* bound(const Option& option, CLI::App& app) {
  return std::visit(
      [&](auto* target) -> CLI::Option* {
        if constexpr (std::is_same_v<decltype(target), bool*>)
          return app.add_flag(option.name, *target, option.help);
        else
          return app.add_option(option.name, *target, option.help);
      },
      option.target);
}

CLI::Validator validator(const Range& range, const Target& target) {
  if (std::holds_alternative<double*>(target)) return CLI::Range(range.low, range.high);
  return CLI::Range(static_cast<int>(range.low), static_cast<int>(range.high));
}

void add_option(const Option& option, CLI::App& app) {
  CLI::Option* added = bound(option, app);
  added->required(option.is_required);
  if (!option.value.empty()) added->type_name(option.value);
  if (option.is_repeatable() && !option.is_operand()) added->allow_extra_args(false);
  if (option.has_commas) added->delimiter(',');
  if (option.range) added->check(validator(*option.range, option.target));
  if (!option.has_other_words) added->check(CLI::IsMember(option.words));
}

/// The place to which the options of a group are added; without a group, the verb itself.
CLI::App& group_of(CLI::App& app, const std::string& group) {
  if (group.empty()) return app;
  for (CLI::App* known : app.get_subcommands([](CLI::App*) { return true; }))
    if (known->get_name().empty() && known->get_group() == group) return *known;
  CLI::Option_group* added = app.add_option_group(group);
  added->require_option(0, 1);
  return *added;
}

void fill(CLI::App& app, const Verb& verb) {
  for (const Option& option : verb.options) add_option(option, group_of(app, option.group));
  for (const Option& option : verb.options)
    for (const std::string& other : option.conflicts) app.get_option(option.name)->excludes(app.get_option(other));
  for (const Verb& sub : verb.verbs) fill(*app.add_subcommand(sub.name, sub.help), sub);
  if (!verb.verbs.empty()) app.require_subcommand(0, 1);
}

/// The innermost verb that the command line names.
const Verb& named_verb(const Verb& verb, const CLI::App& app) {
  for (const Verb& sub : verb.verbs)
    if (const CLI::App* named = app.get_subcommand(sub.name); named->parsed()) return named_verb(sub, *named);
  return verb;
}

}  // namespace

Request read_command_line(const Verb& program, int argc, char** argv) {
  CLI::App app(program.help, program.name);
  app.set_help_flag(std::string(kHelpShort) + "," + std::string(kHelpOption), std::string(kHelpText));
  fill(app, program);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return {program, app.help()};  // help of the verb, if one was named
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  return {named_verb(program, app), ""};
}

}  // namespace earthtop::tool
