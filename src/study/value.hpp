// SPDX-License-Identifier: GPL-3.0-or-later
/// A cell of a study's table: nothing (absent, or not finite), a number, or a word.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <variant>

namespace earthtop::study {

using Value = std::variant<std::monostate, double, std::string>;

/// The value of a JSON node; anything but a number, a string or null is kept as JSON text.
Value value_of(const nlohmann::ordered_json& json);
/// The same for JSON text.
Value read_value(std::string_view json);

/// A number as the shortest decimal form that reads back as the same double, a word as it is, and "" for nothing.
std::string plain_text(const Value& value);

/// The same as a cell of a CSV file (RFC 4180). A word that a spreadsheet would take for a formula (it begins with = + - @, a
/// tab or a line end, and is not a number) gets an apostrophe in front, which spreadsheets take for "this is text"; invisible
/// characters are written as escapes. The program does not read such cells back: stores keep the words unchanged.
std::string csv_cell(const Value& value);

}  // namespace earthtop::study
