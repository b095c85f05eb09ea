// SPDX-License-Identifier: GPL-3.0-or-later
/// The type float128 where the compiler has no `__float128`: WebAssembly's long double has the same 128 bits, but it must be another
/// type, since the library distinguishes both. Sums, products, quotients and square roots are rounded as IEEE 754 prescribes, as
/// everywhere; the other functions are those of the C library.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

namespace earthtop {

class float128 {
 public:
  constexpr float128() = default;
  template <class T, std::enable_if_t<std::is_arithmetic_v<T>, int> = 0>
  constexpr float128(T value) : value_(static_cast<long double>(value)) {}
  template <class T, std::enable_if_t<std::is_arithmetic_v<T>, int> = 0>
  constexpr explicit operator T() const {
    return static_cast<T>(value_);
  }
  constexpr long double value() const { return value_; }

  constexpr float128 operator-() const { return -value_; }
  constexpr float128 operator+() const { return value_; }
  constexpr float128& operator+=(float128 other) { return *this = value_ + other.value_; }
  constexpr float128& operator-=(float128 other) { return *this = value_ - other.value_; }
  constexpr float128& operator*=(float128 other) { return *this = value_ * other.value_; }
  constexpr float128& operator/=(float128 other) { return *this = value_ / other.value_; }
  friend constexpr float128 operator+(float128 a, float128 b) { return a.value_ + b.value_; }
  friend constexpr float128 operator-(float128 a, float128 b) { return a.value_ - b.value_; }
  friend constexpr float128 operator*(float128 a, float128 b) { return a.value_ * b.value_; }
  friend constexpr float128 operator/(float128 a, float128 b) { return a.value_ / b.value_; }
  friend constexpr bool operator==(float128 a, float128 b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(float128 a, float128 b) { return a.value_ != b.value_; }
  friend constexpr bool operator<(float128 a, float128 b) { return a.value_ < b.value_; }
  friend constexpr bool operator>(float128 a, float128 b) { return a.value_ > b.value_; }
  friend constexpr bool operator<=(float128 a, float128 b) { return a.value_ <= b.value_; }
  friend constexpr bool operator>=(float128 a, float128 b) { return a.value_ >= b.value_; }

 private:
  long double value_;
};

inline float128 sqrtq(float128 x) noexcept { return std::sqrt(x.value()); }
inline float128 fmaq(float128 x, float128 y, float128 z) noexcept { return std::fma(x.value(), y.value(), z.value()); }
inline float128 roundq(float128 x) noexcept { return std::round(x.value()); }
inline float128 sinq(float128 x) noexcept { return std::sin(x.value()); }
inline float128 cosq(float128 x) noexcept { return std::cos(x.value()); }
inline float128 asinq(float128 x) noexcept { return std::asin(x.value()); }
inline float128 atan2q(float128 y, float128 x) noexcept { return std::atan2(y.value(), x.value()); }
inline float128 fmodq(float128 x, float128 y) noexcept { return std::fmod(x.value(), y.value()); }
inline float128 powq(float128 x, float128 y) noexcept { return std::pow(x.value(), y.value()); }
inline float128 logq(float128 x) noexcept { return std::log(x.value()); }
inline float128 expq(float128 x) noexcept { return std::exp(x.value()); }
inline float128 expm1q(float128 x) noexcept { return std::expm1(x.value()); }
inline float128 rintq(float128 x) noexcept { return std::rint(x.value()); }
inline float128 scalbnq(float128 x, int exponent) noexcept { return std::scalbn(x.value(), exponent); }
inline float128 frexpq(float128 x, int* exponent) noexcept { return std::frexp(x.value(), exponent); }
inline int finiteq(float128 x) noexcept { return std::isfinite(x.value()); }

}  // namespace earthtop

template <>
class std::numeric_limits<earthtop::float128> : public std::numeric_limits<long double> {
  using Base = std::numeric_limits<long double>;

 public:
  static constexpr earthtop::float128 min() { return Base::min(); }
  static constexpr earthtop::float128 max() { return Base::max(); }
  static constexpr earthtop::float128 lowest() { return Base::lowest(); }
  static constexpr earthtop::float128 epsilon() { return Base::epsilon(); }
  static constexpr earthtop::float128 infinity() { return Base::infinity(); }
  static constexpr earthtop::float128 quiet_NaN() { return Base::quiet_NaN(); }
  static constexpr earthtop::float128 denorm_min() { return Base::denorm_min(); }
};
