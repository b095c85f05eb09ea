// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON documents read and written in one place: to compile a reader and a writer takes longer than most of who wants them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace earthtop {

/// @throws nlohmann::ordered_json::parse_error for a text that is no JSON
nlohmann::ordered_json json_of(std::string_view text);
/// The same for those who ask afterwards: of no JSON the result is discarded (`is_discarded`).
nlohmann::ordered_json json_or_discarded(std::string_view text);

/// @param indent  spaces a level; below 0 all in one line   @throws nlohmann::ordered_json::type_error for a string that is no
/// UTF-8
std::string written(const nlohmann::ordered_json& json, int indent = -1);
/// The same of strings that may be anything: what is no UTF-8 is replaced.
std::string written_replacing(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace earthtop
