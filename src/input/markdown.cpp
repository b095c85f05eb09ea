// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "input/schema.hpp"

namespace earthtop::input {
namespace {

/// Returns text for a table cell, with bars escaped, because a bar would end the cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string value_text(const Field& field) {
  if (field.kind == FieldKind::anything) return "as its meaning says";
  const auto words = split_words(field.words);
  return words.size() > 13 ? fmt::format("one of {} names", words.size()) : cell(allowed_values(field));
}

std::string default_text(const Field& field) {
  if (!field.fallback.empty()) return fmt::format("`{}`", field.fallback);
  return field.required ? "required" : "";
}

}  // namespace

std::string reference_markdown(const FieldTable& table) {
  std::string text = "| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const Field& field : table.fields) {
    if (field.key() == "*" || field.key() == "$schema") continue;
    text += fmt::format("| `{}` | {} | {} | {} |\n", field.pointer.substr(1), value_text(field), default_text(field),
                        cell(field.doc));
  }
  return text;
}

}  // namespace earthtop::input
