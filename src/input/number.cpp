// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace earthtop::input {
namespace {

/// Returns whether a number outside a double's range is too large rather than too small, by its exponent and the decimal place
/// of its first nonzero digit.
bool is_large(std::string_view digits) {
  const auto e = digits.find_first_of("eE");
  const std::string_view mantissa = digits.substr(0, e);
  const auto point = std::min(mantissa.find('.'), mantissa.size());
  const auto first = mantissa.find_first_of("123456789");
  const auto place = static_cast<long long>(point) - static_cast<long long>(first);
  long long exponent = 0;
  bool negative = false;
  if (e != std::string_view::npos) {
    for (const char c : digits.substr(e + 1)) {
      if (c == '-') negative = true;
      if (c >= '0' && c <= '9') exponent = std::min(exponent * 10 + (c - '0'), 1'000'000'000'000LL);  // beyond any mantissa
    }
  }
  return place + (negative ? -exponent : exponent) > 0;
}

}  // namespace

NumberFit decimal_to_double(std::string_view digits, double& value) {
  value = 0;
  const std::string_view mantissa = digits.substr(0, digits.find_first_of("eE"));
  if (mantissa.find_first_of("123456789") == std::string_view::npos) return NumberFit::fits;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (result.ec == std::errc() && std::isfinite(value) && value != 0) return NumberFit::fits;
  value = 0;
  return is_large(digits) ? NumberFit::too_large : NumberFit::too_small;
}

}  // namespace earthtop::input
