// SPDX-License-Identifier: GPL-3.0-or-later
/// float80, a number with a significand of 64 bits and an exponent of 15: `long double` on x86. Where `long double` has 113 bits, as
/// for arm64 and WebAssembly, every result is rounded to 64, so that double runs, whose closed forms are set up in float80, have the
/// digits that they have on x86.
///
/// A result is rounded twice there, first to 113 bits. That differs from rounding once where the first rounding ends exactly between
/// two neighbours of 64 bits. For sums, products and quotients the exact result then decides. Roots and functions, of which one in
/// 2^49 might be concerned, are left as they are.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

namespace earthtop {
namespace detail {

/// A number that RoundedTo64Bits takes as it takes one of its own.
template <class T, class LongDouble>
concept Narrower = std::is_arithmetic_v<T> && !std::is_same_v<T, LongDouble>;

/// A long double of 113 bits that holds numbers of 64 bits alone.
template <class LongDouble>
class RoundedTo64Bits {
 public:
  constexpr RoundedTo64Bits() = default;
  template <Narrower<LongDouble> T>
  constexpr RoundedTo64Bits(T value) : value_(rounded(static_cast<LongDouble>(value))) {}
  constexpr explicit RoundedTo64Bits(LongDouble value) : value_(rounded(value)) {}
  constexpr operator LongDouble() const { return value_; }
  template <Narrower<LongDouble> T>
  constexpr explicit operator T() const {
    return static_cast<T>(value_);
  }
  constexpr LongDouble value() const { return value_; }

