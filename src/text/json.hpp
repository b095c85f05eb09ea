// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads and writes JSON documents in a single source file: compiling the JSON parser and writer takes longer than compiling
/// most of the files that use them.
#pragma once

#include <cstdint>
#include <exception>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace earthtop {

/// Parses JSON of the program's own making, or checked before: of a text from outside, nlohmann's parser accepts a NUL byte with
/// anything behind it, duplicate keys and any depth. @throws nlohmann::ordered_json::parse_error for a text that is not JSON
nlohmann::ordered_json json_of(std::string_view text);
/// The same for a text that is known to be JSON in which no object has a key twice: members are added without looking for their
/// keys among the others, which would take time with the square of their number.
nlohmann::ordered_json json_of_checked(std::string_view text);

/// @param indent  spaces for each level; negative for a single line   @throws nlohmann::ordered_json::type_error for a string
/// that is not UTF-8
std::string written(const nlohmann::ordered_json& json, int indent = -1);
/// The same for strings that may hold anything: bytes that are not UTF-8 are replaced.
std::string written_replacing(const nlohmann::ordered_json& json, int indent = -1);

/// Refuses a document whose value is not what it must be. @throws nlohmann::ordered_json::type_error
[[noreturn]] void refuse_value(const std::string& what);

/// A whole number that is not negative. @throws nlohmann::ordered_json::type_error for anything else: nlohmann's conversion of a
/// number that is too large for an integer is undefined
std::uint64_t count_in(const nlohmann::ordered_json& json);

/// What an error of nlohmann's says, in words of a reader of the document.
std::string complaint_of(const std::exception& error);

/// The number; null where there is none.
nlohmann::ordered_json or_nothing(const std::optional<double>& number);

}  // namespace earthtop
