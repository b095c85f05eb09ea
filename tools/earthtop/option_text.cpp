// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_text.hpp"

#include <fmt/core.h>

#include "command_line.hpp"

namespace earthtop::tool {
namespace {

/// Names of the options that may not be given together with this one, whichever of the two states it.
std::vector<std::string> conflicts_of(const Option& option, const Verb& verb) {
  std::vector<std::string> conflicts;
  for (const Option& other : verb.options)
    if (&other != &option && (option.excludes(other) || other.excludes(option))) conflicts.push_back(other.name);
  return conflicts;
}

/// "1e9" rather than "1e+09".
std::string short_number(double value) {
  std::string text = fmt::format("{:g}", value);
  for (const std::string_view more : {"+0", "+"})
    if (const std::size_t at = text.find(more); at != std::string::npos) text.erase(at, more.size());
  if (const std::size_t at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
  return text;
}

}  // namespace

std::string comma_list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string option_meaning(const Option& option, const Verb& verb) {
  std::string text = option.help;
  if (!option.words.empty() && !option.has_other_words) text += "; one of " + comma_list(option.words);
  if (option.range) text += "; from " + short_number(option.range->low) + " to " + short_number(option.range->high);
  if (const auto conflicts = conflicts_of(option, verb); !conflicts.empty()) text += "; not with " + comma_list(conflicts);
  return text;
}

}  // namespace earthtop::tool
