// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes and inspects simple JSON without the JSON library, which takes a second to compile in each source.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace earthtop::tool {

/// A JSON object; its keys keep the order in which they were put.
class JsonObject {
 public:
  JsonObject();
  ~JsonObject();
  JsonObject(JsonObject&& other) noexcept;
  JsonObject& operator=(JsonObject&& other) noexcept;

  JsonObject& put(std::string_view key, std::string_view text);
  JsonObject& put(std::string_view key, const char* text) { return put(key, std::string_view(text)); }
  JsonObject& put(std::string_view key, const std::vector<std::string>& texts);
  JsonObject& put(std::string_view key, const std::vector<JsonObject>& objects);
  JsonObject& put(std::string_view key, const JsonObject& object);
  JsonObject& put_null(std::string_view key);
  /// Puts a text that is JSON.
  JsonObject& put_json(std::string_view key, std::string_view json);
  /// Puts a number or a truth value; a number that is not finite becomes null.
  template <class Number>
  requires std::is_arithmetic_v<Number> JsonObject& put(std::string_view key, Number number);

  /// The object as text in ASCII, with a final newline. Characters that are invisible or reverse a terminal's writing direction
  /// are escaped.
  std::string text() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// The keys of a text that is one JSON object; empty for any other text.
std::vector<std::string> json_keys(std::string_view text);

}  // namespace earthtop::tool
