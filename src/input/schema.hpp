// SPDX-License-Identifier: GPL-3.0-or-later
/// Describes a table of fields for editors (JSON Schema) and for people (Markdown).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "input/fields.hpp"

namespace earthtop::input {

/// A function that returns an object's rules that involve several of its keys, as an array of schemas; empty if there are none.
/// @param pattern  pattern of the object
using SchemaRules = nlohmann::ordered_json (*)(std::string_view pattern);

/// Returns the JSON Schema (draft 7) of the table's files. @param about  description of the files, in sentences
std::string schema(const FieldTable& table, std::string_view about, SchemaRules rules = nullptr);

/// Returns a Markdown table of every key with its unit, range, default and meaning.
std::string reference_markdown(const FieldTable& table);

}  // namespace earthtop::input
