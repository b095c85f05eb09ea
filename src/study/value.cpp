// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/value.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "text/json.hpp"
#include "text/utf8.hpp"

namespace earthtop::study {

Value value_of(const nlohmann::ordered_json& json) {
  if (json.is_number()) {
    const auto number = json.get<double>();
    return std::isfinite(number) ? Value(number) : Value();
  }
  if (json.is_null()) return {};
  if (json.is_string()) return json.get<std::string>();
  return written_replacing(json);
}

Value read_value(std::string_view json) { return value_of(json_of(json)); }

std::string plain_text(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  const auto* word = std::get_if<std::string>(&value);
  return word ? *word : "";
}

namespace {

/// Whether a spreadsheet would take a word for a formula and evaluate it. A number written as a word is not a formula.
bool looks_like_formula(std::string_view word) {
  if (word.empty() || std::string_view("=+-@\t\r\n").find(word.front()) == std::string_view::npos) return false;
  const std::string_view unsigned_part = word.substr(1);
  double number = 0;
  const auto [end, error] = std::from_chars(unsigned_part.data(), unsigned_part.data() + unsigned_part.size(), number);
  const bool is_number = error == std::errc() && end == unsigned_part.data() + unsigned_part.size() &&
                         (word.front() == '+' || word.front() == '-') &&
                         std::string_view("0123456789.").find(unsigned_part.front()) != std::string_view::npos;
  return !is_number;
}

}  // namespace

std::string csv_cell(const Value& value) {
  const auto* word = std::get_if<std::string>(&value);
  if (!word) return plain_text(value);
  const bool formula = looks_like_formula(*word);
  std::string shown = formula ? "'" : "";
  for (std::string_view rest = *word; !rest.empty();) {
    const auto [code, length] = first_character(rest);
    const bool is_space = code == '\t' || code == '\n' || code == '\r';
    if (length == 0 || (is_unseen(code) && !is_space))
      append_escape(length == 0 ? U'\uFFFD' : code, shown);
    else
      shown += rest.substr(0, length);
    rest.remove_prefix(std::max<std::size_t>(length, 1));
  }
  if (!formula && shown.find_first_of(",\"\r\n") == std::string::npos) return shown;
  std::string quoted = "\"";
  for (const char c : shown) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace earthtop::study
