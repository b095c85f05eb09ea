// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads formulas and the numbers beside them from a printed text.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace earthtop::formulas {

inline constexpr long double kPi = std::numbers::pi_v<float80>;
using Symbols = std::map<std::string, long double>;

/// The formula at a place of a text, or the number with its unit.
struct Side {
  long double value = 0, error = 0;  // error: half of the last digit that is printed
  std::size_t end = 0;               // of the text that was read
  bool is_formula = false;
  bool is_symbol = false;  // nothing but the name of a quantity
};

/// Reads formulas and numbers from a text.
class Reader {
 public:
  Reader(const std::string& text, const Symbols& symbols) : text_(text), symbols_(symbols) {}

  /// A number with its unit, "1.20e-3 ± 4e-7 rad", or a formula.
  std::optional<Side> side(std::size_t at) const {
    if (const auto number = number_with_unit(at)) return number;
    State state{at};
    const auto value = sum(state);
    if (!value) return std::nullopt;
    return Side{*value, 0, state.at, is_formula(state), state.is_symbol && state.factors == 1};
  }
  std::optional<Side> number_with_unit(std::size_t at) const {
    auto first = number(at);
    if (!first) return std::nullopt;
    auto unit = unit_at(first->end);
    if (unit) first->end = unit->end;
    if (follows(first->end, " ± ")) {
      if (const auto error = number(first->end + std::string_view(" ± ").size())) {
        first->end = error->end;
        if (const auto of_error = unit_at(error->end)) unit = of_error, first->end = of_error->end;
      }
    }
    if (unit) {
      first->value *= unit->value, first->error *= std::abs(unit->value);
      return first;
    }
    // A number that begins a formula is no number beside one.
    State state{at};
    if (const auto value = sum(state); value && is_formula(state)) return std::nullopt;
    return first;
  }
  bool follows(std::size_t at, std::string_view what) const { return text_.compare(at, what.size(), what) == 0; }

 private:
  struct State {
    std::size_t at;
    bool is_distinct = false, is_symbol = false, has_name = false;
    int factors = 0;
  };
  /// In a sentence a single Latin letter may be a unit or a word.
  static bool is_formula(const State& state) { return state.is_distinct || (state.has_name && state.factors > 1); }

  static bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

  /// A printed number. Fewer than three digits are more, of which the last were zeros.
  std::optional<Side> number(std::size_t at) const {
    const std::size_t begin = at;
    if (at < text_.size() && (text_[at] == '-' || text_[at] == '+')) ++at;
    const std::size_t digits = text_.find_first_not_of("0123456789.", at);
    std::size_t end = std::min(digits, text_.size());
    while (end > at && text_[end - 1] == '.') --end;
    if (end == at || !std::isdigit(static_cast<unsigned char>(text_[at]))) return std::nullopt;
    const std::string mantissa = text_.substr(at, end - at);
    int exponent = 0;
    if (end + 2 < text_.size() && text_[end] == 'e' && (text_[end + 1] == '-' || text_[end + 1] == '+')) {
      std::size_t used = 0;
      exponent = std::stoi(text_.substr(end + 1), &used);
      end += 1 + used;
    }
    const std::size_t point = mantissa.find('.');
    int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
    const auto significant = [&] {
      std::string all = mantissa;
      std::erase(all, '.');
      return static_cast<int>(all.size() - std::min(all.find_first_not_of('0'), all.size()));
    };
    constexpr int kFewest = 3;
    if (significant() > 0 && significant() < kFewest) decimals += kFewest - significant();
    Side side;
    side.value = std::strtold(text_.substr(begin, end - begin).c_str(), nullptr);
    side.error = 0.5L * std::pow(10.0L, exponent - decimals);
    side.end = end;
    return side;
  }
  struct Unit {
    long double value;
    std::size_t end;
  };
  std::optional<Unit> unit_at(std::size_t at) const {
    const long double degree = kPi / 180, arcsecond = degree / 3600;
    const std::pair<std::string, long double> units[] = {
        {" |Ω| t", std::abs(symbols_.at("Ω")) * symbols_.at("t")},
        {" Ω t", symbols_.at("Ω") * symbols_.at("t")},
        {" rad/s", 1},
        {" rad", 1},
        {"°", degree},
        {"″", arcsecond},
        {" arcsec", arcsecond},
        {" milliarcsec", 1e-3L * arcsecond},
        {" microarcsec", 1e-6L * arcsecond},
        {" N m", 1},
        {" m/s²", 1},
        {" km/s", 1e3L},
        {" m/s", 1},
        {" mm/s", 1e-3L},
        {" µm/s", 1e-6L},
        {" nm/s", 1e-9L},
        {" km", 1e3L},
        {" mm", 1e-3L},
        {" µm", 1e-6L},
        {" micrometres", 1e-6L},
        {" nm", 1e-9L},
        {" nanometres", 1e-9L},
        {" kg m²", 1},
        {" kg m^3/s", 1},
        {" m", 1},
        {" s", 1},
    };
    for (const auto& [name, value] : units) {
      const std::size_t end = at + name.size();
      if (follows(at, name) && (end == text_.size() || !is_letter(text_[end]) || name.back() < 0)) return Unit{value, end};
    }
    return std::nullopt;
  }

