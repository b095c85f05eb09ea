// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "option_text.hpp"
#include "wrapped.hpp"

namespace earthtop::tool {
namespace {

/// A list whose terms stand on the left and what they mean on the right, or below where the lines are short.
class List {
 public:
  void add(std::string term, std::string meaning) { entries_.emplace_back("  " + std::move(term), std::move(meaning)); }

  /// The list with its title; nothing if it has no entry.
  std::string text(std::string_view title, std::size_t width) const {
    if (entries_.empty()) return "";
    constexpr std::size_t kGap = 2, kWidest = 28, kRoom = 30, kBelow = 6;
    std::size_t indent = 0;
    for (const auto& [term, meaning] : entries_)
      if (const std::size_t end = columns_of(term) + kGap; end <= kWidest) indent = std::max(indent, end);
    if (indent == 0 || indent + kRoom > width) indent = kBelow;
    std::string lines = '\n' + std::string(title) + '\n';
    for (const auto& [term, meaning] : entries_) lines += wrapped_entry(term, meaning, width, indent);
    return lines;
  }

 private:
  std::vector<std::pair<std::string, std::string>> entries_;
};

/// An option or operand as it stands on the command line: "--out DIR", "SCENARIO".
std::string written(const Option& option) {
  const std::string name = option.short_name.empty() ? option.name : option.short_name + ", " + option.name;
  return option.value.empty() ? name : name + ' ' + option.value;
}

std::string usage_of(const NamedVerb& named) {
  std::string text = named.path;
  const auto& options = named.verb.options;
  for (const Option& option : options)
    if (!option.is_operand() && option.is_required) text += ' ' + written(option);
  text += " [OPTION]...";
  for (const Option& option : options) {
    if (!option.is_operand()) continue;
    const std::string word = option.is_required ? option.name : '[' + option.name + ']';
    text += ' ' + word + (option.is_repeatable() ? "..." : "");
  }
  return text;
}

List operand_list(const Verb& verb) {
  List list;
  for (const Option& option : verb.options)
    if (option.is_operand()) list.add(option.name, option_meaning(option, verb));
  return list;
}

List option_list(const Verb& verb) {
  List list;
  for (const Option& option : verb.options)
    if (!option.is_operand()) list.add(written(option), option_meaning(option, verb));
  list.add(std::string(kHelpShort) + ", " + std::string(kHelpOption), std::string(kHelpText));
  return list;
}

/// Commands are never broken: they are to be copied.
std::string command_list(std::string_view title, const std::vector<CommandExample>& commands, std::size_t width) {
  if (commands.empty()) return "";
  std::string text = '\n' + std::string(title) + '\n';
  for (const auto& [command, purpose] : commands) text += "  " + command + '\n' + wrapped_entry("", purpose, width, 6);
  return text;
}

std::string command_list_of_more(const NamedVerb& named, std::size_t width) {
  const bool is_program = named.path == named.verb.name;
  return command_list("More",
                      {{named.path + " VERB --help", "prints the help of a verb"},
                       {fmt::format("earthtop man {}| man -l -", is_program ? "" : named.verb.name + " "),
                        "shows the same as a page of the manual"}},
                      width);
}

std::string status_list(const Verb& verb, std::size_t width) {
  List list;
  for (const auto& [status, meaning] : verb.exit_statuses()) list.add(std::string(status), std::string(meaning));
  return list.text("Exit status", width);
}

/// The verbs below a verb, in their groups; those without one are below the program's verbs.
std::string verb_lists(const Verb& verb, std::size_t width) {
  std::vector<std::pair<std::string, List>> groups;
  for (const Verb& sub : verb.verbs) {
    const std::string title = sub.group.empty() ? "Verbs" : sub.group;
    if (groups.empty() || groups.back().first != title) groups.emplace_back(title, List());
    groups.back().second.add(sub.name, sub.help);
  }
  std::string text;
  for (const auto& [title, list] : groups) text += list.text(title, width);
  return text;
}

}  // namespace

std::string help_text(const NamedVerb& named, std::size_t width) {
  const Verb& verb = named.verb;
  const bool is_program = named.path == verb.name;
  std::string text = wrapped(named.path + ": " + verb.help, width, named.path.size() + 2) + "\n\n";
  text += wrapped_entry("Usage:", is_program ? named.path + " VERB [ARGUMENT]..." : usage_of(named), width, 7);
  if (!verb.description.empty()) text += '\n' + wrapped(verb.description, width) + '\n';
  if (is_program) text += command_list("To begin", verb.examples, width);
  text += verb_lists(verb, width);
  text += operand_list(verb).text("Operands", width);
  text += option_list(verb).text("Options", width);
  if (!is_program) text += command_list("Examples", verb.examples, width);
  text += status_list(verb, width);
  return verb.verbs.empty() ? text : text + command_list_of_more(named, width);
}

}  // namespace earthtop::tool
