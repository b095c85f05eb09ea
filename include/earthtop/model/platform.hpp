// SPDX-License-Identifier: GPL-3.0-or-later
/// A platform (turntable, ship, rate table) that carries the pivot round in the laboratory.
#pragma once

#include "earthtop/frames/prescribed_motion.hpp"
#include "earthtop/model/platform_spec.hpp"

namespace earthtop {

/// The platform's rotation relative to L, and the position of the pivot on it.
template <class T>
struct Platform {
  PrescribedMotion<T> turn;
  Vec3<T> pivot_offset_P = Vec3<T>::Zero();  ///< from L's origin, in P axes (m)
  EARTHTOP_MEMBERS(turn, pivot_offset_P)

  /// Whether the pivot is off L's origin.
  bool is_offset() const { return pivot_offset_P[0] != T(0) || pivot_offset_P[1] != T(0) || pivot_offset_P[2] != T(0); }
};

/// @param journey  of the laboratory, for PlatformMotion::course
/// @throws std::invalid_argument for PlatformMotion::table with a missing or invalid table, and for PlatformMotion::course without a journey
template <class T>
Platform<T> make_platform(const PlatformSpec& spec, const Journey<T>& journey = {});
extern template Platform<double> make_platform(const PlatformSpec&, const Journey<double>&);
extern template Platform<float80> make_platform(const PlatformSpec&, const Journey<float80>&);
extern template Platform<float128> make_platform(const PlatformSpec&, const Journey<float128>&);

/// The acceleration of the pivot relative to L's origin, without apparent gravity, in L axes (m/s^2), in two parts: what a
/// non-rotating laboratory has, alpha x d + w x (w x d) with w, alpha of P in L; and what the Earth's rate W adds, 2 W x (w x
/// d) + W x (W x d).
template <class T>
struct PivotAcceleration {
  Vec3<T> of_platform_L;
  Vec3<T> of_earth_rate_L;
};

/// @param W_IL_L  the Earth's rate (rad/s)   @param W_IL_L_scaled  the same, or scaled: the part of the Earth's rate is linear
/// in it
template <class T>
PivotAcceleration<T> pivot_acceleration(const Platform<T>& platform, const Vec3<T>& W_IL_L, const Vec3<T>& W_IL_L_scaled, T t) {
  const Mat3<T> R_LP = turn_matrix(platform.turn.axis, platform.turn.angle(t));
  const Vec3<T> d_L = R_LP * platform.pivot_offset_P;
  const Vec3<T> w_LP_L = platform.turn.angle_rate(t) * platform.turn.axis;
  const Vec3<T> alpha_LP_L = platform.turn.angle_acceleration(t) * platform.turn.axis;
  const Vec3<T> velocity_L = w_LP_L.cross(d_L);
  return {alpha_LP_L.cross(d_L) + w_LP_L.cross(velocity_L),
          T(2) * W_IL_L_scaled.cross(velocity_L) + W_IL_L_scaled.cross(W_IL_L.cross(d_L))};
}

}  // namespace earthtop
