// SPDX-License-Identifier: GPL-3.0-or-later
// The exponential function of long double, in plain arithmetic.
#include "earthtop/real.hpp"

#include <array>
#include <limits>

namespace earthtop::real {
namespace {

constexpr int kParts = 32;  ///< parts of a power of two, each with an entry in the table

/// 2^(j/32) as sums of two numbers, and ln 2 / 32 as a sum whose first number has so few bits that its product with every
/// multiple needed is exact.
struct Table {
  std::array<long double, kParts> high, low;
  long double part_high, part_low;

  Table() {
    const float128 ln2 = logq(float128(2));
    for (int j = 0; j < kParts; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const float128 power = expq(ln2 * j / kParts);
      high[at] = static_cast<long double>(power);
      low[at] = static_cast<long double>(power - float128(high[at]));
    }
    const float128 part = ln2 / kParts;
    constexpr int kBits = 40;
    part_high = static_cast<long double>(scalbnq(rintq(scalbnq(part, kBits)), -kBits));
    part_low = static_cast<long double>(part - float128(part_high));
  }
};

}  // namespace

long double exp(long double x) noexcept {
  // Near the ends of the number range, for NaN, and where long double is not the format of 64 bits.
  constexpr long double kUsual = 11000;
  if (std::numeric_limits<long double>::digits != 64 || !(abs(x) < kUsual)) return static_cast<long double>(expq(x));
  static const Table table;
  constexpr long double kPartsPerLn2 = 46.166241308446828384L;
  const long double multiple = rint(x * kPartsPerLn2);
  const long double r = (x - multiple * table.part_high) - multiple * table.part_low;  // at most ln 2 / 64 = 0.011
  // e^r - 1; the first term left out is r^9 / 9!, below 2^-77.
  const long double rest =
      r +
      r * r *
          (1.0L / 2 + r * (1.0L / 6 + r * (1.0L / 24 + r * (1.0L / 120 + r * (1.0L / 720 + r * (1.0L / 5040 + r / 40320))))));
  const int n = static_cast<int>(multiple);
  const auto j = static_cast<std::size_t>(n & (kParts - 1));
  return std::scalbn(table.high[j] + (table.low[j] + table.high[j] * rest), (n - static_cast<int>(j)) / kParts);
}

}  // namespace earthtop::real
