// SPDX-License-Identifier: GPL-3.0-or-later
/// The scalar types over which every formula of earthtop is a template: double, long double and float128 (113-bit significand).
///
/// `__float128` is a built-in type of the compiler. Its functions are declared here instead of taken from quadmath.h, which
/// clang does not find; libquadmath defines them.
#pragma once

#include <cmath>
#include <limits>

#include "earthtop/elementary.hpp"

#ifdef __wasm__  // clang has no __float128 there
#include <earthtop_float128.hpp>

namespace earthtop {
#else
namespace earthtop {

using float128 = __float128;

extern "C" {
float128 sqrtq(float128) noexcept;
float128 fmaq(float128, float128, float128) noexcept;
float128 roundq(float128) noexcept;
float128 sinq(float128) noexcept;
float128 cosq(float128) noexcept;
float128 asinq(float128) noexcept;
float128 atan2q(float128, float128) noexcept;
float128 fmodq(float128, float128) noexcept;
float128 powq(float128, float128) noexcept;
float128 logq(float128) noexcept;
float128 expq(float128) noexcept;
float128 expm1q(float128) noexcept;
float128 rintq(float128) noexcept;
float128 scalbnq(float128, int) noexcept;
float128 frexpq(float128, int*) noexcept;
int finiteq(float128) noexcept;
}
#endif

/// Elementary functions with one name for every scalar type; angles in rad. Those of double are in elementary.hpp. Those of
/// float128 are libquadmath's, which run the same code on all processors. Those of long double influence double results, too,
/// because the closed forms are set up in long double. Most are the C library's, written in C. A few of the C library's are
/// processor instructions, whose last place differs between two processor makers: for these the float128 function is rounded to
/// long double. The exponential function, which every closed form calls, is the project's own, in plain arithmetic.
namespace real {

using std::fma;
using std::fmod;
using std::isfinite;
using std::rint;
using std::round;
using std::sqrt;

template <class T>
constexpr T abs(T x) {
  return x < T(0) ? -x : x;
}
inline long double asin(long double x) { return std::asin(x); }
inline long double atan2(long double y, long double x) { return static_cast<long double>(atan2q(y, x)); }
inline long double cos(long double x) { return std::cos(x); }
/// Rounds to within 0.53 units in the last place, for arguments up to 11000; beyond, as libquadmath's does.
long double exp(long double x) noexcept;
inline long double expm1(long double x) { return static_cast<long double>(expm1q(x)); }
inline long double log(long double x) { return static_cast<long double>(logq(x)); }
inline long double pow(long double x, long double y) { return std::pow(x, y); }
inline long double sin(long double x) { return std::sin(x); }
inline float128 asin(float128 x) { return asinq(x); }
inline float128 atan2(float128 y, float128 x) { return atan2q(y, x); }
inline float128 cos(float128 x) { return cosq(x); }
inline float128 exp(float128 x) { return expq(x); }
inline float128 expm1(float128 x) { return expm1q(x); }
inline float128 fma(float128 x, float128 y, float128 z) { return fmaq(x, y, z); }
inline float128 fmod(float128 x, float128 y) { return fmodq(x, y); }
inline bool isfinite(float128 x) { return finiteq(x) != 0; }
inline float128 log(float128 x) { return logq(x); }
inline float128 pow(float128 x, float128 y) { return powq(x, y); }
inline float128 rint(float128 x) { return rintq(x); }
inline float128 round(float128 x) { return roundq(x); }
inline float128 sin(float128 x) { return sinq(x); }
inline float128 sqrt(float128 x) { return sqrtq(x); }

template <class T>
SinCos<T> sin_cos(T x) {
  return {sin(x), cos(x)};
}

/// x * 2^exponent, exact unless it overflows or underflows.
inline double scale(double x, int exponent) { return std::scalbn(x, exponent); }
inline long double scale(long double x, int exponent) { return std::scalbn(x, exponent); }
inline float128 scale(float128 x, int exponent) { return scalbnq(x, exponent); }

/// The distance from 1 to the next larger number: twice the unit round-off.
template <class T>
constexpr T epsilon() {
  return std::numeric_limits<T>::epsilon();
}
template <>
constexpr float128 epsilon<float128>() {
  return static_cast<float128>(1) / (static_cast<float128>(1ULL << 56) * static_cast<float128>(1ULL << 56));
}

/// pi to the precision of T, as a sum of three doubles.
template <class T>
constexpr T pi() {
  return static_cast<T>(3.141592653589793116e+00) + static_cast<T>(1.224646799147353207e-16) +
         static_cast<T>(-2.994769809718339666e-33);
}

/// pi - pi<T>(): the rounding error of pi<T>(), to the precision of T.
template <class T>
constexpr T pi_rest();
template <>
constexpr double pi_rest() {
  return 1.2246467991473531772e-16;
}
template <>
constexpr long double pi_rest() {
  return -5.0165576126683320236e-20L;
}
template <>
constexpr float128 pi_rest() {
  return static_cast<float128>(8.6718101301237810248e-35L);
}

/// sqrt(x^2 + y^2 + z^2) without intermediate overflow or underflow: for a tiny Earth rate the deviations can be near 1e-300.
template <class T>
T hypot(T x, T y, T z = T(0)) {
  const T ax = abs(x), ay = abs(y), az = abs(z);
  const T m = ax > ay ? (ax > az ? ax : az) : (ay > az ? ay : az);
  if (!(m > T(0))) return ax + ay + az;  // 0, or NaN if one of them is
  const T sx = ax / m, sy = ay / m, sz = az / m;
  return m * sqrt(sx * sx + sy * sy + sz * sz);
}

/// A quantity that is constant along the exact motion. For a number it is the number itself; a scalar that records a Taylor
/// series takes it as constant over a step.
template <class T>
constexpr const T& conserved(const T& x) {
  return x;
}

}  // namespace real
}  // namespace earthtop
