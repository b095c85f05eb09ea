// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/svg_text.hpp"

#include "text/utf8.hpp"

namespace earthtop {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
constexpr std::string_view kJoints = "_./";  // a name without spaces may be broken after these

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

std::string escape_xml(std::string_view text) {
  std::string escaped;
  while (!text.empty()) {
    const auto [code, size] = first_character(text);
    const bool is_space = code == '\t' || code == '\n' || code == '\r';
    if (size == 0) {
      escaped += kReplacement;
      text.remove_prefix(1);
      continue;
    }
    if (is_unseen(code) && !is_space) {
      append_escape(code, escaped);
      text.remove_prefix(size);
      continue;
    }
    switch (text[0]) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '"': escaped += "&quot;"; break;
      case '\'': escaped += "&#39;"; break;
      default: escaped += text.substr(0, size);
    }
    text.remove_prefix(size);
  }
  return escaped;
}

std::size_t character_count(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) count += continues(c) ? 0 : 1;
  return count;
}

std::string shorten(std::string_view text, std::size_t count) {
  if (character_count(text) <= count) return std::string(text);
  std::size_t end = 0;
  for (std::size_t seen = 0; end < text.size(); ++end)
    if (!continues(text[end]) && seen++ == count - 1) break;
  return std::string(text.substr(0, end)) + "…";
}

std::vector<std::string> lines_of(std::string_view text, std::size_t count, std::size_t most) {
  std::vector<std::string> lines;
  while (lines.size() + 1 < most && character_count(text) > count) {
    std::size_t end = 0, seen = 0, space = text.npos, joint = 0;
    for (; end < text.size() && seen <= count; ++end) {
      if (continues(text[end])) continue;
      if (text[end] == ' ' && end > 0) space = end;
      if (seen < count && kJoints.find(text[end]) != kJoints.npos) joint = end + 1;
      ++seen;
    }
    if (space != text.npos) {
      lines.emplace_back(text.substr(0, space));
      text.remove_prefix(space + 1);
    } else if (joint > 0) {
      lines.emplace_back(text.substr(0, joint));
      text.remove_prefix(joint);
    } else {
      break;  // one long word
    }
  }
  lines.push_back(shorten(text, count));
  return lines;
}

}  // namespace earthtop
