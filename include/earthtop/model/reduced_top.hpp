// SPDX-License-Identifier: GPL-3.0-or-later
/// Reduced equations of the symmetric top, without its spin. Variables: the axis n; the transverse rate u, which is the part of
/// the inertial angular velocity normal to the axis; and a vector a of a frame that moves with n and has no inertial rate along
/// n. All are in axes A (laboratory or inertial). b = I3 w3 / I1 is the nutation rate of the free top; it is constant and exact
/// because the inertial spin w3 is:
///
///   dn/dt = s - W x n ,  du/dt = (m l / I1) n x g - b s - W x u ,  s = u x n ,  da/dt = (n x s - W) x a
///
/// with W = 0 in inertial axes. |n| and u.n = 0 are conserved. The spin itself appears in none of the time derivatives, so that
/// the steps need only follow the nutation. The attitude is the frame (a, n x a, n) rotated by w3 t about n.
#pragma once

#include "earthtop/model/model.hpp"

namespace earthtop {

/// The coefficients of the reduced equations, computed from a `Model` in its units.
template <class T>
struct ReducedTop {
  int axis = 2;              ///< the body axis of symmetry: 0, 1 or 2
  T spin_ratio = T(1);       ///< I3 / I1: moments about the pivot along and normal to the axis
  T spin_ratio_rest = T(0);  ///< rounding error of spin_ratio, to be added to it
  T moment_ratio = T(0);     ///< m l / I1, with the sign of the centre of mass along the axis
  T I1 = T(1), I3 = T(1);
  EARTHTOP_MEMBERS(axis, spin_ratio, spin_ratio_rest, moment_ratio, I1, I3)
};

/// Axis and transverse rate, or their time derivatives.
template <class T>
struct AxisMotion {
  Vec3<T> n, u;
};

/// b = (I3/I1) w3 and its rounding error: a relative error of b would become the same relative error of the whole precession.
template <class T>
struct NutationRate {
  T value, rest;
  /// @param w3_rest  number to be added to w3, small or not; both are taken as exact
  NutationRate(const ReducedTop<T>& top, T w3, T w3_rest = T(0)) {
    const T sum = w3 + w3_rest, of_rest = sum - w3;
    const T low = (w3 - (sum - of_rest)) + (w3_rest - of_rest);
    value = top.spin_ratio * sum;
    rest = real::fma(top.spin_ratio, sum, -value) + top.spin_ratio_rest * sum + top.spin_ratio * low;
  }
};

/// Whether a model is a symmetric top on which nothing acts but gravity and the Earth's rotation.
template <class T>
bool is_reducible(const Model<T>& model) {
  return model.kind == SceneKind::plain && symmetry_axis(model.I_BP_B, model.mass_moment_B) >= 0;
}

/// Whether a model is a symmetric top in any scene whose torques do not depend on the angle of spin (reduced_torques.hpp). A
/// gimbal's constraint is not written in that form; a disc spins about body axis 3, which an unequal support holds. All
/// torques of [F] act: it has no place for one that is left out.
template <class T>
bool is_reducible_when_driven(const Model<T>& model) {
  const AppliedTorques<T>& applied = model.applied;
  const int axis = symmetry_axis(model.I_BP_B, model.mass_moment_B);
  return axis >= 0 && model.kind != SceneKind::gyrostat && !applied.level_axis && applied.is_symmetric_about(axis) &&
         model.weights.all_act();
}

/// Whether a model is a wheel symmetric about body axis 3 in a gimbal that keeps it level in the laboratory: a compass. Its
/// reduced form has one angle and the spin.
template <class T>
bool is_compass(const Model<T>& model) {
  const Platform<T>& platform = model.platform;
  const bool rests = platform.turn.never_turns() && norm(platform.pivot_offset_P) == T(0);
  return model.applied.level_axis && rests && symmetry_axis(model.I_BP_B, model.mass_moment_B) == 2 &&
         model.applied.is_symmetric_about(2) && model.weights.all_act();
}

/// @throws std::logic_error for a model that is not a symmetric top
template <class T>
ReducedTop<T> reduced_top(const Model<T>& model);
extern template ReducedTop<double> reduced_top(const Model<double>&);
extern template ReducedTop<float80> reduced_top(const Model<float80>&);
extern template ReducedTop<float128> reduced_top(const Model<float128>&);

/// (m l / I1) n / |n|, to second order in the error of |n|: the norm must not scale the torque. A deviation from a motion must
/// use the same formula. Otherwise a drift of the spin phase, which does not move the axis, would leave a spurious torque.
template <class T>
T moment_factor(const ReducedTop<T>& top, const Vec3<T>& n) {
  using real::conserved;
  return top.moment_ratio * (T(3) - conserved(T(n.dot(n)))) / T(2);
}
template <class T>
Vec3<T> mass_moment_along(const ReducedTop<T>& top, const Vec3<T>& n) {
  return moment_factor(top, n) * n;
}

/// dn/dt and du/dt.   @param s  u x n, which is dn/dt seen from inertial space   @param b  (I3/I1) w3   @param W_A  rate of the
/// axes A   @param field_A  apparent gravity in A
template <class T>
AxisMotion<T> axis_equation(const ReducedTop<T>& top, const AxisMotion<T>& x, const Vec3<T>& s, T b, const Vec3<T>& W_A,
                            const Vec3<T>& field_A) {
  return {s - W_A.cross(x.n), field_torque(mass_moment_along(top, x.n), field_A) - b * s - W_A.cross(x.u)};
}

/// da/dt for a vector a of the frame without inertial spin: the frame turns at the rate n x s - W. n x s has no component along
/// n whatever the error of u; with u itself such an error would appear as a spin.
template <class T>
Vec3<T> spinless_frame_equation(const Vec3<T>& n, const Vec3<T>& s, const Vec3<T>& a, const Vec3<T>& W_A) {
  return Vec3<T>(n.cross(s) - W_A).cross(a);
}

/// Rebuilds the attitude of a reduced motion from the frame (a, n x a, n) and the rotation by the spin, which is exact.
template <class T>
class SpinlessFrame {
 public:
  /// @param axis  the body axis of symmetry   @param q_AB  attitude at release   @param w3  inertial rate along the axis, as
  /// given
  /// @param w3_rest  number to be added to w3; both are taken as exact
  SpinlessFrame(int axis, const Quaternion<T>& q_AB, T w3, T w3_rest = T(0))
      : axis_(axis), w3_(w3), w3_rest_(w3_rest), q_AF_(q_AB) {
    const Mat3<T> R_AB = rotation_matrix(q_AB);
    n_ = R_AB.col(axis), a_ = R_AB.col((axis + 1) % 3);
  }

