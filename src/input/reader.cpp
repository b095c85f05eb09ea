// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "input/number.hpp"
#include "text/utf8.hpp"

namespace earthtop::input {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

class Reader {
 public:
  Reader(std::string_view text, std::string_view pointer, bool from_set, Findings& findings, const TextKind& kind,
         bool keeps_tree)
      : text_(text), pointer_(pointer), from_set_(from_set), findings_(findings), kind_(kind), keeps_tree_(keeps_tree) {}

  ReadOutcome document(Node& root) {
    if (!encoding() || !value(root, 1)) return outcome_;
    skip_space();
    if (at_ < text_.size())
      stop(at_, fmt::format("text after the end of the {}: {}; one JSON object is allowed", kind_.noun, here()));
    return outcome_;
  }

 private:
  // -- error messages
  Place place(std::size_t offset) const { return {offset, from_set_}; }
  void complain(std::size_t offset, std::string message) { findings_.add(place(offset), pointer_, std::move(message)); }
  bool stop(std::size_t offset, std::string message, ReadOutcome outcome = ReadOutcome::not_json) {
    complain(offset, std::move(message));
    outcome_ = outcome;
    return false;
  }
  /// Returns the current character for messages; one that may be invisible is shown with its number.
  std::string here() const {
    if (at_ >= text_.size()) return "the end of the text";
    const auto [code, length] = first_character(text_.substr(at_));
    const bool seen = code > ' ' && code < 0x7F;
    return seen ? fmt::format("'{}'", text_[at_])
                : fmt::format("'{}' (U+{:04X})", text_.substr(at_, length), static_cast<unsigned>(code));
  }
  std::string unexpected() const { return at_ >= text_.size() ? "the text ends here" : "unexpected " + here(); }

  // -- the text as a whole
  bool encoding() {
    if (text_.size() > kind_.most_bytes)
      return stop(0, fmt::format("the text has {} bytes; at most {} MiB are allowed", text_.size(), kind_.most_bytes >> 20U),
                  ReadOutcome::refused);
    if (const auto other = wide_encoding(); !other.empty())
      return stop(0, fmt::format("the text is in {}; save it as UTF-8, e.g. with iconv -f {} -t UTF-8", other, other),
                  ReadOutcome::refused);
    if (const auto nul = text_.find('\0'); nul != std::string_view::npos)
      return stop(nul, fmt::format("a NUL byte; remove it: a {} is plain UTF-8 text", kind_.noun), ReadOutcome::refused);
    if (const auto bad = first_invalid_utf8(text_); bad != std::string_view::npos)
      return stop(bad,
                  fmt::format("byte 0x{:02x} is not valid UTF-8; save the text as UTF-8",
                              static_cast<unsigned>(static_cast<unsigned char>(text_[bad]))),
                  ReadOutcome::refused);
    return true;
  }

  /// Returns the name of a UTF-16 or UTF-32 encoding, recognised by its byte order mark or by the NUL bytes in the first
  /// character, as every JSON text begins with an ASCII character.
  std::string_view wide_encoding() const {
    using namespace std::string_view_literals;
    if (text_.starts_with("\xFF\xFE\0\0"sv)) return "UTF-32LE";
    if (text_.starts_with("\0\0\xFE\xFF"sv)) return "UTF-32BE";
    if (text_.starts_with("\xFF\xFE"sv)) return "UTF-16LE";
    if (text_.starts_with("\xFE\xFF"sv)) return "UTF-16BE";
    std::string pattern;
    for (const char c : text_.substr(0, 4)) pattern += c == '\0' ? '0' : 'x';
    if (pattern == "x000") return "UTF-32LE";
    if (pattern == "000x") return "UTF-32BE";
    if (pattern == "x0x0" || pattern == "x0") return "UTF-16LE";
    if (pattern == "0x0x" || pattern == "0x") return "UTF-16BE";
    return "";
  }

