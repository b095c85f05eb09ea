// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/foreign_units.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "input/suggest.hpp"

namespace earthtop::input {
namespace {

/// Exponents of the base quantities. The angle is one of them: a rate is not a frequency.
struct Dimension {
  int mass = 0, length = 0, time = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
  Dimension plus(const Dimension& other, int times) const {
    return {mass + times * other.mass, length + times * other.length, time + times * other.time, angle + times * other.angle};
  }
};

struct Symbol {
  std::string_view name;
  double factor;  ///< the unit in kg, m, s and rad
  Dimension dimension;
};

constexpr Dimension kMass{.mass = 1}, kLength{.length = 1}, kTime{.time = 1}, kAngle{.angle = 1}, kFrequency{.time = -1},
    kRate{.time = -1, .angle = 1}, kSpeed{.length = 1, .time = -1}, kAcceleration{.length = 1, .time = -2},
    kForce{.mass = 1, .length = 1, .time = -2};
constexpr double kPi = std::numbers::pi;

/// The units that keys may have, SI units and others. A symbol with several meanings has a row for each; the first one counts in
/// the units of the fields. The pound, the inch and the foot are those of the international agreement of 1959.
constexpr Symbol kSymbols[] = {
    {"kg", 1, kMass},
    {"g", 1e-3, kMass},
    {"mg", 1e-6, kMass},
    {"lb", 0.45359237, kMass},
    {"oz", 0.45359237 / 16, kMass},
    {"m", 1, kLength},
    {"km", 1e3, kLength},
    {"dm", 0.1, kLength},
    {"cm", 1e-2, kLength},
    {"mm", 1e-3, kLength},
    {"um", 1e-6, kLength},
    {"in", 0.0254, kLength},
    {"inch", 0.0254, kLength},
    {"ft", 0.3048, kLength},
    {"s", 1, kTime},
    {"sec", 1, kTime},
    {"ms", 1e-3, kTime},
    {"us", 1e-6, kTime},
    {"min", 60, kTime},
    {"h", 3600, kTime},
    {"hr", 3600, kTime},
    {"d", 86400, kTime},
    {"rad", 1, kAngle},
    {"mrad", 1e-3, kAngle},
    {"urad", 1e-6, kAngle},
    {"deg", kPi / 180, kAngle},
    {"arcmin", kPi / 10800, kAngle},
    {"arcsec", kPi / 648000, kAngle},
    {"rev", 2 * kPi, kAngle},
    {"turn", 2 * kPi, kAngle},
    {"turns", 2 * kPi, kAngle},
    {"Hz", 1, kFrequency},
    {"Hz", 2 * kPi, kRate},
    {"kHz", 1e3, kFrequency},
    {"kHz", 2e3 * kPi, kRate},
    {"rpm", kPi / 30, kRate},
    {"rpm", 1.0 / 60, kFrequency},
    {"rps", 2 * kPi, kRate},
    {"rps", 1, kFrequency},
    {"dps", kPi / 180, kRate},
    {"kn", 1852.0 / 3600, kSpeed},
    {"gal", 1e-2, kAcceleration},
    {"mgal", 1e-5, kAcceleration},
    {"N", 1, kForce},
    {"mN", 1e-3, kForce},
    {"uN", 1e-6, kForce},
    {"dyn", 1e-5, kForce},
};

/// Abbreviations and other names of stems, and the stems. An altitude is no misspelt latitude.
constexpr std::array<std::string_view, 2> kAbbreviations[] = {
    {"lat", "latitude"}, {"lon", "longitude"},   {"long", "longitude"},   {"lng", "longitude"},
    {"alt", "height"},   {"altitude", "height"}, {"elevation", "height"}, {"com", "center_of_mass"}};

/// Units as people speak them, which keys do not have.
constexpr std::string_view kSpokenUnits[] = {
    "degree",  "degrees", "radian", "radians", "gram",   "grams", "kilogram", "kilograms",   "second",      "seconds", "minute",
    "minutes", "hour",    "hours",  "meter",   "meters", "metre", "metres",   "millimeters", "millimetres", "inches",  "feet"};

constexpr std::size_t kLongestKey = 48;  // a longer key has no unit worth explaining, and a hostile one would cost time
constexpr std::size_t kMostParts = 4;

bool is_symbol(const Symbol& symbol, std::string_view lower) { return lower_case(symbol.name) == lower; }

/// A symbol with its power, as a unit or a key contains it.
struct Part {
  std::string symbol;  // lower case
  int power = 1;       // not negative in a key, where only the quantity tells what is divided by
};

/// Splits "cm3" or "cm^3" into symbol and power; empty if it is neither.
std::optional<Part> part_of(std::string_view text) {
  std::size_t letters = 0;
  while (letters < text.size() && std::isalpha(static_cast<unsigned char>(text[letters])) != 0) ++letters;
  std::string_view digits = text.substr(letters);
  if (digits.starts_with('^')) digits.remove_prefix(1);
  if (letters == 0 || digits.size() > 1 || (digits.size() == 1 && (digits[0] < '2' || digits[0] > '9'))) return std::nullopt;
  return Part{lower_case(text.substr(0, letters)), digits.empty() ? 1 : digits[0] - '0'};
}

/// A unit as a product of powers of symbols.
struct Unit {
  double factor = 1;
  Dimension dimension;
  std::string over, under;  // as messages write it: over/under

