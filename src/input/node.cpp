// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/node.hpp"

#include <fmt/core.h>

namespace earthtop::input {

std::string_view name_of(JsonKind kind) {
  switch (kind) {
    case JsonKind::null: return "null";
    case JsonKind::boolean: return "true or false";
    case JsonKind::number: return "a number";
    case JsonKind::string: return "a string";
    case JsonKind::array: return "an array";
    case JsonKind::object: return "an object";
    case JsonKind::refused: break;
  }
  return "not a JSON value";
}

std::string excerpt(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return std::string(text);
  while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xC0) == 0x80) --limit;  // do not cut inside a UTF-8 character
  return std::string(text.substr(0, limit)) + "...";
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMostListed = 100, kMostBytes = 600;
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == kMostListed || text.size() > kMostBytes) return fmt::format("{} and {} more", text, names.size() - i);
    text += (i > 0 ? ", " : "") + excerpt(names[i]);
  }
  return text;
}

std::string pointer_step(std::string_view key) {
  std::string step = "/";
  for (const char c : excerpt(key, 80)) {
    if (c == '~')
      step += "~0";
    else if (c == '/')
      step += "~1";
    else
      step += c;
  }
  return step;
}

}  // namespace earthtop::input
