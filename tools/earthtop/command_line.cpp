// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "earthtop/error.hpp"
#include "unknown_words.hpp"

namespace earthtop::tool {
namespace {

/// Adds an option that writes to its target, without the conditions that the table states for it.
CLI::Option* bound(const Option& option, CLI::App& app) {
  const std::string names = option.short_name.empty() ? option.name : option.short_name + "," + option.name;
  return std::visit(
      [&](auto* target) -> CLI::Option* {
        if constexpr (std::is_same_v<decltype(target), bool*>)
          return app.add_flag(names, *target);
        else
          return app.add_option(names, *target);
      },
      option.target);
}

/// The complaint of a value that is no number of the option's type and range; empty if it is one.
std::string complaint_of_number(const std::string& given, const Option& option) {
  const auto is_allowed = [&](auto value) {
    const auto [low, high] = option.range.value_or(Range{-HUGE_VAL, HUGE_VAL});
    return CLI::detail::lexical_cast(given, value) && !(value < low) && !(value > high);
  };
  const bool is_whole =
      !std::holds_alternative<double*>(option.target) && !std::holds_alternative<std::optional<double>*>(option.target);
  const bool is_signed = std::holds_alternative<int*>(option.target);
  if (!is_whole ? is_allowed(double{}) : is_signed ? is_allowed(int{}) : is_allowed(unsigned{})) return "";
  std::string complaint = fmt::format("\"{}\" is not a {}number", printable(given), is_whole ? "whole " : "");
  if (option.range) complaint += fmt::format(" from {:g} to {:g}", option.range->low, option.range->high);
  return complaint;
}

bool is_number(const Option& option) {
  return std::visit(
      [](auto* target) {
        using Value = std::remove_pointer_t<decltype(target)>;
        return (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>) || std::is_same_v<Value, std::optional<double>>;
      },
      option.target);
}

void add_option(const Option& option, CLI::App& app) {
  CLI::Option* added = bound(option, app);
  added->required(option.is_required);
  if (option.is_repeatable() && !option.is_operand()) added->allow_extra_args(false);
  if (option.has_commas) added->delimiter(',');
  if (is_number(option)) added->check([&option](const std::string& given) { return complaint_of_number(given, option); });
  if (!option.has_other_words)
    added->check([&option](const std::string& given) { return complaint_of_word(given, option.words); });
}

/// @param first  the first word for this verb: where it names a verb below, the parser enters that one, and the options of the others,
/// which take longer to add than the words to parse, are left out
void fill(CLI::App& app, const Verb& verb, std::string_view first = "") {
  for (const Option& option : verb.options) add_option(option, app);
  const bool is_verb = std::ranges::find(verb.verbs, first, &Verb::name) != verb.verbs.end();
  for (const Verb& sub : verb.verbs) {
    CLI::App& parser = *app.add_subcommand(sub.name);
    if (!is_verb || sub.name == first) fill(parser, sub);
  }
  if (!verb.verbs.empty()) app.require_subcommand(0, 1);
}

/// Checks that no two options are given that exclude each other. @throws UsageError
void require_compatible(const NamedVerb& named, const CLI::App& app) {
  std::vector<const Option*> given;
  for (const Option& option : named.verb.options)
    if (app.count(option.name) > 0) given.push_back(&option);
  for (const Option* one : given)
    for (const Option* other : given)
      if (one != other && one->excludes(*other))
        throw UsageError(fmt::format("{} and {} cannot be given together", one->name, other->name), named.path);
}

/// The innermost verb that the command line names, and its parser.
struct Named {
  NamedVerb verb;
  const CLI::App* app;
};

Named innermost(const Named& outer) {
  for (const Verb& sub : outer.verb.verb.verbs)
    if (const CLI::App* app = outer.app->get_subcommand(sub.name); app->parsed())
      return innermost({{sub, outer.verb.path + " " + sub.name}, app});
  return outer;
}

/// Complains of the first word that no verb takes, which says more than a complaint of what is missing because of it.
/// @throws UsageError
void require_known_words(const NamedVerb& named, const CLI::App& app) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (!unknown.empty()) throw UsageError(complaint_of_unknown(named, unknown.front()), named.path);
}

/// The parser's complaint of an option that was given a value too many or too few, in plain words.
std::string complaint_of_count(const CLI::ArgumentMismatch& error) {
  const std::string what = error.what(), name = what.substr(0, what.find(':'));
  return what.find("At Most") != std::string::npos ? name + " can be given only once" : name + " needs a value";
}

/// The parser's complaint of an option that takes no value and was given one, in plain words.
std::string complaint_of_flag(const CLI::ConversionError& error) {
  const std::string what = error.what();  // "Could not convert: --json = maybe"
  const auto begin = what.find('-');
  return what.substr(begin, what.find(" =") - begin) + " takes no value";
}

}  // namespace

Request read_command_line(const Verb& program, int argc, char** argv) {
  CLI::App app;
  app.set_help_flag(std::string(kHelpShort) + "," + std::string(kHelpOption));
  fill(app, program, argc > 1 ? argv[1] : "");
  bool is_for_help = false;
  std::string complaint;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    is_for_help = true;
  } catch (const CLI::ArgumentMismatch& error) {
    complaint = complaint_of_count(error);
  } catch (const CLI::ConversionError& error) {
    complaint = complaint_of_flag(error);
  } catch (const CLI::ParseError& error) {
    complaint = error.what();
  }
  const Named named = innermost({{program, program.name}, &app});
  require_known_words(named.verb, app);
  if (!complaint.empty()) throw UsageError(complaint, named.verb.path);
  require_compatible(named.verb, *named.app);
  return {named.verb, is_for_help};
}

}  // namespace earthtop::tool
