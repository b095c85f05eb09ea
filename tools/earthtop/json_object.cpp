// SPDX-License-Identifier: GPL-3.0-or-later
#include "json_object.hpp"

#include <nlohmann/json.hpp>

namespace earthtop::tool {

using Json = nlohmann::ordered_json;

struct JsonObject::Content {
  Json json = Json::object();
};

JsonObject::JsonObject() : content_(std::make_unique<Content>()) {}
JsonObject::~JsonObject() = default;
JsonObject::JsonObject(JsonObject&& other) noexcept = default;
JsonObject& JsonObject::operator=(JsonObject&& other) noexcept = default;

JsonObject& JsonObject::put(std::string_view key, std::string_view text) {
  content_->json[std::string(key)] = text;
  return *this;
}

JsonObject& JsonObject::put(std::string_view key, const std::vector<std::string>& texts) {
  content_->json[std::string(key)] = texts;
  return *this;
}

JsonObject& JsonObject::put(std::string_view key, const std::vector<JsonObject>& objects) {
  Json& list = content_->json[std::string(key)] = Json::array();
  for (const JsonObject& object : objects) list.push_back(object.content_->json);
  return *this;
}

JsonObject& JsonObject::put(std::string_view key, const JsonObject& object) {
  content_->json[std::string(key)] = object.content_->json;
  return *this;
}

JsonObject& JsonObject::put_null(std::string_view key) {
  content_->json[std::string(key)] = nullptr;
  return *this;
}

JsonObject& JsonObject::put_json(std::string_view key, std::string_view json) {
  content_->json[std::string(key)] = Json::parse(json);
  return *this;
}

template <class Number>
requires std::is_arithmetic_v<Number> JsonObject& JsonObject::put(std::string_view key, Number number) {
  content_->json[std::string(key)] = number;
  return *this;
}
template JsonObject& JsonObject::put(std::string_view, bool);
template JsonObject& JsonObject::put(std::string_view, int);
template JsonObject& JsonObject::put(std::string_view, unsigned long);
template JsonObject& JsonObject::put(std::string_view, unsigned long long);
template JsonObject& JsonObject::put(std::string_view, double);

std::string JsonObject::text() const { return content_->json.dump(2, ' ', true, Json::error_handler_t::replace) + '\n'; }

std::vector<std::string> json_keys(std::string_view text) {
  std::vector<std::string> keys;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_object())
    for (const auto& entry : json.items()) keys.push_back(entry.key());
  return keys;
}

}  // namespace earthtop::tool
