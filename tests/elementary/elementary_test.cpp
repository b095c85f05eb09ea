// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "earthtop/real.hpp"

// libquadmath's, beside those that float128.hpp declares; or the C library's.
#ifdef __SIZEOF_FLOAT128__
#define EARTHTOP_QUAD(name) extern "C" earthtop::float128 name##q(earthtop::float128) noexcept;
#else
#define EARTHTOP_QUAD(name) \
  static earthtop::float128 name##q(earthtop::float128 x) noexcept { return std::name(x); }
#endif
EARTHTOP_QUAD(tan)
EARTHTOP_QUAD(acos)
EARTHTOP_QUAD(atan)
EARTHTOP_QUAD(exp2)
EARTHTOP_QUAD(log2)
EARTHTOP_QUAD(log10)
EARTHTOP_QUAD(log1p)
EARTHTOP_QUAD(cbrt)
EARTHTOP_QUAD(sinh)
EARTHTOP_QUAD(cosh)
EARTHTOP_QUAD(tanh)
EARTHTOP_QUAD(asinh)
EARTHTOP_QUAD(acosh)
EARTHTOP_QUAD(atanh)
EARTHTOP_QUAD(erf)
EARTHTOP_QUAD(erfc)
EARTHTOP_QUAD(tgamma)
EARTHTOP_QUAD(lgamma)
#undef EARTHTOP_QUAD

namespace earthtop {
namespace {

/// The error in units in the last place of the exact value; infinite if the result overflows though the exact value does not.
double error_ulp(double computed, float128 exact) {
  const double rounded = static_cast<double>(exact);
  if (std::isnan(rounded) || std::isinf(rounded))
    return (std::isnan(rounded) ? std::isnan(computed) : computed == rounded) ? 0 : INFINITY;
  if (!std::isfinite(computed)) return INFINITY;
  int exponent = 0;
  std::frexp(rounded, &exponent);
  const float128 error = real::abs(float128(computed) - exact);
  return static_cast<double>(real::scale(error, -std::max(exponent - 53, -1074)));
}

/// Random arguments whose binary exponents are spread evenly from `low` to `high`, of both signs or of one.
class Arguments {
 public:
  double operator()(double low, double high, bool positive) {
    const double size = std::exp2(low + (high - low) * uniform());
    return positive || uniform() < 0.5 ? size : -size;
  }

