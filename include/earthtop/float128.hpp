// SPDX-License-Identifier: GPL-3.0-or-later
/// float128, a number with a significand of 113 bits, and its functions: the compiler's `__float128` with libquadmath; where the
/// compiler has none, as for arm64 and WebAssembly, `long double`, which has the same 128 bits there.
///
/// libquadmath's functions are declared here instead of taken from quadmath.h, which clang does not find.
#pragma once

#ifdef __SIZEOF_FLOAT128__

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

}  // namespace earthtop

#else

#include <cmath>
#include <limits>

namespace earthtop {

static_assert(std::numeric_limits<long double>::digits == 113, "neither __float128 nor a long double of 113 bits");
using float128 = long double;

inline float128 sqrtq(float128 x) noexcept { return std::sqrt(x); }
inline float128 fmaq(float128 x, float128 y, float128 z) noexcept { return std::fma(x, y, z); }
inline float128 roundq(float128 x) noexcept { return std::round(x); }
inline float128 sinq(float128 x) noexcept { return std::sin(x); }
inline float128 cosq(float128 x) noexcept { return std::cos(x); }
inline float128 asinq(float128 x) noexcept { return std::asin(x); }
inline float128 atan2q(float128 y, float128 x) noexcept { return std::atan2(y, x); }
inline float128 fmodq(float128 x, float128 y) noexcept { return std::fmod(x, y); }
inline float128 powq(float128 x, float128 y) noexcept { return std::pow(x, y); }
inline float128 logq(float128 x) noexcept { return std::log(x); }
inline float128 expq(float128 x) noexcept { return std::exp(x); }
inline float128 expm1q(float128 x) noexcept { return std::expm1(x); }
inline float128 rintq(float128 x) noexcept { return std::rint(x); }
inline float128 scalbnq(float128 x, int exponent) noexcept { return std::scalbn(x, exponent); }
inline float128 frexpq(float128 x, int* exponent) noexcept { return std::frexp(x, exponent); }
inline int finiteq(float128 x) noexcept { return std::isfinite(x); }

}  // namespace earthtop

#endif