  using Join = long double (*)(long double, long double);
  /// Joins parts to a first value, for as long as `joint`, which goes beyond what stands between two parts, finds a join.
  template <class Joint, class Part>
  static std::optional<long double> chain(State& s, std::optional<long double> total, const Joint& joint, const Part& part) {
    while (total) {
      State next = s;
      const Join join = joint(next);
      const std::optional<long double> with = join ? part(next) : std::nullopt;
      if (!with) return total;
      total = join(*total, *with);
      s = next;
    }
    return total;
  }
  /// Goes beyond one of these words. @returns whether there is one
  bool skip(State& s, std::initializer_list<std::string_view> words) const {
    const auto* const found =
        std::find_if(words.begin(), words.end(), [&](std::string_view word) { return follows(s.at, word); });
    if (found == words.end()) return false;
    s.at += found->size();
    return true;
  }
  std::optional<long double> sum(State& s) const {
    const bool is_negative = skip(s, {"-"});
    auto first = product(s);
    if (first && is_negative) first = -*first;
    const auto joint = [&](State& next) -> Join {
      if (skip(next, {" - ", " − "})) return [](long double a, long double b) { return a - b; };
      if (skip(next, {" + "})) return [](long double a, long double b) { return a + b; };
      return nullptr;
    };
    return chain(s, first, joint, [&](State& next) { return product(next); });
  }
  std::optional<long double> product(State& s) const {
    const auto joint = [&](State& next) -> Join {
      if (skip(next, {" / ", "/"})) return [](long double a, long double b) { return a / b; };
      skip(next, {" times ", " "});  // or nothing
      return [](long double a, long double b) { return a * b; };
    };
    return chain(s, factor(s), joint, [&](State& next) { return factor(next); });
  }
  std::optional<long double> factor(State& s) const {
    auto value = atom(s);
    if (!value) return std::nullopt;
    ++s.factors;
    if (follows(s.at, "²")) *value *= *value, s.at += std::string_view("²").size(), s.is_distinct = true;
    return value;
  }
  std::optional<long double> atom(State& s) const {
    const auto inside = [&](std::string_view open, char close) -> std::optional<long double> {
      State next = s;
      next.at += open.size();
      const auto value = sum(next);
      if (!value || next.at >= text_.size() || text_[next.at] != close) return std::nullopt;
      ++next.at;
      next.is_distinct = next.is_distinct || next.is_symbol;
      s = next;
      return value;
    };
    using Function = long double (*)(long double);
    const std::pair<std::string_view, Function> functions[] = {
        {"sqrt(", std::sqrt}, {"asin(", std::asin}, {"sin(", std::sin}, {"cos(", std::cos}};
    for (const auto& [name, function] : functions)
      if (follows(s.at, name)) {
        const auto value = inside(name, ')');
        if (!value) return std::nullopt;
        s.is_distinct = true;
        return function(*value);
      }
    if (follows(s.at, "(")) return inside("(", ')');
    if (follows(s.at, "|")) {
      const auto value = inside("|", '|');
      return value ? std::optional(std::abs(*value)) : std::nullopt;
    }
    for (auto symbol = symbols_.rbegin(); symbol != symbols_.rend(); ++symbol) {  // the longer of two names comes later
      const auto& [name, value] = *symbol;
      const std::size_t end = s.at + name.size();
      if (!follows(s.at, name) || (end < text_.size() && is_letter(text_[end]))) continue;
      s.at = end, s.is_symbol = true;
      s.has_name = s.has_name || name.size() > 1;
      return value;
    }
    const std::size_t digits = std::min(text_.find_first_not_of("0123456789.", s.at), text_.size());
    if (digits == s.at || text_[s.at] == '.') return std::nullopt;
    const long double value = std::strtold(text_.substr(s.at, digits - s.at).c_str(), nullptr);
    s.at = digits;
    if (!follows(s.at, "°")) return value;
    s.at += std::string_view("°").size();
    return value * kPi / 180;
  }

