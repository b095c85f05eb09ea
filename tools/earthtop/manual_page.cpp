// SPDX-License-Identifier: GPL-3.0-or-later
#include "manual_page.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "command_line.hpp"
#include "option_text.hpp"
#include "roff.hpp"

namespace earthtop::tool {
namespace {

std::string bold(std::string_view text) { return "\\fB" + roff_literal(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff_literal(text) + "\\fR"; }

std::string section(std::string_view title) { return fmt::format(".SH {}\n", title); }

std::string paragraph(const std::string& tag, const std::string& text) { return fmt::format(".TP\n{}\n{}", tag, text); }

std::string reference(std::string_view page) { return bold(page) + "(1)"; }

/// An option or operand as it stands on the command line: "--out DIR", "SCENARIO".
std::string usage(const Option& option) {
  if (option.is_operand()) return italic(option.name);
  const std::string name = option.short_name.empty() ? bold(option.name) : bold(option.short_name) + ", " + bold(option.name);
  return option.is_flag() ? name : name + "\\ " + italic(option.value);
}

std::string usages(const Verb& verb, bool operands) {
  std::string text;
  std::string group;
  for (const Option& option : verb.options) {
    if (option.is_operand() != operands) continue;
    const bool goes_on = !option.group.empty() && option.group == group;
    if (!group.empty() && !goes_on) text += "]\n";
    text += goes_on ? " | " : option.is_required ? "" : "[";
    text += usage(option);
    group = option.group;
    if (group.empty()) text += (option.is_required ? "" : "]") + std::string(option.is_repeatable() ? "...\\&\n" : "\n");
  }
  return group.empty() ? text : text + "]\n";
}

/// @param path the words that name the verb: "earthtop study merge"
std::string synopsis(const Verb& verb, const std::string& path) {
  std::string text = bold(path) + '\n' + usages(verb, false) + usages(verb, true);
  for (const Verb& sub : verb.verbs) text += ".br\n" + synopsis(sub, path + " " + sub.name);
  return text;
}

std::string meanings(const Verb& verb, bool operands) {
  std::string text;
  for (const Option& option : verb.options)
    if (option.is_operand() == operands) text += paragraph(usage(option), roff_text(option_meaning(option, verb)));
  return text;
}

std::string help_meaning() { return paragraph(bold(kHelpShort) + ", " + bold(kHelpOption), roff_text(kHelpText)); }

std::string options(const Verb& verb, const std::string& path) {
  std::string text = meanings(verb, true) + meanings(verb, false);
  for (const Verb& sub : verb.verbs) {
    const std::string sub_path = path + " " + sub.name;
    text += fmt::format(".SS {}\n{}", roff_literal(sub_path), roff_text(sub.help)) + options(sub, sub_path);
  }
  return text;
}

std::string exit_statuses(const Verb& verb) {
  std::string text = section("EXIT STATUS");
  for (const auto& [status, meaning] : verb.exit_statuses()) text += paragraph(bold(status), roff_text(meaning));
  return text;
}

std::string examples(const Verb& verb) {
  if (verb.examples.empty()) return "";
  std::string text = section("EXAMPLES");
  for (const auto& [command, purpose] : verb.examples) text += paragraph(bold(command), roff_text(purpose));
  return text;
}

std::string see_also(const Verb& program, const Verb& verb) {
  std::string pages;
  const auto add = [&](const Verb& other) {
    if (&other != &verb) pages += (pages.empty() ? "" : ",\n") + reference(manual_page_name(program, other));
  };
  add(program);
  for (const Verb& other : program.verbs) add(other);
  return section("SEE ALSO") + pages + '\n';
}

/// The verbs in their groups.
std::string verbs_of(const Verb& program) {
  std::string text = section("VERBS"), group;
  for (const Verb& verb : program.verbs) {
    if (verb.group != group) text += fmt::format(".SS {}\n", roff_literal(verb.group));
    group = verb.group;
    text += paragraph(reference(manual_page_name(program, verb)), roff_text(verb.help));
  }
  return text;
}

std::string environment() {
  return section("ENVIRONMENT") +
         paragraph(bold("NO_COLOR"), roff_text("if set and not empty, there are no colours and no line of progress")) +
         paragraph(bold("TERM"), roff_text("if it is dumb, neither")) +
         paragraph(bold("COLUMNS"), roff_text("the width of printed text, instead of the terminal's; from 40 to 120"));
}

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
  return text;
}

}  // namespace

std::string manual_page_name(const Verb& program, const Verb& verb) {
  return &verb == &program ? program.name : program.name + "-" + verb.name;
}

std::string manual_page(const Verb& program, const Verb& verb, std::string_view version) {
  const bool is_program = &verb == &program;
  const std::string name = manual_page_name(program, verb), path = is_program ? program.name : program.name + " " + verb.name;
  // The page has no date: the version tells the page's age, and the same program always prints the same page.
  std::string page = fmt::format(".TH {} 1 \"\" \"{} {}\" \"{}\"\n.nh\n.ad l\n", roff_literal(capitals(name)), program.name,
                                 version, "User Commands");
  page += section("NAME") + roff_literal(name) + " \\- " + roff_text(verb.help);
  page += section("SYNOPSIS");
  if (is_program)
    page += bold(path) + "\n" + italic("VERB") + "\n[" + italic("argument") + "]...\\&\n.br\n" + bold(path) + "\n";
  page += is_program ? usages(verb, false) : synopsis(verb, path);
  page += section("DESCRIPTION") + roff_text(verb.description);
  if (is_program) page += verbs_of(program);
  page += section("OPTIONS") + help_meaning() + (is_program ? meanings(verb, false) : options(verb, path));
  page += exit_statuses(verb);
  if (is_program) page += environment();
  page += examples(verb) + see_also(program, verb);
  return page;
}

}  // namespace earthtop::tool
