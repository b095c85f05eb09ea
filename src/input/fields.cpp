// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/fields.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace earthtop::input {

const Field* FieldTable::find(std::string_view pattern) const {
  for (const Field& field : fields)
    if (field.pointer == pattern) return &field;
  return nullptr;
}

std::vector<std::string_view> FieldTable::keys_below(std::string_view pattern) const {
  std::vector<std::string_view> keys;
  for (const Field& field : fields)
    if (field.parent() == pattern && field.key() != "*") keys.push_back(field.key());
  return keys;
}

const Wish* FieldTable::wish(std::string_view lower_case_key) const {
  const std::string key = fmt::format("_{}_", lower_case_key);
  for (const Wish& wish : wishes)
    for (const std::string_view word : split_words(wish.words))
      if (key.find(fmt::format("_{}_", word)) != std::string::npos || key.find(fmt::format("_{}s_", word)) != std::string::npos)
        return &wish;
  return nullptr;
}

std::vector<std::string_view> split_words(std::string_view words) {
  std::vector<std::string_view> list;
  while (!words.empty()) {
    list.push_back(words.substr(0, words.find('|')));
    words.remove_prefix(std::min(list.back().size() + 1, words.size()));
  }
  return list;
}

bool lists(std::string_view words, std::string_view word) {
  const auto list = split_words(words);
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string range_text(const Range& range) {
  const auto end = [](double x) {
    const std::string brief = fmt::format("{:g}", x);
    return std::abs(x) >= 1e6 && std::strtod(brief.c_str(), nullptr) == x ? brief : fmt::format("{}", x);
  };
  if (std::isinf(range.least) && std::isinf(range.most)) return "";
  if (std::isinf(range.most)) return fmt::format("{} {}", range.least_excluded ? "above" : "of at least", end(range.least));
  if (range.least_excluded) return fmt::format("above {} and at most {}", end(range.least), end(range.most));
  return fmt::format("from {} to {}", end(range.least), end(range.most));
}

namespace {

std::string quoted_words(std::string_view words) {
  std::string list;
  for (const std::string_view w : split_words(words)) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", w);
  return list;
}

std::string numbers_text(std::string_view what, const Field& field) {
  std::string allowed(what);
  if (const std::string range = range_text(field.range); !range.empty()) allowed += " " + range;
  if (!field.unit.empty()) allowed += fmt::format(" ({})", field.unit);
  return allowed;
}

}  // namespace

std::string allowed_values(const Field& field) {
  using enum FieldKind;
  switch (field.kind) {
    case object: return "an object {...}";
    case object_or_word: return field.words.empty() ? "an object {...}" : quoted_words(field.words) + ", or an object {...}";
    case flag_or_object:
      return fmt::format("true, false{}{}, or an object {{...}}", field.words.empty() ? "" : ", ", quoted_words(field.words));
    case list: return "an array of at least one object";
    case text: return "a string";
    case name: return "a string of 1 to 64 of a-z, 0-9 and '-', not beginning with '-'";
    case word: return quoted_words(field.words);
    case flag: return "true or false";
    case number: return numbers_text("a number", field);
    case number_or_vector3: return numbers_text("a number, or an array of 3 numbers", field);
    case vector2: return numbers_text("an array of 2 numbers", field);
    case vector3: return numbers_text("an array of 3 numbers", field);
    case matrix3: return numbers_text("an array of 3 rows of 3 numbers", field);
    case numbers: return numbers_text("an array of 1 to 4 numbers", field);
    case series: return numbers_text("an array of 1 to 1000 numbers", field);
    case points: return numbers_text("an array of 1 to 1000 rows of 3 numbers", field);
    case changes: return "an array of \"/json/pointer=value\"";
    case anything: return "given";
  }
  return "";
}

}  // namespace earthtop::input
