// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of recorded results (paired.hpp). Of a pair made by `apart`, and of all that is computed from it, the series of the
/// rotating motion is the reference's plus epsilon times the difference's, a sum in place of a product of its own: of four products
/// of series, three are left.
#pragma once

#include "integrate/taylor/recorded.hpp"
//
#include "earthtop/model/paired.hpp"

namespace earthtop {

template <class U>
struct Paired<real::Recorded<U>> {
  using T = real::Recorded<U>;
  T ref, rot, diff;
  bool is_apart = false;  ///< whether rot is ref + epsilon diff; otherwise it is computed like ref
  U epsilon = U(0);

  Paired() = default;
  Paired(T constant) : ref(constant), rot(constant) {}  // NOLINT(google-explicit-constructor): the same in both
  Paired(T in_reference, T in_rotating, T difference) : ref(in_reference), rot(in_rotating), diff(difference) {}
  /// A pair with another difference.   @param scale  epsilon, a number
  static Paired apart(const T& reference, const T& difference, const T& scale) {
    Paired made(reference, reference + scale * difference, difference);
    if (scale.is_number()) made.is_apart = true, made.epsilon = scale.value();
    return made;
  }

  Paired& operator+=(const Paired& y) { return *this = *this + y; }
  Paired& operator-=(const Paired& y) { return *this = *this - y; }
  Paired& operator*=(const Paired& y) { return *this = *this * y; }
  friend Paired operator+(const Paired& x, const Paired& y) {
    if (x.is_apart || y.is_apart) return apart(x.ref + y.ref, x.diff + y.diff, common(x, y));
    return {x.ref + y.ref, x.rot + y.rot, x.diff + y.diff};
  }
  friend Paired operator-(const Paired& x, const Paired& y) {
    if (x.is_apart || y.is_apart) return apart(x.ref - y.ref, x.diff - y.diff, common(x, y));
    return {x.ref - y.ref, x.rot - y.rot, x.diff - y.diff};
  }
  friend Paired operator-(const Paired& x) { return scaled(x, T(-1)); }
  friend Paired operator*(const Paired& x, const Paired& y) {
    if (is_fixed(x)) return scaled(y, x.ref);
    if (is_fixed(y)) return scaled(x, y.ref);
    if (x.is_apart || y.is_apart) return apart(x.ref * y.ref, x.diff * y.rot + x.ref * y.diff, common(x, y));
    return {x.ref * y.ref, x.rot * y.rot, x.diff * y.rot + x.ref * y.diff};
  }
  friend Paired operator/(const Paired& x, const Paired& y) {
    const T quotient = x.ref / y.ref;
    if (x.is_apart || y.is_apart) return apart(quotient, (x.diff - quotient * y.diff) / y.rot, common(x, y));
    return {quotient, x.rot / y.rot, (x.diff - quotient * y.diff) / y.rot};
  }

 private:
  /// Whether a pair is a number that is the same in both.
  static bool is_fixed(const Paired& x) {
    return !x.is_apart && x.ref.is_number() && x.rot.is_number() && x.diff.is_number() && x.diff == T(0) && x.rot == x.ref;
  }
  /// Products by a number are not written out again, so that the recording recognises them.
  static Paired scaled(const Paired& x, const T& factor) {
    Paired made(x.ref * factor, x.rot * factor, x.diff * factor);
    made.is_apart = x.is_apart, made.epsilon = x.epsilon;
    return made;
  }
  static T common(const Paired& x, const Paired& y) { return x.is_apart ? x.epsilon : y.epsilon; }
};

/// A size above 0 of pairs made by `apart` is taken to stay above 0: it is a sum of squares, which ends at no step at 0. No guard is
/// noted, which every step would have to ask.
template <class U>
bool is_above_zero(const Paired<real::Recorded<U>>& size) {
  using T = real::Recorded<U>;
  if (size.is_apart && size.ref.value() > U(0) && size.rot.value() > U(0)) return true;
  return size.ref > T(0) && size.rot > T(0);
}

namespace real {

template <class U>
Paired<Recorded<U>> sqrt(const Paired<Recorded<U>>& x) {
  using T = Recorded<U>;
  const T a = sqrt(x.ref), b = sqrt(x.rot);
  const bool is_above = x.is_apart && a.value() + b.value() > U(0) ? true : a + b > T(0);
  Paired<T> root(a, b, is_above ? x.diff / (a + b) : T(0));
  root.is_apart = x.is_apart, root.epsilon = x.epsilon;
  return root;
}

}  // namespace real
}  // namespace earthtop