 private:
  double uniform() { return static_cast<double>(generator_() >> 11U) * 0x1p-53; }
  std::mt19937_64 generator_{20261122};
};

struct Function {
  const char* name;
  double (*computed)(double) noexcept;
  float128 (*exact)(float128) noexcept;
  double (*c_library)(double);
  double low, high;  ///< binary exponents of the arguments
  bool positive = false;
  double claim_ulp = 1;  ///< largest error (ulp) that the function's header states
};

double sine_of_pair(double x) noexcept { return real::sin_cos(x).sin; }
double cosine_of_pair(double x) noexcept { return real::sin_cos(x).cos; }
float128 exp10q(float128 x) noexcept { return powq(10, x); }
float128 fifth_root_q(float128 x) noexcept { return powq(x, float128(1) / 5); }
double fifth_root_by_pow(double x) { return x > 0 ? static_cast<double>(std::pow(static_cast<long double>(x), 0.2L)) : 0; }

const std::vector<Function> kFunctions = {
    {"sin", real::sin, sinq, std::sin, -1074, 1023.9},
    {"sin, cos", sine_of_pair, sinq, std::sin, -1074, 1023.9},
    {"cos", real::cos, cosq, std::cos, -1074, 1023.9},
    {"sin, cos", cosine_of_pair, cosq, std::cos, -1074, 1023.9},
    {"tan", real::tan, tanq, std::tan, -1074, 1023.9},
    {"asin", real::asin, asinq, std::asin, -1074, 0},
    {"acos", real::acos, acosq, std::acos, -1074, 0},
    {"atan", real::atan, atanq, std::atan, -1074, 1023.9},
    {"exp", real::exp, expq, std::exp, -60, 9.45},
    {"exp2", real::exp2, exp2q, std::exp2, -60, 9.95},
    {"exp10", real::exp10, exp10q, ::exp10, -60, 8.2},
    {"expm1", real::expm1, expm1q, std::expm1, -1074, 9.45},
    {"log", real::log, logq, std::log, -1074, 1023.9, true},
    {"log2", real::log2, log2q, std::log2, -1074, 1023.9, true},
    {"log10", real::log10, log10q, std::log10, -1074, 1023.9, true},
    {"log1p", real::log1p, log1pq, std::log1p, -1074, 1023.9, true},
    {"cbrt", real::cbrt, cbrtq, std::cbrt, -1020, 1023.9},
    {"fifth root", real::fifth_root, fifth_root_q, fifth_root_by_pow, -1074, 1023.9, true, 0.53},
    {"sinh", real::sinh, sinhq, std::sinh, -1074, 9.4725},
    {"cosh", real::cosh, coshq, std::cosh, -1074, 9.4725},
    {"tanh", real::tanh, tanhq, std::tanh, -1074, 1023.9},
    {"asinh", real::asinh, asinhq, std::asinh, -1074, 1023.9},
    {"acosh", real::acosh, acoshq, std::acosh, 0, 1023.9, true},
    {"atanh", real::atanh, atanhq, std::atanh, -1074, 0},
    {"erf", real::erf, erfq, std::erf, -1020, 4},
    {"erfc", real::erfc, erfcq, std::erfc, -60, 4.7, false, 1.5},
    {"tgamma", real::tgamma, tgammaq, std::tgamma, -20, 7.4, true},
    {"lgamma", real::lgamma, lgammaq, std::lgamma, 1.6, 1000, true},
};

TEST(Elementary, AreWithinAnUlpFromTheLeastArgumentToTheLargest) {
  for (const Function& f : kFunctions) {
    Arguments arguments;
    double worst = 0, at = 0;
    const auto include = [&](double x) {
      const double error = error_ulp(f.computed(x), f.exact(x));
      if (error > worst) worst = error, at = x;
    };
    for (int i = 0; i < 4000; ++i) include(arguments(f.low, f.high, f.positive));
    // The range of most arguments in practice: a few turns, numbers of ordinary size.
    for (int i = 0; i < 4000; ++i) include(arguments(std::max(f.low, -6.0), std::min(f.high, 6.0), f.positive));
    EXPECT_LE(worst, f.claim_ulp) << f.name << " at " << at;
  }
}

/// The C standard's rules for zeros, infinities and NaN.
TEST(Elementary, SpecialValuesAreThoseOfTheCLibrary) {
  const double inf = INFINITY, least = std::numeric_limits<double>::denorm_min(), largest = std::numeric_limits<double>::max();
  const std::vector<double> special = {0.0,  -0.0, 1.0,  -1.0, 2.0,   -2.0,   0.5,     3.0,
                                       -3.0, inf,  -inf, NAN,  least, -least, largest, -largest};
  const auto same = [](double a, double b) {
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
    // The last place of ordinary values is the subject of another test.
    return a == b ? std::signbit(a) == std::signbit(b)
                  : std::isfinite(a) && std::isfinite(b) && std::fabs(a - b) < 1e-15 * std::fabs(b);
  };
  for (const Function& f : kFunctions)
    for (const double x : special)
      EXPECT_TRUE(same(f.computed(x), f.c_library(x))) << f.name << ' ' << x << ": " << f.computed(x);
  for (const double x : special)
    for (const double y : special) {
      EXPECT_TRUE(same(real::atan2(y, x), std::atan2(y, x))) << y << ' ' << x << ": " << real::atan2(y, x);
      EXPECT_TRUE(same(real::pow(x, y), std::pow(x, y))) << x << ' ' << y << ": " << real::pow(x, y);
    }
}

TEST(Elementary, FunctionsOfTwoArgumentsAreWithinAnUlp) {
  Arguments arguments;
  double worst_pow = 0, worst_angle = 0, worst_tiny_angle = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = arguments(-1000, 1000, true), exponent = arguments(-10, 8, false);
    const float128 power = powq(x, exponent);
    if (power > std::numeric_limits<double>::min() && power < std::numeric_limits<double>::max())
      worst_pow = std::max(worst_pow, error_ulp(real::pow(x, exponent), power));
    const double a = arguments(-1074, 1020, false), b = arguments(-1074, 1020, false);
    const float128 angle = atan2q(a, b);
    double& worst = std::fabs(static_cast<double>(angle)) < std::numeric_limits<double>::min() ? worst_tiny_angle : worst_angle;
    worst = std::max(worst, error_ulp(real::atan2(a, b), angle));
  }
  EXPECT_LE(worst_pow, 1);
  EXPECT_LE(worst_angle, 1);
  EXPECT_LE(worst_tiny_angle, 2);  // rounded twice
}

TEST(Elementary, PowersOfTenAreTheLiterals) {
  for (int n = -340; n <= 310; ++n) {
    const double literal = std::strtod(("1e" + std::to_string(n)).c_str(), nullptr);
    EXPECT_EQ(real::power_of_ten(n), literal) << n;
    // Places of digits and decades of pictures are found by rounding log10 down, which must not fall short of a whole number.
    if (literal >= std::numeric_limits<double>::min() && std::isfinite(literal)) {
      EXPECT_EQ(real::log10(literal), n);
    }
  }
  for (int n = -1074; n <= 1023; ++n) EXPECT_EQ(real::log2(std::ldexp(1.0, n)), n);
}

TEST(Elementary, FifthRootsOfFifthPowersAreExact) {
  for (int n = 1; n <= 1552; ++n) {  // up to 2^53
    const double power = static_cast<double>(std::int64_t{1} * n * n * n * n * n);
    EXPECT_EQ(real::fifth_root(power), n);
    EXPECT_EQ(real::fifth_root(std::ldexp(power, -1070)),
              std::ldexp(n, -214));  // among them numbers below the least normal one
  }
}

/// Angles after a spin of 1e6 rad/s for an hour, and for the age of the Earth.
TEST(Elementary, HugeAnglesAreReducedExactly) {
  EXPECT_LE(error_ulp(real::sin(3.6e9), sinq(3.6e9)), 1);
  EXPECT_LE(error_ulp(real::cos(1.4e23), cosq(1.4e23)), 1);
  EXPECT_LE(error_ulp(real::sin(1e22), float128(-0.85220084976718880177L)), 1);  // from 60 digits
}

/// The error in units in the last place of float80.
double error_ulp(float80 computed, float128 exact) {
  int exponent = 0;
  frexpq(exact, &exponent);
  return static_cast<double>(real::scale(real::abs(static_cast<float128>(computed) - exact), 64 - exponent));
}

/// Sums of doubles of different size fill all 64 bits.
float80 filled(double x, Arguments& random) {
  return static_cast<float80>(x) * (1 + static_cast<float80>(random(-60, -1, false)));
}

/// Over all exponents and both signs, with the ends of the range.
TEST(Elementary, ExponentialOfFloat80IsRoundedAlmostCorrectly) {
  static_assert(std::numeric_limits<float80>::digits == 64);
  Arguments random;
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const float80 x = filled(random(-70, 13.4, false), random);
    if (real::abs(x) < 10900) worst = std::max(worst, error_ulp(real::exp(x), expq(static_cast<float128>(x))));
  }
  EXPECT_LT(worst, 0.53);
  EXPECT_GT(worst, 0.4);
  EXPECT_EQ(real::exp(float80(0)), 1);
  EXPECT_EQ(real::exp(-std::numeric_limits<float80>::infinity()), 0);
  EXPECT_EQ(real::exp(float80(12000)), std::numeric_limits<float80>::infinity());
  EXPECT_TRUE(std::isnan(static_cast<double>(real::exp(std::numeric_limits<float80>::quiet_NaN()))));
}

