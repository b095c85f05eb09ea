// SPDX-License-Identifier: GPL-3.0-or-later
/// A number in both predictions: its value in the non-rotating reference, its value in the rotating motion, and their
/// difference over epsilon (see Model). Arithmetic carries the difference along without ever subtracting the two values. A
/// formula written for any scalar type thus yields its own difference without cancellation. If both values are equal, `diff` is
/// the directional derivative of the formula along the differences of its arguments.
#pragma once

#include "earthtop/vectors.hpp"

namespace earthtop {

template <class T>
struct Paired {
  T ref = T(0);
  T rot = T(0);
  T diff = T(0);  ///< (rot - ref) / epsilon

  Paired() = default;
  Paired(T constant) : ref(constant), rot(constant) {}  // NOLINT(google-explicit-constructor): the same in both
  Paired(T in_reference, T in_rotating, T difference) : ref(in_reference), rot(in_rotating), diff(difference) {}
  /// @param difference  over epsilon
  static Paired apart(const T& reference, const T& difference, const T& epsilon) {
    return {reference, reference + epsilon * difference, difference};
  }

  Paired& operator+=(const Paired& y) { return *this = *this + y; }
  Paired& operator-=(const Paired& y) { return *this = *this - y; }
  Paired& operator*=(const Paired& y) { return *this = *this * y; }
  friend Paired operator+(const Paired& x, const Paired& y) { return {x.ref + y.ref, x.rot + y.rot, x.diff + y.diff}; }
  friend Paired operator-(const Paired& x, const Paired& y) { return {x.ref - y.ref, x.rot - y.rot, x.diff - y.diff}; }
  friend Paired operator-(const Paired& x) { return {-x.ref, -x.rot, -x.diff}; }
  friend Paired operator*(const Paired& x, const Paired& y) {
    return {x.ref * y.ref, x.rot * y.rot, x.diff * y.rot + x.ref * y.diff};
  }
  friend Paired operator/(const Paired& x, const Paired& y) {
    const T quotient = x.ref / y.ref;
    return {quotient, x.rot / y.rot, (x.diff - quotient * y.diff) / y.rot};
  }
};

namespace real {

template <class T>
Paired<T> sqrt(const Paired<T>& x) {
  const T a = sqrt(x.ref), b = sqrt(x.rot);
  return {a, b, a + b > T(0) ? x.diff / (a + b) : T(0)};
}
template <class T>
Paired<T> abs(const Paired<T>& x) {
  const T a = abs(x.ref), b = abs(x.rot);
  if (!(x.ref * x.rot < T(0))) return {a, b, x.ref + x.rot < T(0) ? -x.diff : x.diff};
  return {a, b, x.diff * ((b - a) / (x.rot - x.ref))};  // signs differ: the denominator does not cancel
}
/// x^(1/5) for x >= 0; 0 for negative x.
template <class T>
T fifth_root(const T& x) {
  return x > T(0) ? pow(x, T(1) / T(5)) : T(0);
}
template <class T>
Paired<T> fifth_root(const Paired<T>& x) {
  const T a = fifth_root(x.ref), b = fifth_root(x.rot);
  const T sum = a * a * a * a + b * (a * a * a + b * (a * a + b * (a + b)));
  return {a, b, sum > T(0) ? x.diff / sum : T(0)};
}

}  // namespace real

/// A vector in both predictions.   @param difference  over epsilon
template <class T>
Vec3<Paired<T>> paired_vector(const Vec3<T>& reference, const Vec3<T>& rotating, const Vec3<T>& difference) {
  Vec3<Paired<T>> both;
  for (int i = 0; i < 3; ++i) both[i] = Paired<T>(reference[i], rotating[i], difference[i]);
  return both;
}
template <class T>
Vec3<Paired<T>> paired_vector(const Vec3<T>& reference, const Vec3<T>& difference, const T& epsilon) {
  return paired_vector(reference, Vec3<T>(reference + epsilon * difference), difference);
}
/// A vector that is the same in both predictions.
template <class T>
Vec3<Paired<T>> paired_vector(const Vec3<T>& constant) {
  return paired_vector(constant, constant, Vec3<T>(Vec3<T>::Zero()));
}
/// The vector of one prediction, or the difference: one member of each component.
template <class T>
Vec3<T> parts(const Vec3<Paired<T>>& both, T Paired<T>::*member) {
  return {both[0].*member, both[1].*member, both[2].*member};
}

/// Whether a size is above zero; for a Paired size, in both motions.
template <class T>
bool is_above_zero(const T& size) {
  return size > T(0);
}
template <class T>
bool is_above_zero(const Paired<T>& size) {
  return size.ref > T(0) && size.rot > T(0);
}

}  // namespace earthtop

namespace Eigen {
template <class T>
struct NumTraits<earthtop::Paired<T>> : GenericNumTraits<double> {
  using Real = earthtop::Paired<T>;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 3, AddCost = 3, MulCost = 6 };
};
}  // namespace Eigen