  const std::string& text_;
  const Symbols& symbols_;
};

/// The formulas that a text gives numbers for, and how many of them are true.
struct Claims {
  std::map<std::string, int> formulas;  // each formula with a number beside it, and how often it was found
  std::vector<std::string> wrong;       // formulas that do not give their number
  std::string unread;                   // the rest of the text
};

inline Claims claims_of(const std::string& text, const Symbols& symbols) {
  constexpr long double kRounding = 1e-13L;  // of numbers that doubles have computed
  Claims claims;
  const Reader reader(text, symbols);
  for (std::size_t at = 0; at < text.size();) {
    const bool begins = at == 0 || std::string_view(" (\n").find(text[at - 1]) != std::string_view::npos;
    const auto first = begins ? reader.side(at) : std::nullopt;
    if (!first) {
      claims.unread += text[at++];
      continue;
    }
    std::vector<Side> sides{*first};
    std::vector<std::size_t> begin{at};
    while (reader.follows(sides.back().end, " = ")) {
      const auto next = reader.side(sides.back().end + 3);
      if (!next) break;
      begin.push_back(sides.back().end + 3), sides.push_back(*next);
    }
    if (sides.size() == 1 && (first->is_formula || first->is_symbol))
      for (const std::string_view link : {", which is ", ", "})
        if (reader.follows(first->end, link))
          if (const auto number = reader.number_with_unit(first->end + link.size())) {
            begin.push_back(first->end + link.size()), sides.push_back(*number);
            break;
          }
    if (sides.size() == 1) {
      if (first->is_formula || first->is_symbol) claims.unread += text.substr(at, first->end - at);
      at = first->end;
      continue;
    }
    const std::size_t end = sides.back().end;
    // The time of an event is called t, too.
    const bool is_time = first->is_symbol && text.compare(at, 4, "t = ") == 0;
    for (std::size_t i = 0; i < sides.size() && !is_time; ++i) {
      const Side& one = sides[i];
      if (one.is_formula || one.is_symbol) ++claims.formulas[text.substr(begin[i], one.end - begin[i])];
      for (std::size_t j = 0; j < i; ++j) {
        const Side& other = sides[j];
        const long double size = std::max(std::abs(one.value), std::abs(other.value));
        if (!(std::abs(one.value - other.value) <= one.error + other.error + kRounding * size))
          claims.wrong.push_back(fmt::format("{} : {:.12g} and {:.12g}", text.substr(at, end - at),
                                             static_cast<double>(other.value), static_cast<double>(one.value)));
      }
    }
    at = end;
  }
  return claims;
}

/// Whether what could not be read has a sign of a formula.
inline bool has_formula(const std::string& unread) {
  for (const char* sign : {"=", "sqrt", "sin(", "cos(", "Ω", "ω", "π", "²", "^", "/(", " × ", " * "})
    if (unread.find(sign) != std::string::npos) return true;
  return false;
}

}  // namespace earthtop::formulas