/// Tiny to huge angles; and angles near a multiple of a quarter turn, where one of the two is next to nothing.
TEST(Elementary, SineAndCosineOfFloat80AreRoundedAlmostCorrectly) {
  Arguments random;
  double worst = 0;
  const auto look = [&](float80 x) {
    const SinCos<float80> both = real::sin_cos(x);
    worst = std::max(
        {worst, error_ulp(both.sin, sinq(static_cast<float128>(x))), error_ulp(both.cos, cosq(static_cast<float128>(x)))});
    ASSERT_EQ(both.sin, real::sin(x));
    ASSERT_EQ(both.cos, real::cos(x));
  };
  for (int i = 0; i < 100'000; ++i) {
    look(filled(random(-70, 30, false), random));
    look(filled(random(-3, 3, false), random));
    const float80 multiple = std::rint(random(0, 20, false));
    look(multiple * (real::pi<float80>() / 2) + static_cast<float80>(random(-70, -20, false)));
  }
  EXPECT_LT(worst, 0.75);
  EXPECT_GT(worst, 0.4);
  EXPECT_EQ(real::sin(float80(0)), 0);
  EXPECT_EQ(real::cos(float80(0)), 1);
  EXPECT_TRUE(std::isnan(static_cast<double>(real::sin(std::numeric_limits<float80>::infinity()))));
}

}  // namespace
}  // namespace earthtop
