// SPDX-License-Identifier: GPL-3.0-or-later
// Exponential function, sine and cosine of float80, in plain arithmetic.
#include "earthtop/real.hpp"

#include <array>
#include <limits>

namespace earthtop::real {
namespace {

constexpr int kParts = 32;  ///< parts of a power of two, each with an entry in the table

/// 2^(j/32) as sums of two numbers, and ln 2 / 32 as a sum whose first number has so few bits that its product with every
/// multiple needed is exact.
struct Table {
  std::array<float80, kParts> high, low;
  float80 part_high, part_low;

  Table() {
    const float128 ln2 = logq(float128(2));
    for (int j = 0; j < kParts; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const float128 power = expq(ln2 * j / kParts);
      high[at] = static_cast<float80>(power);
      low[at] = static_cast<float80>(power - float128(high[at]));
    }
    const float128 part = ln2 / kParts;
    constexpr int kBits = 40;
    part_high = static_cast<float80>(scalbnq(rintq(scalbnq(part, kBits)), -kBits));
    part_low = static_cast<float80>(part - float128(part_high));
  }
};

/// The constants of sine and cosine: pi / 2 as a sum of three numbers, the first two with so few bits that their products with the multiples
/// needed are exact; and the coefficients of the series in the square of the angle, from r^3 / 3! and r^4 / 4! on. The first terms left
/// out are r^21 / 21! and r^22 / 22!, below 2^-72.
struct Circle {
  static constexpr std::size_t kTerms = 9;
  float80 high, middle, low;
  std::array<float80, kTerms> sine, cosine;

  Circle() {
    constexpr int kBits = 40;
    const float128 quarter = real::pi<float128>() / 2;
    high = static_cast<float80>(scalbnq(rintq(scalbnq(quarter, kBits)), -kBits));
    const float128 rest = quarter - float128(high);
    middle = static_cast<float80>(scalbnq(rintq(scalbnq(rest, 2 * kBits)), -2 * kBits));
    low = static_cast<float80>((rest - float128(middle)) + real::pi_rest<float128>() / 2);
    float128 term = -1;
    for (int k = 0; k < static_cast<int>(kTerms); ++k) {
      term /= -(2 * k + 2);  // (-1)^k / (2k + 2)!
      const float128 next = term / (2 * k + 3);
      sine[static_cast<std::size_t>(k)] = static_cast<float80>(-next);
      term = next;
      cosine[static_cast<std::size_t>(k)] = static_cast<float80>(term / (2 * k + 4));
    }
  }
};

float80 polynomial(const std::array<float80, Circle::kTerms>& coefficients, float80 x) {
  float80 sum = coefficients.back();
  for (std::size_t i = Circle::kTerms - 1; i-- > 0;) sum = coefficients[i] + x * sum;
  return sum;
}

}  // namespace

SinCos<float80> sin_cos(float80 x) noexcept {
  constexpr float80 kUsual = 1e6;
  if (!(abs(x) < kUsual))
    return {static_cast<float80>(sinq(static_cast<float128>(x))), static_cast<float80>(cosq(static_cast<float128>(x)))};
  static const Circle circle;
  constexpr float80 kPerTwoPi{0.63661977236758134308L};
  const float80 quarters = rint(x * kPerTwoPi);
  // r + low = x - quarters pi / 2, at most pi / 4.
  const float80 part = x - quarters * circle.high, taken = quarters * circle.middle, near = part - taken;
  const float80 rest = quarters * circle.low - ((part - near) - taken), r = near - rest, low = (near - r) - rest;
  // r^2 / 2 as an exact square and a small rest.
  constexpr float80 kSplitter = 4294967297.0;  // 2^32 + 1: halves of 32 bits
  const float80 split = kSplitter * r, front = split - (split - r);
  const float80 half = front * front / 2, half_rest = (r - front) * (r + front) / 2, most = 1 - half, square = r * r;
  const float80 sine = r + (low * most + r * square * polynomial(circle.sine, square));
  const float80 cosine =
      most + ((((1 - most) - half) - half_rest) - r * low + square * square * polynomial(circle.cosine, square));
  switch (static_cast<int>(quarters) & 3) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
  }
}

float80 exp(float80 x) noexcept {
  // Near the ends of the number range, and for NaN.
  constexpr float80 kUsual = 11000, kOne = 1;
  if (!(abs(x) < kUsual)) return static_cast<float80>(expq(static_cast<float128>(x)));
  static const Table table;
  constexpr float80 kPartsPerLn2{46.166241308446828384L};
  const float80 multiple = rint(x * kPartsPerLn2);
  const float80 r = (x - multiple * table.part_high) - multiple * table.part_low;  // at most ln 2 / 64 = 0.011
  // e^r - 1; the first term left out is r^9 / 9!, below 2^-77.
  const float80 rest =
      r +
      r * r *
          (kOne / 2 + r * (kOne / 6 + r * (kOne / 24 + r * (kOne / 120 + r * (kOne / 720 + r * (kOne / 5040 + r / 40320))))));
  const int n = static_cast<int>(multiple);
  const auto j = static_cast<std::size_t>(n & (kParts - 1));
  return scale(table.high[j] + (table.low[j] + table.high[j] * rest), (n - static_cast<int>(j)) / kParts);
}

}  // namespace earthtop::real
