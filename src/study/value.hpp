/// A cell of a study's table: nothing (absent, or not finite), a number, or a word.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

namespace earthtop::study {

using Value = std::variant<std::monostate, double, std::string>;

/// Of JSON; what is neither number nor string stays JSON.
Value value_of(const nlohmann::ordered_json& json);

/// The shortest digits that read back to the same bits; a word quoted where CSV needs it (RFC 4180); empty for nothing.
std::string csv_cell(const Value& value);

}  // namespace earthtop::study
