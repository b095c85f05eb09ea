// SPDX-License-Identifier: GPL-3.0-or-later
#include "unknown_words.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "command_line.hpp"
#include "earthtop/error.hpp"
#include "input/suggest.hpp"
#include "option_text.hpp"

namespace earthtop::tool {
namespace {

/// An option's name without its dashes, whose misspelling is then judged by its letters.
std::string_view bare(std::string_view name) { return name.substr(std::min(name.find_first_not_of('-'), name.size())); }

/// "; did you mean ...?" if one of the words is near.
std::string suggestion(std::string_view given, const std::vector<std::string_view>& words, std::string_view dashes = "") {
  const auto meant = input::suggest(given, words);
  return meant ? fmt::format("; did you mean \"{}{}\"?", dashes, *meant) : "";
}

std::string complaint_of_option(const NamedVerb& named, std::string_view argument) {
  const std::string_view given = argument.substr(0, argument.find('='));
  std::vector<std::string_view> names = {bare(kHelpOption)};
  for (const Option& option : named.verb.options)
    if (!option.is_operand()) names.push_back(bare(option.name));
  return fmt::format("{} has no option \"{}\"{}", named.path, printable(given), suggestion(bare(given), names, "--"));
}

/// Words that are looked for, and the verb that does what they mean.
struct OtherWord {
  std::string_view words, command, purpose;
};
constexpr OtherWord kOtherWords[] = {
    {"plot draw picture animate show view", "earthtop report DIRECTORY", "makes a page with pictures and the top in motion"},
    {"list ls examples", "earthtop example --list", "lists the scenarios that come with the program"},
    {"simulate sim predict start", "earthtop run SCENARIO", "predicts a motion"},
    {"fit measure estimate", "earthtop compare SCENARIO DATA --estimate NAME", "fits a scenario to data"},
    {"validate lint", "earthtop check SCENARIO", "finds what is wrong in a scenario"},
    {"init new create template", "earthtop example > top.json", "writes a scenario to begin with"}};

std::string complaint_of_verb(const NamedVerb& outer, std::string_view word) {
  if (outer.path == outer.verb.name)
    for (const OtherWord& other : kOtherWords)
      if ((" " + std::string(other.words) + " ").find(" " + std::string(word) + " ") != std::string::npos)
        return fmt::format("there is no verb \"{}\"; {} {}", printable(word), other.command, other.purpose);
  std::vector<std::string_view> names;
  for (const Verb& verb : outer.verb.verbs) names.push_back(verb.name);
  return fmt::format("there is no verb \"{}\"{}", printable(word), suggestion(word, names));
}

bool has_operands(const Verb& verb) {
  return std::any_of(verb.options.begin(), verb.options.end(), [](const Option& option) { return option.is_operand(); });
}

}  // namespace

std::string complaint_of_unknown(const NamedVerb& named, std::string_view argument) {
  if (argument.starts_with('-')) return complaint_of_option(named, argument);
  if (!named.verb.verbs.empty() && !has_operands(named.verb)) return complaint_of_verb(named, argument);
  return fmt::format("{} does not take \"{}\"{}", named.path, printable(argument),
                     has_operands(named.verb) ? " beside its other operands" : "");
}

std::string complaint_of_word(std::string_view given, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), given) != words.end()) return "";
  return fmt::format("\"{}\" is not one of {}{}", printable(given), comma_list(words),
                     suggestion(given, {words.begin(), words.end()}));
}

NamedVerb find_verb(const Verb& program, const std::vector<std::string>& words) {
  const Verb* verb = &program;
  std::string path = program.name;
  for (const std::string& word : words) {
    const auto found = std::ranges::find(verb->verbs, word, &Verb::name);
    if (found == verb->verbs.end()) throw UsageError(complaint_of_verb({*verb, path}, word), path);
    verb = &*found;
    path += ' ' + word;
  }
  return {*verb, path};
}

}  // namespace earthtop::tool
