// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/json.hpp"

#include <fstream>
#include <iterator>
#include <ostream>
#include <stdexcept>

namespace earthtop::testing {

nlohmann::json parse_json(const std::string& text) { return nlohmann::json::parse(text); }
nlohmann::ordered_json parse_ordered_json(const std::string& text) { return nlohmann::ordered_json::parse(text); }
bool is_json(const std::string& text) { return nlohmann::json::accept(text); }
std::string text_of(const nlohmann::json& value) { return value.dump(); }
std::string text_of(const nlohmann::ordered_json& value) { return value.dump(); }

std::string read_file(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + name);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace earthtop::testing

namespace nlohmann {

void PrintTo(const json& value, std::ostream* out) { *out << value.dump(); }
void PrintTo(const ordered_json& value, std::ostream* out) { *out << value.dump(); }

}  // namespace nlohmann