  // -- tokens
  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r')) ++at_;
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(char c) {
    skip_space();
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  bool value(Node& node, int depth) {
    skip_space();
    node.place = place(at_);
    if (++values_ > kind_.most_values)
      return stop(at_, fmt::format("more than {} values; a {} has far fewer", kind_.most_values, kind_.noun),
                  ReadOutcome::refused);
    const char c = peek();
    if ((c == '{' || c == '[') && depth > kGreatestDepth)
      return stop(at_, fmt::format("nested more than {} levels deep; a {} needs far fewer", kGreatestDepth, kind_.noun),
                  ReadOutcome::refused);
    if (c == '{') return object(node, depth);
    if (c == '[') return array(node, depth);
    if (c == '"') return node.kind = JsonKind::string, string(node.text);
    if (c == '-' || is_digit(c)) return number(node);
    if (is_letter(c)) return literal(node);
    if (c == '+' || c == '.') return stop(at_, "a number begins with a digit or '-'; write 0.5, not .5 or +0.5");
    if (c == '\'') return stop(at_, "single quotes; JSON strings are written in double quotes");
    if (c == '/') return stop(at_, no_comments());
    return stop(at_, unexpected() + "; a JSON value is expected here");
  }

  static std::string no_comments() { return "JSON has no comments; use a key that begins with \"//\" or \"_\""; }

  bool literal(Node& node) {
    const std::size_t start = at_;
    while (is_letter(peek())) ++at_;
    const std::string_view word = text_.substr(start, at_ - start);
    if (word == "true" || word == "false") return node.kind = JsonKind::boolean, node.boolean = word == "true", true;
    if (word == "null") return node.kind = JsonKind::null, true;
    if (is_not_finite(word)) return not_finite(node, start);
    at_ = start;
    return stop(
        start,
        fmt::format(
            "\"{}\" is not a JSON value; strings are written in double quotes, and the literals are true, false and null",
            excerpt(word)));
  }

  static bool is_not_finite(std::string_view word) {
    std::string lower(word);
    for (char& c : lower)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower == "nan" || lower == "inf" || lower == "infinity";
  }
  bool not_finite(Node& node, std::size_t start) {
    complain(start, fmt::format("{} is not a finite number; numbers must be finite", text_.substr(start, at_ - start)));
    outcome_ = ReadOutcome::not_finite;  // the rest of the text can still be read
    node.kind = JsonKind::refused;
    return true;
  }

  bool number(Node& node) {
    const std::size_t start = at_;
    if (peek() == '-') ++at_;
    if (is_letter(peek())) {
      const std::size_t word = at_;
      while (is_letter(peek())) ++at_;
      if (is_not_finite(text_.substr(word, at_ - word))) return not_finite(node, start);
      at_ = word;
    }
    if (!is_digit(peek())) return stop(at_, "'-' must be followed by a digit, not by " + here() + "; write -1");
    if (peek() == '0' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))
      return stop(start, "a number with a leading zero; write it without");
    digits();
    if (peek() == '.') {
      ++at_;
      if (!is_digit(peek()))
        return stop(at_, "a decimal point must be followed by a digit, not by " + here() + "; write 2.0 or 2");
      digits();
    }
    if (peek() == 'e' || peek() == 'E') {
      ++at_;
      if (peek() == '+' || peek() == '-') ++at_;
      if (!is_digit(peek())) return stop(at_, "an exponent needs a digit, not " + here() + "; write 2e5 or 2e-5");
      digits();
    }
    const std::string_view digits_given = text_.substr(start, at_ - start);
    node.kind = JsonKind::number;
    const NumberFit fit = decimal_to_double(digits_given, node.number);
    if (fit == NumberFit::fits) return true;
    node.kind = JsonKind::refused;
    complain(start,
             fmt::format(fmt::runtime(fit == NumberFit::too_large
                                          ? "{} is too large for a double; the largest is 1.7976931348623157e308"
                                          : "{} is too small for a double and would become 0; write 0, or at least 5e-324"),
                         excerpt(digits_given)));
    return true;
  }
  void digits() {
    while (is_digit(peek())) ++at_;
  }

  // -- strings (the bytes have been checked to be UTF-8)
  bool string(std::string& out) {
    const std::size_t start = at_++;
    for (;;) {
      const std::size_t run = at_;
      while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\\' && static_cast<unsigned char>(text_[at_]) >= 0x20)
        ++at_;
      out.append(text_.substr(run, at_ - run));
      if (at_ >= text_.size()) return stop(start, "a string without its closing quote; put '\"' at its end");
      if (text_[at_] == '"') return ++at_, true;
      if (text_[at_] != '\\')
        return stop(at_, "a line break or control character inside a string; close the string, or write \\n, \\t, \\u00XX");
      if (!escape(out)) return false;
    }
  }

  bool escape(std::string& out) {
    const std::size_t start = at_++;
    const char c = peek();
    constexpr std::string_view kLetters = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
    if (const auto i = kLetters.find(c); at_ < text_.size() && i != std::string_view::npos)
      return ++at_, out += kMeanings[i], true;
    if (c != 'u') return stop(start, "an escape that JSON does not have; allowed: \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX");
    ++at_;
    char32_t code = 0;
    if (!hex4(code)) return stop(start, "\\u must be followed by four hexadecimal digits; write \\u00e9");
    if (code >= 0xD800 && code < 0xDC00 && text_.substr(at_).starts_with("\\u")) {
      at_ += 2;
      char32_t low = 0;
      if (!hex4(low) || low < 0xDC00 || low > 0xDFFF)
        return stop(start, "half of a surrogate pair; write both halves, e.g. \\ud83d\\ude00, or the character itself");
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    }
    if (code >= 0xD800 && code < 0xE000)
      return stop(start, "half of a surrogate pair; write both halves, e.g. \\ud83d\\ude00, or the character itself");
    if (code == 0 && !in_comment_) complain(start, "a NUL character in a string; leave it out");
    append_utf8(code, out);
    return true;
  }
  bool hex4(char32_t& code) {
    for (int i = 0; i < 4; ++i, ++at_) {
      const char c = peek();
      const auto digit = std::string_view("0123456789abcdef").find(is_letter(c) ? static_cast<char>(c | 0x20) : c);
      if (at_ >= text_.size() || digit == std::string_view::npos) return false;
      code = code * 16 + static_cast<char32_t>(digit);
    }
    return true;
  }

