// SPDX-License-Identifier: GPL-3.0-or-later
/// Elementary functions of double with the same digits on every machine.
///
/// The functions of the C library choose their code by the processor, so that the last digit differs between machines. These
/// are the bit-reproducible ones of SLEEF, except for the fifth root; each has an error of at most 1 unit in the last place
/// (erfc: 1.5; atan2: 2 where the result is subnormal). Everything that reaches a result calls either these functions or the
/// square root, fma, fmod, remainder and roundings of the C library, which are exact. Angles are in rad.
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
/// Sine and cosine together, for little more than the cost of one. Either may differ in the last place from `sin` or `cos`.
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
/// x^(1/5) for positive x, else 0: within 0.53 units in the last place, from basic arithmetic operations only.
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

/// 10^exponent, correctly rounded (which `pow` is not): the same double as the literal 1e<exponent>.
[[gnu::const]] double power_of_ten(int exponent) noexcept;

}  // namespace real
}  // namespace earthtop
