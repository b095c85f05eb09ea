// SPDX-License-Identifier: GPL-3.0-or-later
/// Rotations: `Quaternion` for the integrated states, `Rotation` for composing frames.
///
/// R_AB takes components in B to components in A:  v_A = R_AB v_B,  R_AC = R_AB R_BC.
#pragma once

#include "earthtop/members.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {

/// A quaternion w + v, not necessarily of unit norm. q_AB takes components in B to components in A.
template <class T>
struct Quaternion {
  T w = T(1);
  Vec3<T> v = Vec3<T>::Zero();
  EARTHTOP_MEMBERS(w, v)

  Quaternion conjugate() const { return {w, -v}; }
  T squared_norm() const { return w * w + v.dot(v); }
  Quaternion normalized() const {
    const T n = real::hypot(w, norm(v));
    return {w / n, v / n};
  }
  friend Quaternion operator*(const Quaternion& p, const Quaternion& q) {
    return {p.w * q.w - p.v.dot(q.v), p.w * q.v + q.w * p.v + p.v.cross(q.v)};
  }
};

/// The rotation matrix of q / |q|, given s = 2 / |q|^2.
template <class T>
Mat3<T> scaled_rotation_matrix(const Quaternion<T>& q, const T& s) {
  const T x = q.v[0], y = q.v[1], z = q.v[2], w = q.w;
  const T wx = s * w * x, wy = s * w * y, wz = s * w * z;
  const T xx = s * x * x, xy = s * x * y, xz = s * x * z;
  const T yy = s * y * y, yz = s * y * z, zz = s * z * z;
  Mat3<T> R;
  R << T(1) - (yy + zz), xy - wz, xz + wy, xy + wz, T(1) - (xx + zz), yz - wx, xz - wy, yz + wx, T(1) - (xx + yy);
  return R;
}
/// The rotation matrix of q / |q|. Dividing by the norm keeps a norm that drifts from scaling a torque.
template <class T>
Mat3<T> rotation_matrix(const Quaternion<T>& q) {
  using real::conserved;
  const T s = conserved(T(T(2) / q.squared_norm()));
  return scaled_rotation_matrix(q, s);
}

/// The unit quaternion of a rotation matrix, of either sign. It is built from its largest component, so that no digits are
/// lost.
template <class T>
Quaternion<T> quaternion_of(const Mat3<T>& R) {
  const T trace = R.trace();
  int i = 0;
  if (R(1, 1) > R(0, 0)) i = 1;
  if (R(2, 2) > R(i, i)) i = 2;
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  Quaternion<T> q;
  if (trace > R(i, i)) {
    q = {T(1) + trace, Vec3<T>(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1))};
  } else {
    q.w = R(k, j) - R(j, k);
    q.v[i] = T(1) + R(i, i) - R(j, j) - R(k, k);
    q.v[j] = R(i, j) + R(j, i);
    q.v[k] = R(i, k) + R(k, i);
  }
  return q.normalized();
}

/// The quaternion of a rotation by rate * t about a coordinate axis (0, 1, 2). The product is formed and reduced with twice the
/// digits of T: even a spin of 1e6 rad/s for an hour is as exact as the given rate and time.
template <class T>
Quaternion<T> steady_turn(int axis, T rate, T t) {
  // The half angle less whole turns of 2 pi; k * 2 pi is split in two parts, of which the larger cancels without rounding.
  const T half = rate / T(2), product = half * t, rest = real::fma(half, t, T(-product));
  const T k = real::round(T(product / (T(2) * real::pi<T>())));
  const T high = k * (T(2) * real::pi<T>()), low = real::fma(k, T(T(2) * real::pi<T>()), T(-high));
  const T angle = (product - high) + ((rest - low) - k * (T(2) * real::pi_rest<T>()));
  Quaternion<T> q;
  const SinCos<T> both = real::sin_cos(angle);
  q.w = both.cos;
  q.v[axis] = both.sin;
  return q;
}

/// The matrix of a turn by `angle` (rad) about the unit vector `axis`.
template <class T>
Mat3<T> turn_matrix(const Vec3<T>& axis, const T& angle) {
  const SinCos<T> half = real::sin_cos(T(angle / T(2)));
  return scaled_rotation_matrix(Quaternion<T>{half.cos, half.sin * axis}, T(2));
}