  // -- containers
  bool array(Node& node, int depth) {
    node.kind = JsonKind::array;
    ++at_;
    if (take(']')) return true;
    const std::size_t parent = pointer_.size();
    for (std::size_t i = 0;; ++i) {
      pointer_ += '/';
      pointer_ += fmt::format_int(i).c_str();
      Node passing;
      if (!value(keeps_tree_ ? node.children.emplace_back() : passing, depth + 1)) return false;
      pointer_.resize(parent);
      if (take(']')) return true;
      const std::size_t comma = at_;
      if (!take(',')) return stop(at_, peek() == '/' ? no_comments() : unexpected() + "; ',' or ']' is expected here");
      skip_space();
      if (peek() == ']') return stop(comma, "a comma after the last element; leave it out");
    }
  }

  bool object(Node& node, int depth) {
    node.kind = JsonKind::object;
    ++at_;
    if (take('}')) return true;
    const std::size_t parent = pointer_.size();
    for (;;) {
      skip_space();
      if (peek() != '"')
        return stop(at_, peek() == '/' ? no_comments() : unexpected() + "; a key in double quotes is expected here");
      if (node.children.size() == kind_.most_members)
        return stop(at_, fmt::format("more than {} members in an object; a {} has far fewer", kind_.most_members, kind_.noun),
                    ReadOutcome::refused);
      Node& member = node.children.emplace_back();
      member.key_place = place(at_);
      if (!string(member.key)) return false;
      pointer_ += pointer_step(member.key);
      if (!take(':')) return stop(at_, unexpected() + "; ':' is expected here");
      const bool outer = std::exchange(in_comment_, in_comment_ || is_comment_here(member.key));
      if (!value(member, depth + 1)) return false;
      in_comment_ = outer;
      pointer_.resize(parent);
      if (!keeps_tree_) member.text = std::string();
      if (take('}')) {
        if (!in_comment_) refuse_duplicates(node);
        if (!keeps_tree_) node.children = std::vector<Node>();
        return true;
      }
      const std::size_t comma = at_;
      if (!take(',')) return stop(at_, peek() == '/' ? no_comments() : unexpected() + "; ',' or '}' is expected here");
      skip_space();
      if (peek() == '}') return stop(comma, "a comma after the last member; leave it out");
    }
  }

  bool is_comment_here(std::string_view key) const { return kind_.has_comments && is_comment(key); }

  /// Reports duplicate keys and keeps the first one. It sorts instead of hashing, so that no input makes it slow. Comments may
  /// share a key.
  void refuse_duplicates(Node& object) {
    std::vector<std::size_t> order(object.children.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto key = [&](std::size_t i) -> const std::string& { return object.children[i].key; };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::vector<std::pair<std::size_t, std::size_t>> repeated;  // index of the later one, index of the first one
    for (std::size_t i = 0, first = 0; i < order.size(); ++i) {
      if (key(order[i]) != key(order[first]))
        first = i;
      else if (i != first && !is_comment_here(key(order[i])))
        repeated.emplace_back(order[i], order[first]);
    }
    std::sort(repeated.begin(), repeated.end());
    for (const auto& [later, first] : repeated) {
      const Node& again = object.children[later];
      findings_.add_duplicate(again.key_place, object.children[first].key_place, pointer_ + pointer_step(again.key));
      object.children[later].refused = true;
    }
    if (!repeated.empty()) std::erase_if(object.children, [](const Node& child) { return child.refused; });
  }

  std::string_view text_;
  std::string pointer_;
  bool from_set_;
  Findings& findings_;
  TextKind kind_;
  bool keeps_tree_;
  std::size_t at_ = 0;
  std::size_t values_ = 0;
  bool in_comment_ = false;  // inside the value of a comment, which must be JSON, but of any content
  ReadOutcome outcome_ = ReadOutcome::complete;
};

}  // namespace

ReadOutcome read_json(std::string_view text, std::string_view pointer, bool from_set, Node& root, Findings& findings,
                      const TextKind& kind) {
  return Reader(text, pointer, from_set, findings, kind, true).document(root);
}

ReadOutcome check_json(std::string_view text, Findings& findings, const TextKind& kind, JsonKind& outermost) {
  Node root;
  const ReadOutcome outcome = Reader(text, "", false, findings, kind, false).document(root);
  outermost = root.kind;
  return outcome;
}

}  // namespace earthtop::input