  /// To be called after every step: keeps the sign of the quaternions continuous. It is cheap as long as the frame has turned
  /// by less than 60 degrees.
  void follow(const Vec3<T>& n, const Vec3<T>& a) {
    if (n_.dot(n) > T(0.5) && a_.dot(a) > T(0.5)) return;
    q_AF_ = frame(n, a);
    n_ = n, a_ = a;
  }
  /// Attitude q_AF of the frame that does not spin, i.e. the body's attitude before the rotation about its axis.
  /// @param n_A, a_A  nearly orthonormal; made exactly orthonormal here
  Quaternion<T> frame(const Vec3<T>& n_A, const Vec3<T>& a_A) const {
    const Vec3<T> n = n_A / norm(n_A);
    const Vec3<T> across = a_A - a_A.dot(n) * n;
    const Vec3<T> a = across / norm(across);
    Mat3<T> R_AF;
    R_AF.col(axis_) = n;
    R_AF.col((axis_ + 1) % 3) = a;
    R_AF.col((axis_ + 2) % 3) = n.cross(a);
    const Quaternion<T> q = quaternion_of(R_AF);
    return q.w * q_AF_.w + q.v.dot(q_AF_.v) < T(0) ? Quaternion<T>{-q.w, -q.v} : q;
  }
  /// The body's attitude q_AB at time t.
  Quaternion<T> attitude(const Vec3<T>& n, const Vec3<T>& a, T t) const {
    const Quaternion<T> q_AB = frame(n, a) * steady_turn(axis_, w3_, t);
    return w3_rest_ == T(0) ? q_AB : q_AB * steady_turn(axis_, w3_rest_, t);
  }

 private:
  int axis_;
  T w3_, w3_rest_;
  Quaternion<T> q_AF_;  ///< attitude of the frame at the last update, with its vectors n_ and a_
  Vec3<T> n_, a_;
};

}  // namespace earthtop
