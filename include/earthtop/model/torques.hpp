// SPDX-License-Identifier: GPL-3.0-or-later
/// The non-inertial torques of [F] = Fariborz, "Non-inertial torques and the Euler equation", in the tensor form of that paper,
/// for any observing frame A whose origin is the pivot; and the physical torque of a uniform field.
///
/// Sign convention of [F]: I_mn = -integral x_m x_n dm for all m, n is minus the second moment S, and J_mn = integral x_m
/// xdot_n dm is the velocity moment. Neither is an inertia tensor.
#pragma once

#include "earthtop/vectors.hpp"

namespace earthtop {

/// Velocity moment J_mn = integral x_m xdot_n dm of a rigid body that turns at the rate w_AB in the observing frame A: xdot = w
/// x x gives J = -S [w]x, whose trace is zero (kg m^2/s).
/// @param S_BP_A  second moment about the pivot (kg m^2)   @param w_AB_A  rate of the body in A (rad/s)
template <class T>
Mat3<T> velocity_moment(const Mat3<T>& S_BP_A, const Vec3<T>& w_AB_A) {
  Mat3<T> J;
  for (int m = 0; m < 3; ++m) J.row(m) = w_AB_A.cross(S_BP_A.row(m).transpose()).transpose();  // S symmetric: -(S [w]x)
  return J;
}

/// Coriolis torque about the pivot seen in the rotating frame A:
///   tau_k = -2 ( w_k sum_m J_mm - sum_m w_m J_mk )                                        [F, eq. (Coriolis)]
/// @param w_IA_A  frame rate (rad/s)   @param velocity_moment_A  integral x_m xdot_n dm (kg m^2/s)
/// @returns (N m), expressed in A; zero when the body is at rest in A.
template <class T>
Vec3<T> coriolis_torque(const Vec3<T>& w_IA_A, const Mat3<T>& velocity_moment_A) {
  const Mat3<T>& J = velocity_moment_A;
  return T(-2) * ((J(0, 0) + J(1, 1) + J(2, 2)) * w_IA_A - transposed_times(J, w_IA_A));
}

/// Transverse torque (also called Euler torque) about the pivot, seen in a frame A that has an angular acceleration:
///   tau_k = sum_m ( wdot_k I_mm - wdot_m I_mk ),  I = -S                                 [F, eq. (transverse)]
/// @param alpha_IA_A  frame acceleration (rad/s^2)   @param S_BP_A  second moment about the pivot (kg m^2)
/// @returns (N m), expressed in A; -Theta alpha.
template <class T>
Vec3<T> transverse_torque(const Vec3<T>& alpha_IA_A, const Mat3<T>& S_BP_A) {
  const Mat3<T>& S = S_BP_A;
  return times(S, alpha_IA_A) - (S(0, 0) + S(1, 1) + S(2, 2)) * alpha_IA_A;
}

/// Centrifugal torque about the pivot seen in the rotating frame A:
///   tau_k = sum_mjn eps_kmj w_j w_n I_mn,  I = -S                                        [F, eq. (centrifugal)]
/// which is w x (S w). It is bilinear in the rate: the second argument allows a scaled rate in one of the two places.
/// @param w_IA_A, w_IA_A_scaled  frame rate (rad/s)   @param S_BP_A  second moment about the pivot (kg m^2)
/// @returns (N m), expressed in A.
template <class T>
Vec3<T> centrifugal_torque(const Vec3<T>& w_IA_A, const Vec3<T>& w_IA_A_scaled, const Mat3<T>& S_BP_A) {
  return w_IA_A.cross(times(S_BP_A, w_IA_A_scaled));
}
template <class T>
Vec3<T> centrifugal_torque(const Vec3<T>& w_IA_A, const Mat3<T>& S_BP_A) {
  return centrifugal_torque(w_IA_A, w_IA_A, S_BP_A);
}

/// Torque about the pivot (N m) of a uniform acceleration field f (apparent gravity, a driven pivot): m r_cm x f.
/// @param mass_moment_B  m r_cm (kg m)   @param field_B  f, in the same axes (m/s^2)
template <class T>
Vec3<T> field_torque(const Vec3<T>& mass_moment_B, const Vec3<T>& field_B) {
  return mass_moment_B.cross(field_B);
}

}  // namespace earthtop
