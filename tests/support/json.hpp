// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON for the tests. Reading, writing and printing it are compiled once, in json.cpp; each source that did so by itself would
/// take two seconds more to compile.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

namespace earthtop::testing {

nlohmann::json parse_json(const std::string& text);
nlohmann::ordered_json parse_ordered_json(const std::string& text);  ///< keeps the order of members
bool is_json(const std::string& text);
std::string text_of(const nlohmann::json& value);
std::string text_of(const nlohmann::ordered_json& value);
std::string read_file(const std::string& name);  ///< throws if there is no such file

}  // namespace earthtop::testing

namespace nlohmann {

void PrintTo(const json& value, std::ostream* out);  // what GoogleTest prints it by
void PrintTo(const ordered_json& value, std::ostream* out);

}  // namespace nlohmann
