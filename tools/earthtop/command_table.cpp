// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "command_line.hpp"

namespace earthtop::tool {

bool Option::excludes(const Option& other) const {
  return (!group.empty() && group == other.group) ||
         std::find(conflicts.begin(), conflicts.end(), other.name) != conflicts.end();
}

Option& Option::abbreviated(std::string_view text) {
  short_name = text;
  return *this;
}

Option& Option::called(std::string_view text) {
  value = text;
  return *this;
}

Option& Option::required() {
  is_required = true;
  return *this;
}

Option& Option::with_commas() {
  has_commas = true;
  return *this;
}

Option& Option::json_file() {
  is_json_file = true;
  return *this;
}

Option& Option::within(double low, double high) {
  range = Range{low, high};
  return *this;
}

Option& Option::completed_to(std::vector<std::string> list) {
  words = std::move(list);
  return *this;
}

Option& Option::one_of(std::vector<std::string> list) {
  has_other_words = false;
  return completed_to(std::move(list));
}

Option& Option::in_group(std::string_view title) {
  group = title;
  return *this;
}

Option& Option::without(std::string_view other) {
  conflicts.emplace_back(other);
  return *this;
}

Verb::Verb(std::string_view its_name, std::string_view one_line, Action what_it_does)
    : name(its_name), help(one_line), action(std::move(what_it_does)) {}

Option& Verb::add(std::string_view option, Target target, std::string_view option_help) {
  Option added;
  added.name = option;
  added.target = target;
  added.help = option_help;
  return options.emplace_back(std::move(added));
}

void Verb::describe(std::string_view sentences) { description = sentences; }

void Verb::example(std::string_view command, std::string_view purpose) {
  examples.push_back({std::string(command), std::string(purpose)});
}

void Verb::ends_with(ExitStatus status, std::string_view meaning) { statuses.push_back({status, std::string(meaning)}); }

std::vector<std::pair<std::string_view, std::string_view>> Verb::exit_statuses() const {
  std::vector<std::pair<std::string_view, std::string_view>> all;
  for (const StatusMeaning& general : kExitStatuses) {
    const auto own = std::ranges::find(statuses, general.status, &VerbStatus::status);
    const std::string_view meaning = own != statuses.end() ? std::string_view(own->meaning) : general.of_a_verb;
    if (!meaning.empty()) all.emplace_back(general.shown, meaning);
  }
  return all;
}

}  // namespace earthtop::tool
