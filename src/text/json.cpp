// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/json.hpp"

#include <nlohmann/json.hpp>

namespace earthtop {

using Json = nlohmann::ordered_json;

Json json_of(std::string_view text) { return Json::parse(text); }

std::string written(const Json& json, int indent) { return json.dump(indent); }
std::string written_replacing(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::uint64_t count_in(const Json& json) {
  if (!json.is_number_unsigned()) throw Json::type_error::create(302, "no whole number of at least 0", &json);
  return json.get<std::uint64_t>();
}

Json or_nothing(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

}  // namespace earthtop