  Unit times(const Symbol& symbol, int power) const {
    Unit product = *this;
    for (int i = 0; i < std::abs(power); ++i) power > 0 ? product.factor *= symbol.factor : product.factor /= symbol.factor;
    product.dimension = dimension.plus(symbol.dimension, power);
    std::string& text = power > 0 ? product.over : product.under;
    const std::string exponent = std::abs(power) == 1 ? "" : fmt::format("^{}", std::abs(power));
    text += fmt::format("{}{}{}", text.empty() ? "" : " ", symbol.name, exponent);
    return product;
  }
  std::string text() const { return under.empty() ? over : fmt::format("{}/{}", over.empty() ? "1" : over, under); }
};

/// Reads the unit of a field, e.g. "kg m^2", "N s/m", "1/s^2"; empty for a field without one.
std::optional<Unit> unit_of(const Field& field) {
  Unit unit;
  int sign = 1;
  std::string_view rest = field.unit;
  if (rest.empty()) return std::nullopt;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(" /"), rest.size());
    const std::string_view word = rest.substr(0, end);
    if (word != "1") {
      const auto part = part_of(word);
      const auto* symbol = part ? std::find_if(std::begin(kSymbols), std::end(kSymbols),
                                               [&](const Symbol& s) { return is_symbol(s, part->symbol); })
                                : std::end(kSymbols);
      if (symbol == std::end(kSymbols)) return std::nullopt;
      unit = unit.times(*symbol, sign * part->power);
    }
    if (end < rest.size() && rest[end] == '/') sign = -1;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return unit;
}

/// The ending of a field's key that spells its unit: "kg m^2" as "_kg_m2".
std::string ending_of(const Field& field) {
  std::string ending = "_";
  std::string_view unit = field.unit;
  if (unit.starts_with("1/")) unit.remove_prefix(2);
  for (const char c : unit)
    if (c != '^') ending += c == ' ' || c == '/' ? '_' : c;
  return lower_case(ending);
}

/// The field's key without its unit; empty if it does not end with it.
std::string stem_of(const Field& field) {
  const std::string key = lower_case(field.key()), ending = ending_of(field);
  if (field.unit.empty() || key.size() <= ending.size() || !key.ends_with(ending)) return "";
  return key.substr(0, key.size() - ending.size());
}

/// Finds which of the parts are multiplied, and which divided by, in a unit of this dimension.
std::optional<Unit> unit_of_dimension(const std::vector<Part>& parts, std::size_t at, const Unit& so_far,
                                      const Dimension& wanted) {
  if (at == parts.size()) return so_far.dimension == wanted ? std::optional(so_far) : std::nullopt;
  for (const int sign : {1, -1})
    for (const Symbol& symbol : kSymbols) {
      if (!is_symbol(symbol, parts[at].symbol)) continue;
      if (auto unit = unit_of_dimension(parts, at + 1, so_far.times(symbol, sign * parts[at].power), wanted)) return unit;
    }
  return std::nullopt;
}

/// Reads the ending of a key as a unit of this dimension; empty if it is none.
std::optional<Unit> unit_in_key(std::string_view ending, const Dimension& wanted) {
  std::vector<Part> parts;
  while (!ending.empty()) {
    const std::size_t end = std::min(ending.find('_'), ending.size());
    auto part = part_of(ending.substr(0, end));
    if (!part || parts.size() == kMostParts) return std::nullopt;
    parts.push_back(*std::move(part));
    ending.remove_prefix(std::min(end + 1, ending.size()));
  }
  return parts.empty() ? std::nullopt : unit_of_dimension(parts, 0, {}, wanted);
}

/// The rest of a key after the stem, or an abbreviation of the stem, and an underscore; empty if the key does not begin so.
std::string_view after_stem(std::string_view key, std::string_view stem) {
  const auto after = [&](std::string_view start) {
    return key.size() > start.size() + 1 && key.starts_with(start) && key[start.size()] == '_' ? key.substr(start.size() + 1)
                                                                                               : std::string_view();
  };
  std::string_view rest = after(stem);
  for (const auto& [abbreviation, full] : kAbbreviations)
    if (rest.empty() && full == stem) rest = after(abbreviation);
  return rest;
}

/// The factor from the unit that the key's ending names to the unit of a field; empty if the ending names no other unit.
std::optional<std::string> factor_text(std::string_view ending, const Field& field) {
  const auto own = unit_of(field);
  const auto given = own ? unit_in_key(ending, own->dimension) : std::nullopt;
  if (!given || given->text() == own->text()) return std::nullopt;
  return fmt::format("1 {} = {:.15g} {}", given->text(), given->factor / own->factor, field.unit);
}

/// Returns whether a word of a name in lower case is a unit, as a symbol or spoken.
bool names_unit(std::string_view word) {
  if (std::find(std::begin(kSpokenUnits), std::end(kSpokenUnits), word) != std::end(kSpokenUnits)) return true;
  const auto part = part_of(word);
  return part && std::any_of(std::begin(kSymbols), std::end(kSymbols),
                             [&](const Symbol& symbol) { return is_symbol(symbol, part->symbol); });
}

template <class Visit>
void each_below(const FieldTable& table, std::string_view pattern, const Visit& visit) {
  for (const Field& field : table.fields)
    if (field.parent() == pattern && field.key() != "*") visit(field);
}

}  // namespace

