// SPDX-License-Identifier: GPL-3.0-or-later
#include "roff.hpp"

namespace earthtop::tool {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
bool ends_sentence(std::string_view word) { return word.ends_with('.') && word != "e.g." && word != "i.e."; }

std::string escaped(char c) {
  switch (c) {
    case '\\': return "\\e";
    case '^': return "\\(ha";
    case '~': return "\\(ti";
    case '`': return "\\(ga";
    default: return {c};
  }
}

/// Protects a point or quote at the beginning of a line, which roff would take for a request.
std::string as_line(std::string line) {
  if (!line.empty() && (line.front() == '.' || line.front() == '\'')) line.insert(0, "\\&");
  return line;
}

std::string word(std::string_view text) {
  const std::size_t first = text.find_first_not_of("([\"");
  if (first != std::string_view::npos && text[first] == '-') return roff_literal(text);
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool joins_words = text[i] == '-' && i > 0 && i + 1 < text.size() && is_letter(text[i - 1]) && is_letter(text[i + 1]);
    result += text[i] == '-' && !joins_words ? "\\-" : escaped(text[i]);
  }
  return result;
}

}  // namespace

std::string roff_literal(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '-' ? "\\-" : c == '\'' ? "\\(aq" : escaped(c);
  return as_line(result);
}

std::string roff_text(std::string_view text) {
  std::string result, line;
  while (!text.empty()) {
    const std::size_t end = text.find(' ');
    const std::string_view first = text.substr(0, end);
    line += word(first);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (text.empty() || (ends_sentence(first) && is_capital(text.front()))) {
      result += as_line(line) + '\n';
      line.clear();
    } else {
      line += ' ';
    }
  }
  return result;
}

}  // namespace earthtop::tool
