// SPDX-License-Identifier: GPL-3.0-or-later
// The rounding to 64 bits that stands for the x87's arithmetic on other processors, against the x87 itself.
#include "earthtop/float80.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "earthtop/float128.hpp"

namespace earthtop {
namespace {

TEST(Float80, HasTheDigitsAndTheRangeOfTheX87) {
  EXPECT_EQ(std::numeric_limits<float80>::digits, 64);
  EXPECT_EQ(static_cast<long double>(std::numeric_limits<float80>::epsilon()), 0x1p-63L);
  EXPECT_EQ(static_cast<long double>(std::numeric_limits<float80>::denorm_min()), 0x1p-16445L);
  EXPECT_EQ(static_cast<long double>(std::numeric_limits<float80>::max()), 0xf.fffffffffffffffp16380L);
}

TEST(Float80, RoundsToTheNearestAndOfTwoToTheEven) {
  const float80 one = 1, last = std::numeric_limits<float80>::epsilon();
  EXPECT_EQ(one + last / 2, one);
  EXPECT_EQ(one + last + last / 2, one + 2 * last);
  EXPECT_GT(one + (last / 2 + last * last), one);
  EXPECT_EQ(one - last / 2 - last * last, one - last / 2);
  EXPECT_EQ(float80(1) / 3 * 3, one);
  EXPECT_TRUE(std::isinf(static_cast<double>(std::numeric_limits<float80>::max() * 2)));
  EXPECT_TRUE(std::isnan(static_cast<double>(std::numeric_limits<float80>::infinity() * 0)));
}

#if defined(__SIZEOF_FLOAT128__) && defined(__x86_64__)
using Rounded = detail::RoundedTo64Bits<float128>;

class Numbers {
 public:
  /// 64 random bits, many of them at an end all alike, times two to a power of at most `most` in size.
  long double operator()(int most) {
    std::uint64_t bits = random_();
    const int length = static_cast<int>(random_() % 65);
    if (random_() % 3 == 0 && length < 64) bits = bits >> length << length;
    if (random_() % 7 == 0 && length < 64) bits |= (1ULL << length) - 1;
    const int power = static_cast<int>(random_() % static_cast<unsigned>(2 * most + 1)) - most;
    const long double size = std::scalbn(static_cast<long double>(bits | 1ULL << 63), power - 63);
    return random_() % 2 == 0 ? size : -size;
  }

 private:
  std::mt19937_64 random_{80};
};

Rounded rounded(long double x) { return Rounded(static_cast<float128>(x)); }

::testing::AssertionResult same(long double exact, Rounded computed) {
  const auto number = static_cast<float128>(exact);
  if (computed.value() == number || (number != number && computed.value() != computed.value()))
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << exact << " and " << static_cast<long double>(computed.value());
}

TEST(Float80, ComputesAsTheX87Does) {
  Numbers number;
  for (int i = 0; i < 100'000; ++i) {
    const int most = i % 3 == 0   ? 3
                     : i % 3 == 1 ? 70
                                  : 8190;  // near each other, far apart, and nearly to the ends of the range
    const long double a = number(most), b = number(most);
    ASSERT_TRUE(same(a + b, rounded(a) + rounded(b))) << a << " + " << b;
    ASSERT_TRUE(same(a - b, rounded(a) - rounded(b))) << a << " - " << b;
    ASSERT_TRUE(same(a * b, rounded(a) * rounded(b))) << a << " * " << b;
    ASSERT_TRUE(same(a / b, rounded(a) / rounded(b))) << a << " / " << b;
    const auto wide = static_cast<float128>(a) / static_cast<float128>(b);
    ASSERT_TRUE(same(static_cast<long double>(wide), Rounded(wide))) << a << " / " << b;
    ASSERT_EQ(a < b, rounded(a) < rounded(b));
    ASSERT_EQ(a == b, rounded(a) == rounded(b));
  }
}

TEST(Float80, TakesNumbersOfTheLanguageAsTheX87Does) {
  EXPECT_TRUE(same(static_cast<long double>(std::numeric_limits<std::uint64_t>::max()),
                   Rounded(std::numeric_limits<std::uint64_t>::max())));
  EXPECT_TRUE(same(0.1L + 0.1, rounded(0.1L) + 0.1));
  EXPECT_TRUE(same(3 / 0.7L, 3 / rounded(0.7L)));
  EXPECT_EQ(static_cast<double>(rounded(0.1L)), static_cast<double>(0.1L));
}
#endif

}  // namespace
}  // namespace earthtop
