// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/short_number.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "earthtop/elementary.hpp"
#include "text/number_words.hpp"

namespace earthtop {

std::string short_number(double value, double error) {
  constexpr int kDigits = 4, kErrorDigits = 2;  // of the number, and of an error beside it (known_number)
  if (value == 0) return "0";
  // The decade that the number has when it is rounded: 999.96 is 1000.
  const std::string rounded = fmt::format("{:.{}e}", value, kDigits - 1);
  const int decade = std::atoi(rounded.c_str() + rounded.find('e') + 1);
  return known_number(value, std::max(error, 1.5 * real::power_of_ten(decade - kDigits + kErrorDigits)), kDigits).value;
}

}  // namespace earthtop
