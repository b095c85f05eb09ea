// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace earthtop {

Utf8Character first_character(std::string_view text) {
  if (text.empty()) return {};
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || length > text.size()) return {};
  char32_t code = lead & (0x7Fu >> length);
  for (std::size_t k = 1; k < length; ++k) {
    const auto next = static_cast<unsigned char>(text[k]);
    if ((next & 0xC0) != 0x80) return {};
    code = (code << 6) | (next & 0x3Fu);
  }
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < kLeast[length] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
  return {code, length};
}

std::size_t first_invalid_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    // Most texts are ASCII, of which many bytes are seen at a glance.
    for (std::array<std::uint64_t, 8> bytes; i + sizeof bytes <= text.size(); i += sizeof bytes) {
      std::memcpy(bytes.data(), text.data() + i, sizeof bytes);
      std::uint64_t all = 0;
      for (const std::uint64_t eight : bytes) all |= eight;
      if ((all & 0x8080808080808080U) != 0) break;
    }
    if (i == text.size()) break;
    const std::size_t length = first_character(text.substr(i)).length;
    if (length == 0) return i;
    i += length;
  }
  return std::string_view::npos;
}

void append_utf8(char32_t code, std::string& out) {
  const auto byte = [&](char32_t bits) { out += static_cast<char>(static_cast<unsigned char>(bits)); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | (code >> 6));
    byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | (code >> 12));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | (code >> 18));
    byte(0x80 | ((code >> 12) & 0x3F));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  }
}

bool is_unseen(char32_t code) {
  if (code >= 0x20 && code < 0x7F) return false;  // most texts are ASCII
  struct Span {
    char32_t first, last;
  };
  // Unicode 15: Default_Ignorable_Code_Point, and the general categories Cc, Zl and Zp.
  constexpr Span kSpans[] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0xAD, 0xAD},       {0x34F, 0x34F},     {0x61C, 0x61C},
                             {0x115F, 0x1160}, {0x17B4, 0x17B5}, {0x180B, 0x180F},   {0x200B, 0x200F},   {0x2028, 0x202E},
                             {0x2060, 0x206F}, {0x3164, 0x3164}, {0xFDD0, 0xFDEF},   {0xFE00, 0xFE0F},   {0xFEFF, 0xFEFF},
                             {0xFFA0, 0xFFA0}, {0xFFF0, 0xFFFB}, {0x1BCA0, 0x1BCA3}, {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF}};
  for (const Span& span : kSpans)
    if (code >= span.first && code <= span.last) return true;
  return (code & 0xFFFE) == 0xFFFE;  // the last two code points of each plane are not characters
}

void append_escape(char32_t code, std::string& out) {
  if (code < 0x10000) {
    fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(code));
    return;
  }
  const auto rest = static_cast<unsigned>(code - 0x10000);
  fmt::format_to(std::back_inserter(out), "\\u{:04x}\\u{:04x}", 0xD800 + (rest >> 10U), 0xDC00 + (rest & 0x3FFU));
}

std::string json_with_escapes(std::string_view document) {
  std::string text;
  text.reserve(document.size());
  while (!document.empty()) {
    const auto [code, length] = first_character(document);
    // Line ends and spaces between values are ASCII, and within its strings a JSON document has no ASCII control character
    // except DEL.
    if (length > 0 && code >= 0x7F && is_unseen(code))
      append_escape(code, text);
    else
      text += document.substr(0, std::max<std::size_t>(length, 1));
    document.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text;
}

}  // namespace earthtop
