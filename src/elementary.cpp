// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/elementary.hpp"

#include <sleef.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

/// SLEEF's `purec` functions are plain C, the same code for every processor; its `cinz` functions promise the same bits without
/// fused products. Added here are the ends of the number range, where SLEEF's functions overflow before their result does, or
/// lose the smallest numbers.
namespace earthtop::real {
namespace {

constexpr double kHuge = 0x1p+500;   ///< beyond it, 1 + x = x and x^2 + 1 = x^2 in double
constexpr double kTiny = 0x1p-30;    ///< below it, f(x) = x + O(x^3) equals x within half a unit in the last place
constexpr double kLargeExp = 709.0;  ///< exp is finite up to 709.78, cosh and sinh up to 710.47

/// Up to this angle (rad) the series below are used, which are three times faster; in most runs the Earth and slow platforms
/// turn by no more than this. The first omitted terms are below 1e-20, and everything that is rounded before the last sum is at
/// most a 96th of the result.
constexpr double kSmall = 0.25;

double small_sin(double x) {
  const double z = x * x, z2 = z * z;
  const double low = -1.0 / 6 + z * (1.0 / 120), middle = -1.0 / 5040 + z * (1.0 / 362880);
  const double high = -1.0 / 39916800 + z * (1.0 / 6227020800 - z * (1.0 / 1307674368000));
  return std::copysign(x + x * z * (low + z2 * (middle + z2 * high)), x);  // -0 keeps its sign
}
double small_cos(double x) {
  const double z = x * x, z2 = z * z;
  const double low = 1.0 / 24 - z * (1.0 / 720), middle = 1.0 / 40320 - z * (1.0 / 3628800);
  const double high = 1.0 / 479001600 - z * (1.0 / 87178291200);
  return 1 - (z / 2 - z2 * (low + z2 * (middle + z2 * high)));
}

/// e^|x| / 2, for |x| where e^|x| itself would overflow.
double half_exp(double size) {
  const double root = exp(size / 2);
  return root / 2 * root;
}

}  // namespace

double sin(double x) noexcept { return std::fabs(x) <= kSmall ? small_sin(x) : Sleef_cinz_sind1_u10purec(x); }
double cos(double x) noexcept { return std::fabs(x) <= kSmall ? small_cos(x) : Sleef_cinz_cosd1_u10purec(x); }
double tan(double x) noexcept { return std::fabs(x) < kTiny ? x : Sleef_cinz_tand1_u10purec(x); }
SinCos<double> sin_cos(double x) noexcept {
  if (std::fabs(x) <= kSmall) return {small_sin(x), small_cos(x)};
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(x);
  return {both.x, both.y};
}
double asin(double x) noexcept { return Sleef_cinz_asind1_u10purec(x); }
double acos(double x) noexcept { return Sleef_cinz_acosd1_u10purec(x); }
double atan(double x) noexcept { return Sleef_cinz_atand1_u10purec(x); }
double atan2(double y, double x) noexcept { return Sleef_cinz_atan2d1_u10purec(y, x); }

double exp(double x) noexcept { return Sleef_cinz_expd1_u10purec(x); }
double exp2(double x) noexcept { return Sleef_cinz_exp2d1_u10purec(x); }
double exp10(double x) noexcept { return Sleef_cinz_exp10d1_u10purec(x); }
double expm1(double x) noexcept { return Sleef_cinz_expm1d1_u10purec(x); }
double log(double x) noexcept { return Sleef_cinz_logd1_u10purec(x); }
double log2(double x) noexcept { return Sleef_cinz_log2d1_u10purec(x); }
double log10(double x) noexcept { return Sleef_cinz_log10d1_u10purec(x); }
double log1p(double x) noexcept {
  if (std::fabs(x) < 0x1p-54) return x;
  return x > kHuge ? log(x) : Sleef_cinz_log1pd1_u10purec(x);
}
double pow(double x, double y) noexcept { return y == 1 ? x : Sleef_cinz_powd1_u10purec(x, y); }
extern "C" double earthtop_pow(double x, double y) noexcept { return pow(x, y); }  // integrate/odeint_pow.hpp
double cbrt(double x) noexcept { return Sleef_cinz_cbrtd1_u10purec(x); }

double sinh(double x) noexcept {
  return std::fabs(x) > kLargeExp ? std::copysign(half_exp(std::fabs(x)), x) : Sleef_cinz_sinhd1_u10purec(x);
}
double cosh(double x) noexcept { return std::fabs(x) > kLargeExp ? half_exp(std::fabs(x)) : Sleef_cinz_coshd1_u10purec(x); }
double tanh(double x) noexcept { return Sleef_cinz_tanhd1_u10purec(x); }
double asinh(double x) noexcept {
  const double size = std::fabs(x);
  if (size < kTiny) return x;
  return size > kHuge ? std::copysign(log(size) + std::numbers::ln2, x) : Sleef_cinz_asinhd1_u10purec(x);
}
double acosh(double x) noexcept { return x > kHuge ? log(x) + std::numbers::ln2 : Sleef_cinz_acoshd1_u10purec(x); }
double atanh(double x) noexcept { return std::fabs(x) < kTiny ? x : Sleef_cinz_atanhd1_u10purec(x); }

double erf(double x) noexcept { return Sleef_cinz_erfd1_u10purec(x); }
double erfc(double x) noexcept { return Sleef_cinz_erfcd1_u15purec(x); }
double tgamma(double x) noexcept { return Sleef_cinz_tgammad1_u10purec(x); }
double lgamma(double x) noexcept { return Sleef_cinz_lgammad1_u10purec(x); }

double power_of_ten(int exponent) noexcept {
  char text[16] = {'1', 'e'};
  const char* end = std::to_chars(text + 2, text + sizeof text, exponent).ptr;
  double value = 0;
  if (std::from_chars(text, end, value).ec == std::errc::result_out_of_range)
    return exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return value;
}

}  // namespace earthtop::real
