// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/digits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

namespace earthtop {
namespace {

constexpr std::size_t kDigits = 34;  // significant digits that are written of a significand of 113 bits

/// A natural number in base 10^9, least part first: large enough for every bit of a float128.
class Natural {
 public:
  explicit Natural(unsigned __int128 value) {
    for (; value > 0; value /= kBase) parts_.push_back(static_cast<std::uint32_t>(value % kBase));
  }
  void multiply(std::uint32_t factor) {
    std::uint64_t carry = 0;
    for (std::uint32_t& part : parts_) {
      carry += static_cast<std::uint64_t>(part) * factor;
      part = static_cast<std::uint32_t>(carry % kBase);
      carry /= kBase;
    }
    for (; carry > 0; carry /= kBase) parts_.push_back(static_cast<std::uint32_t>(carry % kBase));
  }
  /// Multiplies the number by base^exponent, by base^piece at a time, which must fit in 32 bits.
  void multiply_by_power(std::uint32_t base, int piece, int exponent) {
    std::uint32_t whole_piece = 1;
    for (int i = 0; i < piece; ++i) whole_piece *= base;
    for (; exponent >= piece; exponent -= piece) multiply(whole_piece);
    for (; exponent > 0; --exponent) multiply(base);
  }
  std::string decimal() const {
    std::string text = fmt::format("{}", parts_.back());
    for (std::size_t i = parts_.size() - 1; i-- > 0;) text += fmt::format("{:09}", parts_[i]);
    return text;
  }

 private:
  static constexpr std::uint32_t kBase = 1'000'000'000;
  std::vector<std::uint32_t> parts_;
};

/// Rounds decimal digits to at most kDigits. @returns whether the first digit has moved one place up (9.99... became 10.0)
bool round_to_digits(std::string& text) {
  if (text.size() <= kDigits) return false;
  const bool odd = (text[kDigits - 1] - '0') % 2 != 0;
  const bool above_half = text.find_first_not_of('0', kDigits + 1) != std::string::npos;
  const bool up = text[kDigits] > '5' || (text[kDigits] == '5' && (above_half || odd));
  text.resize(kDigits);
  if (!up) return false;
  std::size_t i = kDigits;
  while (i > 0 && text[i - 1] == '9') text[--i] = '0';
  if (i > 0) {
    ++text[i - 1];
    return false;
  }
  text.insert(0, 1, '1');
  text.pop_back();
  return true;
}

/// The exact decimal expansion of a finite number, rounded: m 2^e is m 5^-e / 10^-e for negative e.
std::string rounded_decimal(float128 value) {
  if (value == 0) return "0";
  int exponent = 0;
  const float128 fraction = frexpq(value, &exponent);
  exponent -= 113;  // the value is an integer of 113 bits times 2^exponent
  Natural natural(static_cast<unsigned __int128>(real::scale(fraction, 113)));
  if (exponent < 0)
    natural.multiply_by_power(5, 13, -exponent);
  else
    natural.multiply_by_power(2, 31, exponent);
  std::string text = natural.decimal();
  int leading = static_cast<int>(text.size()) - 1 + std::min(exponent, 0);  // power of ten of the first digit
  if (round_to_digits(text)) ++leading;
  text.erase(text.find_last_not_of('0') + 1);
  const int count = static_cast<int>(text.size());
  if (leading < -4 || leading >= static_cast<int>(kDigits)) {
    if (count > 1) text.insert(1, 1, '.');
    return fmt::format("{}e{}{:02}", text, leading < 0 ? '-' : '+', leading < 0 ? -leading : leading);
  }
  if (leading < 0) {
    const int zeros = -leading - 1;
    return fmt::format("0.{}{}", std::string(static_cast<std::size_t>(zeros), '0'), text);
  }
  if (const int zeros = leading + 1 - count; zeros >= 0) return text + std::string(static_cast<std::size_t>(zeros), '0');
  const int whole = leading + 1;
  return text.insert(static_cast<std::size_t>(whole), 1, '.');
}

/// The shortest text that reads back to the same number.
template <class T>
std::string shortest(T value) {
  char text[64];  // the longest shortest form of a float80 has 28 characters
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return {text, end};
}

/// The same where float80 is no type of the language's: as few digits as it needs, written as `std::to_chars` would.
template <class LongDouble>
std::string shortest(detail::RoundedTo64Bits<LongDouble> value) {
  char text[64];
  const auto written = [&](std::chars_format format, int places) {
    return std::string(text, std::to_chars(text, text + sizeof text, value.value(), format, places).ptr);
  };
  int places = 0;
  std::string scientific;
  for (; places < std::numeric_limits<detail::RoundedTo64Bits<LongDouble>>::max_digits10; ++places) {
    scientific = written(std::chars_format::scientific, places);
    LongDouble back = 0;
    std::from_chars(scientific.data(), scientific.data() + scientific.size(), back);
    if (detail::RoundedTo64Bits<LongDouble>(back) == value) break;
  }
  const int power = std::atoi(scientific.c_str() + scientific.find('e') + 1);
  if (power < -8 || power > 30) return scientific;  // whose other form is longer
  std::string fixed = written(std::chars_format::fixed, std::max(places - power, 0));
  return fixed.size() <= scientific.size() ? fixed : scientific;
}

}  // namespace

std::string digits(float128 value, Precision precision) {
  if (!real::isfinite(value)) return "";
  switch (precision) {
    case Precision::bits53: return shortest(static_cast<double>(value));
    case Precision::bits64: return shortest(static_cast<float80>(value));
    case Precision::bits113: break;
  }
  return fmt::format("{}{}", value < 0 ? "-" : "", rounded_decimal(real::abs(value)));
}

}  // namespace earthtop
