// SPDX-License-Identifier: GPL-3.0-or-later
/// A table of fields for editors (JSON Schema) and for people (Markdown).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "input/fields.hpp"

namespace earthtop::input {

/// The rules of an object that involve more than one of its keys, as an array of schemas; empty where there are none.
/// @param pattern  of the object
using SchemaRules = nlohmann::ordered_json (*)(std::string_view pattern);

/// JSON Schema (draft 7) of a file of the table. @param about  what the file says, in sentences
std::string schema(const FieldTable& table, std::string_view about, SchemaRules rules = nullptr);

/// Every key with its unit, range, default and meaning, as a Markdown table.
std::string reference_markdown(const FieldTable& table);

}  // namespace earthtop::input
