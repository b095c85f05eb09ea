// SPDX-License-Identifier: GPL-3.0-or-later
/// Elementary functions of double with the same digits on every machine.
///
/// The C library's choose their code by the processor, and so their last digit. These are SLEEF's bit-reproducible ones, but
/// for the fifth root, each within 1 unit in the last place (erfc: 1.5; atan2: 2 where the result is subnormal). Everything
/// that reaches a result calls them, or the square root, fma, fmod, remainder and roundings of the C library, which are exact.
/// Angles in rad.
#pragma once

namespace earthtop {

template <class T>
struct SinCos {
  T sin;
  T cos;
};

namespace real {

[[gnu::const]] double sin(double x) noexcept;
[[gnu::const]] double cos(double x) noexcept;
[[gnu::const]] double tan(double x) noexcept;
/// Both for little more than the price of one. Either may differ from its own function in the last place.
[[gnu::const]] SinCos<double> sin_cos(double x) noexcept;
[[gnu::const]] double asin(double x) noexcept;
[[gnu::const]] double acos(double x) noexcept;
[[gnu::const]] double atan(double x) noexcept;
[[gnu::const]] double atan2(double y, double x) noexcept;

[[gnu::const]] double exp(double x) noexcept;
[[gnu::const]] double exp2(double x) noexcept;
[[gnu::const]] double exp10(double x) noexcept;
[[gnu::const]] double expm1(double x) noexcept;
[[gnu::const]] double log(double x) noexcept;
[[gnu::const]] double log2(double x) noexcept;
[[gnu::const]] double log10(double x) noexcept;
[[gnu::const]] double log1p(double x) noexcept;
[[gnu::const]] double pow(double x, double y) noexcept;
[[gnu::const]] double cbrt(double x) noexcept;
/// x^(1/5) where x is positive, else 0: within 0.53 units in the last place, by exact arithmetic operations only.
[[gnu::const]] double fifth_root(double x) noexcept;

[[gnu::const]] double sinh(double x) noexcept;
[[gnu::const]] double cosh(double x) noexcept;
[[gnu::const]] double tanh(double x) noexcept;
[[gnu::const]] double asinh(double x) noexcept;
[[gnu::const]] double acosh(double x) noexcept;
[[gnu::const]] double atanh(double x) noexcept;

[[gnu::const]] double erf(double x) noexcept;
[[gnu::const]] double erfc(double x) noexcept;
[[gnu::const]] double tgamma(double x) noexcept;
/// log |Gamma(x)|
[[gnu::const]] double lgamma(double x) noexcept;

/// 10^exponent as the literal has it: correctly rounded, which pow is not.
[[gnu::const]] double power_of_ten(int exponent) noexcept;

}  // namespace real
}  // namespace earthtop