/// (R(e) - 1) u / epsilon for the quaternion e = (w, epsilon y) of any norm:  (2 w y x u + 2 epsilon y x (y x u)) / |e|^2.
template <class T>
Vec3<T> turn_minus_one_scaled(T w, const Vec3<T>& y, T epsilon, const Vec3<T>& u) {
  const Vec3<T> yu = y.cross(u);
  using real::conserved;
  const T s = conserved(T(T(2) / (w * w + epsilon * epsilon * y.dot(y))));
  return s * (w * yu + epsilon * y.cross(yu));
}
/// (R(e)^T - 1) u / epsilon for the same e.
template <class T>
Vec3<T> turn_back_minus_one_scaled(T w, const Vec3<T>& y, T epsilon, const Vec3<T>& u) {
  return turn_minus_one_scaled(w, Vec3<T>(-y), epsilon, u);
}

/// The matrix (R(e)^T - 1) / epsilon for the same e: s (-w [y]x + epsilon (y y^T - y.y)) with s = 2 / |e|^2.
template <class T>
Mat3<T> turn_back_minus_one_matrix(T w, const Vec3<T>& y, T epsilon) {
  using real::conserved;
  const T s = conserved(T(T(2) / (w * w + epsilon * epsilon * y.dot(y))));
  const T f = epsilon * s;
  const T wx = s * (w * y[0]), wy = s * (w * y[1]), wz = s * (w * y[2]);
  const T xx = f * (y[0] * y[0]), yy = f * (y[1] * y[1]), zz = f * (y[2] * y[2]);
  const T xy = f * (y[0] * y[1]), yz = f * (y[1] * y[2]), zx = f * (y[2] * y[0]);
  Mat3<T> M;
  M << -yy - zz, wz + xy, zx - wy, xy - wz, -xx - zz, wx + yz, wy + zx, yz - wx, -xx - yy;
  return M;
}

/// An attitude R_AB, stored as a unit quaternion.
template <class T>
class Rotation {
 public:
  Rotation() = default;
  /// @param q_AB  any non-zero quaternion; normalised here
  explicit Rotation(const Quaternion<T>& q_AB) : q_AB_(q_AB.normalized()) {}

  /// The rotation by |v| rad about v: exp([v]x). Accurate to round-off at every angle, however small.
  static Rotation exp(const Vec3<T>& v) {
    const T angle = norm(v);
    if (!(angle > T(0))) return Rotation();
    const SinCos<T> half = real::sin_cos(T(angle / T(2)));
    return Rotation(Quaternion<T>{half.cos, (half.sin / angle) * v});
  }
  /// The rotation by `angle` (rad) about the unit vector `axis`.
  static Rotation about(const Vec3<T>& axis, T angle) {
    const SinCos<T> half = real::sin_cos(T(angle / T(2)));
    return Rotation(Quaternion<T>{half.cos, half.sin * axis});
  }
  /// The rotation vector v with exp(v) = *this, 0 <= |v| <= pi. It does not use acos, so that small angles keep all digits.
  Vec3<T> log() const {
    const T sine = norm(q_AB_.v);
    if (!(sine > T(0))) return Vec3<T>::Zero();
    const T sign = q_AB_.w < T(0) ? T(-1) : T(1);
    return (sign * T(2) * real::atan2(sine, sign * q_AB_.w) / sine) * q_AB_.v;
  }

  Rotation inverse() const {
    Rotation R;
    R.q_AB_ = q_AB_.conjugate();
    return R;
  }
  friend Rotation operator*(const Rotation& R_AB, const Rotation& R_BC) { return Rotation(R_AB.q_AB_ * R_BC.q_AB_); }
  friend Vec3<T> operator*(const Rotation& R_AB, const Vec3<T>& v_B) { return R_AB.matrix() * v_B; }

  Mat3<T> matrix() const { return rotation_matrix(q_AB_); }
  const Quaternion<T>& quaternion() const { return q_AB_; }

 private:
  Quaternion<T> q_AB_;
};

}  // namespace earthtop
