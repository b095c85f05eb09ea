#include "study/value.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace earthtop::study {

Value value_of(const nlohmann::ordered_json& json) {
  if (json.is_number()) {
    const auto number = json.get<double>();
    return std::isfinite(number) ? Value(number) : Value();
  }
  if (json.is_null()) return {};
  if (json.is_string()) return json.get<std::string>();
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string csv_cell(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  const auto* word = std::get_if<std::string>(&value);
  if (!word) return "";
  if (word->find_first_of(",\"\r\n") == std::string::npos) return *word;
  std::string quoted = "\"";
  for (const char c : *word) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace earthtop::study
