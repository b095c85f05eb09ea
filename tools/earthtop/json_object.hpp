// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON that the program puts together or looks into, without the library for it: that takes a second to compile.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace earthtop::tool {

/// An object, key by key in the order in which they are put.
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
  /// A number or a truth value; what is not finite becomes null.
  template <class Number>
  requires std::is_arithmetic_v<Number> JsonObject& put(std::string_view key, Number number);

  /// In ASCII with a final newline: what cannot be seen, or turns a terminal's text round, stands as an escape.
  std::string text() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// The keys of a text that is one JSON object; none of any other text.
std::vector<std::string> json_keys(std::string_view text);

}  // namespace earthtop::tool