  constexpr RoundedTo64Bits operator-() const { return exact(-value_); }
  constexpr RoundedTo64Bits operator+() const { return *this; }
  constexpr RoundedTo64Bits& operator+=(RoundedTo64Bits other) { return *this = *this + other; }
  constexpr RoundedTo64Bits& operator-=(RoundedTo64Bits other) { return *this = *this - other; }
  constexpr RoundedTo64Bits& operator*=(RoundedTo64Bits other) { return *this = *this * other; }
  constexpr RoundedTo64Bits& operator/=(RoundedTo64Bits other) { return *this = *this / other; }
  friend constexpr RoundedTo64Bits operator+(RoundedTo64Bits a, RoundedTo64Bits b) { return sum(a.value_, b.value_); }
  friend constexpr RoundedTo64Bits operator-(RoundedTo64Bits a, RoundedTo64Bits b) { return sum(a.value_, -b.value_); }
  friend constexpr RoundedTo64Bits operator*(RoundedTo64Bits a, RoundedTo64Bits b) {
    const LongDouble product = a.value_ * b.value_;
    return is_between(product) ? toward(product, product_error(a.value_, b.value_, product)) : RoundedTo64Bits(product);
  }
  friend constexpr RoundedTo64Bits operator/(RoundedTo64Bits a, RoundedTo64Bits b) {
    const LongDouble quotient = a.value_ / b.value_;
    if (!is_between(quotient)) return RoundedTo64Bits(quotient);
    // The quotient is a number of 64 bits and a half of its last place.
    const LongDouble near = cut(quotient, kBetween), product = near * b.value_, half = (quotient - near) * b.value_;
    const LongDouble rest = ((a.value_ - product) - half) - product_error(near, b.value_, product);
    return toward(quotient, b.value_ < 0 ? -rest : rest);
  }
  friend constexpr bool operator==(RoundedTo64Bits a, RoundedTo64Bits b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(RoundedTo64Bits a, RoundedTo64Bits b) { return a.value_ != b.value_; }
  friend constexpr bool operator<(RoundedTo64Bits a, RoundedTo64Bits b) { return a.value_ < b.value_; }
  friend constexpr bool operator<=(RoundedTo64Bits a, RoundedTo64Bits b) { return a.value_ <= b.value_; }
  friend constexpr bool operator>(RoundedTo64Bits a, RoundedTo64Bits b) { return a.value_ > b.value_; }
  friend constexpr bool operator>=(RoundedTo64Bits a, RoundedTo64Bits b) { return a.value_ >= b.value_; }

// With numbers of the language; otherwise those would be as near to the operators of LongDouble.
#define EARTHTOP_MIXED(op, Result)                              \
  template <Narrower<LongDouble> T>                             \
  friend constexpr Result operator op(RoundedTo64Bits a, T b) { \
    return a op RoundedTo64Bits(b);                             \
  }                                                             \
  template <Narrower<LongDouble> T>                             \
  friend constexpr Result operator op(T a, RoundedTo64Bits b) { \
    return RoundedTo64Bits(a) op b;                             \
  }
  EARTHTOP_MIXED(+, RoundedTo64Bits)
  EARTHTOP_MIXED(-, RoundedTo64Bits)
  EARTHTOP_MIXED(*, RoundedTo64Bits)
  EARTHTOP_MIXED(/, RoundedTo64Bits)
  EARTHTOP_MIXED(==, bool)
  EARTHTOP_MIXED(!=, bool)
  EARTHTOP_MIXED(<, bool)
  EARTHTOP_MIXED(<=, bool)
  EARTHTOP_MIXED(>, bool)
  EARTHTOP_MIXED(>=, bool)
#undef EARTHTOP_MIXED

 private:
  using Bits = unsigned __int128;
  static constexpr Bits bits_of(LongDouble x) { return __builtin_bit_cast(Bits, x); }
  static constexpr LongDouble of_bits(Bits bits) { return __builtin_bit_cast(LongDouble, bits); }
  static constexpr Bits kLast = static_cast<Bits>(1) << 49, kBetween = kLast / 2, kSign = static_cast<Bits>(1) << 127;
  static constexpr bool is_finite(LongDouble x) { return (bits_of(x) & ~kSign) < static_cast<Bits>(0x7fff) << 112; }

  /// To the nearest number of 64 bits, of two equally near ones the even one; also below the normal numbers, where both formats have
  /// 49 places between their last ones. Infinity and NaN stay.
  static constexpr LongDouble rounded(LongDouble x) {
    if (!is_finite(x)) return x;
    const Bits bits = bits_of(x);
    return of_bits((bits + (kBetween - 1 + ((bits & kLast) != 0 ? 1 : 0))) & ~(kLast - 1));
  }
  /// Whether a finite x lies exactly between two neighbours of 64 bits.
  static constexpr bool is_between(LongDouble x) { return (bits_of(x) & (kLast - 1)) == kBetween && is_finite(x); }
  /// x without the places of `part` and those below, towards zero.
  static constexpr LongDouble cut(LongDouble x, Bits part) { return of_bits(bits_of(x) & ~(2 * part - 1)); }
  /// An x between two neighbours, where the exact result is x plus something of the sign of `rest`.
  static constexpr RoundedTo64Bits toward(LongDouble x, LongDouble rest) {
    if (rest == 0) return RoundedTo64Bits(x);
    return RoundedTo64Bits(of_bits((rest > 0) == (x > 0) ? bits_of(x) + 1 : bits_of(x) - 1));
  }
  static constexpr RoundedTo64Bits sum(LongDouble a, LongDouble b) {
    const LongDouble all = a + b;
    if (!is_between(all)) return RoundedTo64Bits(all);
    const LongDouble of_b = all - a;
    return toward(all, (a - (all - of_b)) + (b - of_b));  // the rounding error (Knuth)
  }
  /// a b - product for numbers of 64 bits: one factor in two halves, whose products are exact.
  static constexpr LongDouble product_error(LongDouble a, LongDouble b, LongDouble product) {
    const LongDouble high = cut(a, static_cast<Bits>(1) << 80);
    return (high * b - product) + (a - high) * b;
  }
  static constexpr RoundedTo64Bits exact(LongDouble value) {
    RoundedTo64Bits number;
    number.value_ = value;
    return number;
  }
  LongDouble value_;
};

template <class L>
RoundedTo64Bits<L> scalbn(RoundedTo64Bits<L> x, int exponent) {
  return RoundedTo64Bits<L>(std::scalbn(x.value(), exponent));
}
template <class L>
bool isfinite(RoundedTo64Bits<L> x) {
  return std::isfinite(x.value());
}
template <class L>
bool isinf(RoundedTo64Bits<L> x) {
  return std::isinf(x.value());
}
template <class L>
bool isnan(RoundedTo64Bits<L> x) {
  return std::isnan(x.value());
}
template <class L>
RoundedTo64Bits<L> abs(RoundedTo64Bits<L> x) {
  return RoundedTo64Bits<L>(std::abs(x.value()));
}
template <class L>
RoundedTo64Bits<L> sqrt(RoundedTo64Bits<L> x) {
  return RoundedTo64Bits<L>(std::sqrt(x.value()));
}
template <class L>
RoundedTo64Bits<L> rint(RoundedTo64Bits<L> x) {
  return RoundedTo64Bits<L>(std::rint(x.value()));
}
template <class L>
RoundedTo64Bits<L> round(RoundedTo64Bits<L> x) {
  return RoundedTo64Bits<L>(std::round(x.value()));
}
template <class L>
RoundedTo64Bits<L> fma(RoundedTo64Bits<L> x, RoundedTo64Bits<L> y, RoundedTo64Bits<L> z) {
  return RoundedTo64Bits<L>(std::fma(x.value(), y.value(), z.value()));
}
template <class L>
RoundedTo64Bits<L> pow(RoundedTo64Bits<L> x, RoundedTo64Bits<L> y) {
  return RoundedTo64Bits<L>(std::pow(x.value(), y.value()));
}
template <class L>
RoundedTo64Bits<L> fmod(RoundedTo64Bits<L> x, RoundedTo64Bits<L> y) {
  return RoundedTo64Bits<L>(std::fmod(x.value(), y.value()));
}

}  // namespace detail

/// A name of its own where `long double` has other digits.
template <class LongDouble>
struct Float80 {
  static_assert(std::numeric_limits<LongDouble>::digits == 113, "long double has neither 64 bits nor 113");
  using type = detail::RoundedTo64Bits<LongDouble>;
};
template <class LongDouble>
requires(std::numeric_limits<LongDouble>::digits == 64) struct Float80<LongDouble> {
  using type = LongDouble;
};
using float80 = typename Float80<long double>::type;

}  // namespace earthtop

template <class L>
class std::numeric_limits<earthtop::detail::RoundedTo64Bits<L>> : public std::numeric_limits<L> {
  using Base = std::numeric_limits<L>;
  using Number = earthtop::detail::RoundedTo64Bits<L>;

 public:
  static constexpr int digits = 64, digits10 = 18, max_digits10 = 21;
  static constexpr Number min() { return Number(Base::min()); }
  static constexpr Number max() {
    return Number(__builtin_bit_cast(L, __builtin_bit_cast(unsigned __int128, Base::max()) >> 49 << 49));
  }
  static constexpr Number lowest() { return -max(); }
  static constexpr Number epsilon() { return Number(0x1p-63); }
  static constexpr Number infinity() { return Number(Base::infinity()); }
  static constexpr Number quiet_NaN() { return Number(Base::quiet_NaN()); }
  static constexpr Number denorm_min() { return Number(0x1p-16445L); }
};
