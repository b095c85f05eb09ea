// SPDX-License-Identifier: GPL-3.0-or-later
/// 113-bit numbers, vectors and quaternions of the reference program. Nothing here is taken from earthtop: a program that
/// checks it must not share its mistakes.
#pragma once

#include <quadmath.h>

#include <array>
#include <string>

namespace headlines {

using Real = __float128;

inline Real pi() { return 4 * atanq(1); }

/// The number with `digits` significant digits, in a form that every program can read.
inline std::string to_text(Real x, int digits) {
  char text[64];
  quadmath_snprintf(text, sizeof text, "%.*Qe", digits - 1, x);
  return text;
}

struct Vec {
  Real x = 0, y = 0, z = 0;
  Vec& operator+=(const Vec& b) { return x += b.x, y += b.y, z += b.z, *this; }
};
inline Vec operator+(Vec a, const Vec& b) { return a += b; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(Real s, const Vec& v) { return {s * v.x, s * v.y, s * v.z}; }
inline Real dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(const Vec& a, const Vec& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline Real norm(const Vec& v) { return sqrtq(dot(v, v)); }

/// A 3x3 matrix, given by its rows.
struct Mat {
  Vec a, b, c;
};
inline Vec operator*(const Mat& m, const Vec& v) { return {dot(m.a, v), dot(m.b, v), dot(m.c, v)}; }
inline Mat transposed(const Mat& m) { return {{m.a.x, m.b.x, m.c.x}, {m.a.y, m.b.y, m.c.y}, {m.a.z, m.b.z, m.c.z}}; }
inline Mat operator*(const Mat& m, const Mat& n) {
  const Mat t = transposed(n);
  return {t * m.a, t * m.b, t * m.c};
}
/// The inverse by the reciprocal basis: its columns are cross products of the rows.
inline Mat inverse(const Mat& m) {
  const Real volume = dot(m.a, cross(m.b, m.c));
  return transposed({(1 / volume) * cross(m.b, m.c), (1 / volume) * cross(m.c, m.a), (1 / volume) * cross(m.a, m.b)});
}

/// Turns `v` by `angle` about the unit vector `k` (Rodrigues).
inline Vec turned(const Vec& k, Real angle, const Vec& v) {
  const Real s = sinq(angle), half = sinq(angle / 2);
  return v + s * cross(k, v) + (2 * half * half) * cross(k, cross(k, v));
}

struct Quat {
  Real w = 1;
  Vec v;
};
inline Quat operator*(const Quat& p, const Quat& q) {
  return {p.w * q.w - dot(p.v, q.v), p.w * q.v + q.w * p.v + cross(p.v, q.v)};
}
inline Quat conjugate(const Quat& q) { return {q.w, Real(-1) * q.v}; }
inline Real squared_norm(const Quat& q) { return q.w * q.w + dot(q.v, q.v); }
inline Quat normalized(const Quat& q) {
  const Real scale = 1 / sqrtq(squared_norm(q));
  return {scale * q.w, scale * q.v};
}
inline Quat turn(const Vec& k, Real angle) { return {cosq(angle / 2), sinq(angle / 2) * k}; }

/// The rotation matrix of q / |q|.
inline Mat matrix(const Quat& q) {
  const Real f = 2 / squared_norm(q);
  const Real w = q.w, x = q.v.x, y = q.v.y, z = q.v.z;
  return {{1 - f * (y * y + z * z), f * (x * y - w * z), f * (x * z + w * y)},
          {f * (x * y + w * z), 1 - f * (x * x + z * z), f * (y * z - w * x)},
          {f * (x * z - w * y), f * (y * z + w * x), 1 - f * (x * x + y * y)}};
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90.
struct SinCos {
  Real sin, cos;
};
inline SinCos sin_cos_degrees(Real degrees) {
  const Real quarters = rintq(degrees / 90);
  const Real rest = (degrees - 90 * quarters) * pi() / 180;
  const Real s = sinq(rest), c = cosq(rest);
  switch (static_cast<int>(fmodq(quarters, 4) + 4) % 4) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

}  // namespace headlines
