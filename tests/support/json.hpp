// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON in the tests. Reading, writing and printing it are compiled once, in json.cpp: every source that does it by itself
/// takes two seconds more to compile.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

namespace earthtop::testing {

nlohmann::json parse_json(const std::string& text);
nlohmann::ordered_json parse_ordered_json(const std::string& text);  ///< members keep their places
bool is_json(const std::string& text);
std::string text_of(const nlohmann::json& value);
std::string text_of(const nlohmann::ordered_json& value);
std::string read_file(const std::string& name);  ///< throws where there is no such file

}  // namespace earthtop::testing

namespace nlohmann {

void PrintTo(const json& value, std::ostream* out);  // what GoogleTest prints it by
void PrintTo(const ordered_json& value, std::ostream* out);

}  // namespace nlohmann
