// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers and vectors with their first and second time derivative.
#pragma once

#include "extended.hpp"

namespace headlines {

/// A number with its first and second time derivative.
struct Jet {
  Real value = 0, first = 0, second = 0;
};
inline Jet operator+(const Jet& a, const Jet& b) { return {a.value + b.value, a.first + b.first, a.second + b.second}; }
inline Jet operator-(const Jet& a, const Jet& b) { return {a.value - b.value, a.first - b.first, a.second - b.second}; }
inline Jet operator*(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}
inline Jet sine(const Jet& a) {
  const Real s = sinq(a.value), c = cosq(a.value);
  return {s, c * a.first, c * a.second - s * a.first * a.first};
}
inline Jet cosine(const Jet& a) {
  const Real s = sinq(a.value), c = cosq(a.value);
  return {c, -s * a.first, -s * a.second - c * a.first * a.first};
}
struct JetVec {
  Jet x, y, z;
};
/// Rodrigues' formula for a time-dependent angle.
inline JetVec turned(const Vec& k, const Jet& angle, const JetVec& v) {
  const Jet s = sine(angle), c = cosine(angle), one{1, 0, 0};
  const Jet kx{k.x, 0, 0}, ky{k.y, 0, 0}, kz{k.z, 0, 0};
  const Jet along = (one - c) * (kx * v.x + ky * v.y + kz * v.z);
  return {c * v.x + s * (ky * v.z - kz * v.y) + along * kx, c * v.y + s * (kz * v.x - kx * v.z) + along * ky,
          c * v.z + s * (kx * v.y - ky * v.x) + along * kz};
}

}  // namespace headlines