std::optional<ForeignUnit> foreign_unit(const FieldTable& table, std::string_view key, std::string_view pattern,
                                        bool with_path) {
  if (key.size() > kLongestKey) return std::nullopt;
  const std::string lower = lower_case(key);
  const auto end = lower.rfind('_');  // "turn_rad" has a unit, though its other word is one, too
  if (end == lower.npos || !names_unit(std::string_view(lower).substr(end + 1))) return std::nullopt;
  const std::vector<std::string_view> keys = table.keys_below(pattern);
  const auto is_key = [&](std::string_view known) { return lower_case(known) == lower; };
  if (std::any_of(keys.begin(), keys.end(), is_key)) return std::nullopt;  // in another case only
  ForeignUnit found;
  each_below(table, pattern, [&](const Field& field) {
    const std::string stem = stem_of(field);
    const auto factor = stem.empty() ? std::nullopt : factor_text(after_stem(lower, stem), field);
    if (!factor) return;
    found.message +=
        fmt::format("{} {}; {}", found.message.empty() ? "give" : ", or", with_path ? field.pointer : field.key(), *factor);
    if (found.meant.empty()) found.meant = field.key();
  });
  // The quantity of an object: "inertia_g_cm2" means a member of "inertia".
  if (found.meant.empty())
    each_below(table, pattern, [&](const Field& object) {
      if (!object.unit.empty()) return;
      each_below(table, object.pointer, [&](const Field& field) {
        const auto factor = factor_text(after_stem(lower, lower_case(object.key())), field);
        if (!factor || !found.meant.empty()) return;
        found = {fmt::format("give {}/{}; {}", with_path ? object.pointer : object.key(), field.key(), *factor), object.key()};
      });
    });
  return found.meant.empty() ? std::nullopt : std::optional(std::move(found));
}

std::optional<std::string_view> abbreviated(const FieldTable& table, std::string_view key, std::string_view pattern) {
  if (key.size() > kLongestKey) return std::nullopt;
  const std::string lower = lower_case(key);
  const std::string_view stem_given = without_unit(lower);
  std::optional<std::string_view> meant;
  for (const auto& [abbreviation, full] : kAbbreviations)
    if (stem_given == abbreviation)
      each_below(table, pattern, [&, stem = full](const Field& field) {
        if (!meant && stem_of(field) == stem) meant = field.key();
      });
  return meant;
}

std::string_view without_unit(std::string_view lower) {
  std::string_view stem = lower;
  for (auto end = stem.rfind('_'); end != std::string_view::npos && names_unit(stem.substr(end + 1)); end = stem.rfind('_'))
    stem = stem.substr(0, end);
  return stem.empty() || names_unit(stem) ? lower : stem;
}

std::vector<std::string_view> keys_in_second_units(const FieldTable& table, std::string_view pattern) {
  std::vector<std::string_view> keys;
  std::vector<std::pair<std::string, Dimension>> seen;
  each_below(table, pattern, [&](const Field& field) {
    const std::string stem = stem_of(field);
    const auto unit = stem.empty() ? std::nullopt : unit_of(field);
    if (!unit) return;
    std::pair<std::string, Dimension> quantity{stem, unit->dimension};
    if (std::find(seen.begin(), seen.end(), quantity) != seen.end())
      keys.push_back(field.key());
    else
      seen.push_back(std::move(quantity));
  });
  return keys;
}

}  // namespace earthtop::input
