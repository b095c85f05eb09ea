// SPDX-License-Identifier: GPL-3.0-or-later
/// The scalar types over which every formula of earthtop is a template: double, float80 (a significand of 64 bits: `long double` on
/// x86) and float128 (113 bits).
#pragma once

#include <cmath>
#include <limits>

#include "earthtop/elementary.hpp"
#include "earthtop/float128.hpp"
#include "earthtop/float80.hpp"

namespace earthtop {

/// Elementary functions with one name for every scalar type; angles in rad. Those of double are in elementary.hpp. Those of
/// float128 are libquadmath's, which run the same code on all processors. Those of float80 influence double results, too, because
/// the closed forms are set up in float80. The C library's differ in the last place between processors. So those that are called
/// often, sine, cosine and exponential function, are the project's own, in plain arithmetic; of the others the float128 function is
/// rounded to float80.
namespace real {

inline double fma(double x, double y, double z) { return std::fma(x, y, z); }
inline double fmod(double x, double y) { return std::fmod(x, y); }
inline bool isfinite(double x) { return std::isfinite(x); }
inline double rint(double x) { return std::rint(x); }
inline double round(double x) { return std::round(x); }
inline double sqrt(double x) { return std::sqrt(x); }

template <class T>
constexpr T abs(T x) {
  return x < T(0) ? -x : x;
}
inline float80 asin(float80 x) { return static_cast<float80>(asinq(static_cast<float128>(x))); }
inline float80 atan2(float80 y, float80 x) {
  return static_cast<float80>(atan2q(static_cast<float128>(y), static_cast<float128>(x)));
}
/// To within 0.53 units in the last place, for arguments up to 11000; beyond, as libquadmath's.
float80 exp(float80 x) noexcept;
/// To within 0.75 units in the last place, for arguments up to 1e6; beyond, as libquadmath's.
SinCos<float80> sin_cos(float80 x) noexcept;
inline float80 sin(float80 x) noexcept { return sin_cos(x).sin; }
inline float80 cos(float80 x) noexcept { return sin_cos(x).cos; }
inline float80 expm1(float80 x) { return static_cast<float80>(expm1q(static_cast<float128>(x))); }
inline float80 fma(float80 x, float80 y, float80 z) {
  using std::fma;
  return fma(x, y, z);
}
inline float80 fmod(float80 x, float80 y) {
  using std::fmod;
  return fmod(x, y);
}
inline bool isfinite(float80 x) {
  using std::isfinite;
  return isfinite(x);
}
inline float80 log(float80 x) { return static_cast<float80>(logq(static_cast<float128>(x))); }
inline float80 pow(float80 x, float80 y) {
  return static_cast<float80>(powq(static_cast<float128>(x), static_cast<float128>(y)));
}
inline float80 rint(float80 x) {
  using std::rint;
  return rint(x);
}
inline float80 round(float80 x) {
  using std::round;
  return round(x);
}
inline float80 sqrt(float80 x) {
  using std::sqrt;
  return sqrt(x);
}
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
inline float80 scale(float80 x, int exponent) {
  using std::scalbn;
  return scalbn(x, exponent);
}
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
constexpr float80 pi_rest() {
  return float80(-5.0165576126683320236e-20L);
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
