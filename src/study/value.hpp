// SPDX-License-Identifier: GPL-3.0-or-later
/// A cell of a study's table: nothing (absent, or not finite), a number, or a word.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <variant>

namespace earthtop::study {

using Value = std::variant<std::monostate, double, std::string>;

/// Of JSON; what is neither number nor string stays JSON.
Value value_of(const nlohmann::ordered_json& json);
/// The same of JSON text.
Value read_value(std::string_view json);

/// The shortest digits that read back to the same bits; a word as it is; empty for nothing.
std::string plain_text(const Value& value);

/// The same as a cell of a CSV file (RFC 4180). A word in which a spreadsheet would see a formula (it begins with = + - @, a
/// tab or a line end, and is no number) gets an apostrophe in front, which spreadsheets take for "this is text"; characters
/// that cannot be seen stand as escapes. Nothing here reads such cells back: stores keep the words as they are.
std::string csv_cell(const Value& value);

}  // namespace earthtop::study
