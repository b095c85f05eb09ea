// SPDX-License-Identifier: GPL-3.0-or-later
/// The attitudes of a symmetric top's two motions from their axes and frame vectors, and the quaternion between them, without
/// subtracting one from the other.
#pragma once

#include "drift/table/contact_reduced_equations.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/reduced_top.hpp"

namespace earthtop {

/// A deviation quaternion (w, epsilon y).
template <class T>
struct ScaledQuaternion {
  T w = T(1);
  Vec3<T> y = Vec3<T>::Zero();
};

/// The quaternion of F_ref^T F_rot of the two frames (a, n x a, n), of either sign. E = F_ref^T F_rot = 1 + epsilon M, where
/// M = F_ref^T (F_rot - F_ref) / epsilon; near a half turn it comes from E itself, as nothing cancels there.
template <class T>
ScaledQuaternion<T> between_frames(const Vec3<Paired<T>>& n, const Vec3<Paired<T>>& a, T epsilon) {
  const Vec3<Paired<T>> across = n.cross(a);
  const Vec3<Paired<T>>* frame[3] = {&a, &across, &n};
  Mat3<T> M;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      T sum = T(0);
      for (int k = 0; k < 3; ++k) sum += (*frame[i])[k].ref * (*frame[j])[k].diff;
      M(i, j) = sum;
    }
  const T four_w_squared = T(4) + epsilon * M.trace();
  if (four_w_squared > T(0.5)) {
    const T w = real::sqrt(four_w_squared) / T(2);
    return {w, Vec3<T>(M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1)) / (T(4) * w)};
  }
  const Quaternion<T> q = quaternion_of<T>(Mat3<T>::Identity() + epsilon * M);
  return {q.w, q.v / epsilon};
}

/// Keeps the signs of the quaternions of a reduced contact motion continuous, and gives the drift state.
template <class T>
class ContactAttitude {
 public:
  ContactAttitude(const Quaternion<T>& q_HB, T w3) : frame_(2, q_HB, w3) {}

  /// To be called after every step.
  void follow(const PairedTop<T>& top, T epsilon) {
    frame_.follow(reference(top.state.n), reference(top.a));
    const ScaledQuaternion<T> e = between(top, epsilon);
    last_w_ = e.w, last_v_ = epsilon * e.y;
  }
  /// Attitude of the reference's frame without spin, and of its body.
  Quaternion<T> frame(const PairedTop<T>& top) const { return frame_.frame(reference(top.state.n), reference(top.a)); }
  Quaternion<T> body(const PairedTop<T>& top, T t) const {
    return frame_.attitude(reference(top.state.n), reference(top.a), t) * steady_turn(2, top.phase, T(1));
  }
  /// The quaternion of R_ref^T R_rot in the axes of the reference's frame: the frames', then the difference of the phases.
  ScaledQuaternion<T> deviation(const PairedTop<T>& top, T epsilon) const {
    const ScaledQuaternion<T> e = between(top, epsilon);
    const T half = top.phase_change / T(2), angle = epsilon * half;
    const SinCos<T> turn = real::sin_cos(angle);
    const T sine = real::abs(angle) > T(0) ? turn.sin / epsilon : half;  // over epsilon
    const Vec3<T> k(T(0), T(0), sine);
    return {e.w * turn.cos - epsilon * epsilon * e.y[2] * sine, e.w * k + turn.cos * e.y + epsilon * e.y.cross(k)};
  }

 private:
  static Vec3<T> reference(const Vec3<Paired<T>>& v) { return {v[0].ref, v[1].ref, v[2].ref}; }
  ScaledQuaternion<T> between(const PairedTop<T>& top, T epsilon) const {
    const ScaledQuaternion<T> e = between_frames(top.state.n, top.a, epsilon);
    return e.w * last_w_ + epsilon * e.y.dot(last_v_) < T(0) ? ScaledQuaternion<T>{-e.w, -e.y} : e;
  }
  SpinlessFrame<T> frame_;  ///< the reference's, in axes H
  T last_w_ = T(1);
  Vec3<T> last_v_ = Vec3<T>::Zero();
};

}  // namespace earthtop
