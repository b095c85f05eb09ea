// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/text_edit.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "earthtop/error.hpp"
#include "input/pointers.hpp"
#include "input/reader.hpp"
#include "text/json.hpp"

namespace earthtop::input {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// A part of the text.
struct Span {
  std::size_t begin = 0, end = 0;
};
/// A member of an object, or an element of an array, whose key is empty.
struct Member {
  Span key, value;
};

/// Walks over a text that is known to be JSON.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::size_t past_space(std::size_t at) const {
    while (at < text_.size() && is_space(text_[at])) ++at;
    return at;
  }

  /// The end of the value that begins at `at`.
  std::size_t past_value(std::size_t at) const {
    if (text_[at] == '"') return past_string(at);
    if (text_[at] != '{' && text_[at] != '[') {
      while (at < text_.size() && !is_space(text_[at]) && text_[at] != ',' && text_[at] != '}' && text_[at] != ']') ++at;
      return at;
    }
    for (std::size_t depth = 0; at < text_.size();) {
      if (text_[at] == '"') {
        at = past_string(at);
        continue;
      }
      if (text_[at] == '{' || text_[at] == '[') ++depth;
      if ((text_[at] == '}' || text_[at] == ']') && --depth == 0) return at + 1;
      ++at;
    }
    return at;
  }

  /// The members of the object, or the elements of the array, that begins at `at`.
  std::vector<Member> members(std::size_t at) const {
    std::vector<Member> list;
    const bool has_keys = text_[at] == '{';
    for (at = past_space(at + 1); at < text_.size() && text_[at] != '}' && text_[at] != ']';) {
      Member member;
      if (has_keys) {
        member.key = {at, past_string(at)};
        at = past_space(past_space(member.key.end) + 1);  // the colon
      }
      member.value = {at, past_value(at)};
      list.push_back(member);
      at = past_space(member.value.end);
      if (at < text_.size() && text_[at] == ',') at = past_space(at + 1);
    }
    return list;
  }

  std::string word(Span span) const { return json_of(text_.substr(span.begin, span.end - span.begin)).get<std::string>(); }

 private:
  std::size_t past_string(std::size_t at) const {
    for (++at; at < text_.size() && text_[at] != '"'; ++at)
      if (text_[at] == '\\') ++at;
    return at + 1;
  }

  std::string_view text_;
};

/// Whether a value is JSON; otherwise it is a string. @throws ScenarioError for a value that an override may not have, either
bool is_json(std::string_view value, std::string_view pointer) {
  Findings findings;
  JsonKind kind = JsonKind::null;
  const ReadOutcome outcome = check_json(value, findings, {.noun = "value"}, kind);
  if (outcome == ReadOutcome::refused) throw ScenarioError(std::string(pointer), findings.errors(value).front().message);
  return outcome == ReadOutcome::complete;
}

std::string quoted(const std::string& word) { return written(nlohmann::ordered_json(word)); }

/// A value that is reached by the remaining tokens from a place where nothing is: objects in one another.
std::string nested(const std::vector<std::string>& tokens, std::size_t from, const std::string& value) {
  std::string text = value;
  for (std::size_t k = tokens.size(); k-- > from;) text = fmt::format("{{ {}: {} }}", quoted(tokens[k]), text);
  return text;
}

/// Adds a member to the object at `begin`, laid out as its last member is.
std::string with_member(std::string_view text, std::size_t begin, const std::vector<Member>& members, const std::string& key,
                        const std::string& value) {
  const std::string member = fmt::format("{}: {}", quoted(key), value);
  std::string result(text);
  if (members.empty()) {
    const std::size_t end = Scanner(text).past_space(begin + 1);
    return result.replace(begin + 1, end - begin - 1, fmt::format(" {} ", member));
  }
  // The text between the last member and the comma or brace before it is the layout.
  std::size_t space = members.back().key.begin;
  while (space > 0 && is_space(text[space - 1])) --space;
  const std::string_view layout = text.substr(space, members.back().key.begin - space);
  return result.insert(members.back().value.end, fmt::format(",{}{}", layout.empty() ? " " : layout, member));
}

/// Where the outermost value begins, behind a byte order mark.
std::size_t outermost(std::string_view text) { return Scanner(text).past_space(text.starts_with("\xEF\xBB\xBF") ? 3 : 0); }

}  // namespace

std::string without_member(std::string_view text, std::string_view pointer) {
  const auto tokens = tokens_of(pointer);
  const Scanner scanner(text);
  std::size_t at = outermost(text);
  std::string result(text);
  if (!tokens || tokens->empty()) return result;
  for (std::size_t depth = 0; at < text.size() && text[at] == '{'; ++depth) {
    const std::vector<Member> members = scanner.members(at);
    const auto found = std::find_if(members.begin(), members.end(),
                                    [&](const Member& member) { return scanner.word(member.key) == (*tokens)[depth]; });
    if (found == members.end()) break;
    at = found->value.begin;
    if (depth + 1 < tokens->size()) continue;
    // With the comma and the layout before it; the first member, with those behind it.
    const bool is_first = found == members.begin();
    const std::size_t begin = is_first ? found->key.begin : (found - 1)->value.end;
    const std::size_t end = is_first && members.size() > 1 ? members[1].key.begin : found->value.end;
    return result.erase(begin, end - begin);
  }
  return result;
}

std::string with_value(std::string_view text, std::string_view pointer, std::string_view given) {
  const auto no_place = [&] {
    return ScenarioError(std::string(pointer), "does not lead to a value in the scenario's text that can be changed");
  };
  const auto tokens = tokens_of(pointer);
  if (!tokens || tokens->empty()) throw no_place();
  const std::string value = is_json(given, pointer) ? std::string(given) : quoted(std::string(given));
  const Scanner scanner(text);
  std::size_t at = outermost(text);
  for (std::size_t k = 0; k < tokens->size(); ++k) {
    if (at >= text.size() || (text[at] != '{' && text[at] != '[')) throw no_place();
    const std::string& token = (*tokens)[k];
    const std::vector<Member> members = scanner.members(at);
    std::optional<Span> found;
    if (text[at] == '{') {
      for (const Member& member : members)
        if (scanner.word(member.key) == token) found = member.value;
      if (!found) return with_member(text, at, members, token, nested(*tokens, k + 1, value));
    } else {
      const auto index = array_index(token, members.size());
      if (!index) throw no_place();
      found = members[*index].value;
    }
    if (k + 1 == tokens->size()) return std::string(text).replace(found->begin, found->end - found->begin, value);
    at = found->begin;
  }
  throw no_place();
}

}  // namespace earthtop::input
