// SPDX-License-Identifier: GPL-3.0-or-later
/// The quantity that the exact motion on a uniformly rotating Earth conserves, the Jacobi integral. Energy is not conserved.
#pragma once

#include "earthtop/model/model.hpp"

namespace earthtop {

/// A conserved quantity at one instant, with the size of its terms.
template <class T>
struct ConservedValue {
  T value;
  T scale;
};
/// The name of what `jacobi_integral` gives, for those who used it before there were others.
template <class T>
using JacobiIntegral = ConservedValue<T>;

/// The Jacobi integral T(w_IB) + V - L.W (J), with the size T + |m g l| + |L.W|. It is conserved if W is constant and the pivot is
/// at rest in the laboratory.
/// @param w_LB_B  rate relative to the laboratory (rad/s)
template <class T>
ConservedValue<T> jacobi_integral(const Mat3<T>& I_BP_B, const Vec3<T>& mass_moment_B, const Vec3<T>& apparent_gravity_L,
                                  const Vec3<T>& W_IL_L, const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B) {
  const Mat3<T> R_LB = rotation_matrix(q_LB);
  const Vec3<T> W_B = R_LB.transpose() * W_IL_L;
  const Vec3<T> w_IB_B = w_LB_B + W_B;
  const Vec3<T> L_B = I_BP_B * w_IB_B;
  const T kinetic = w_IB_B.dot(L_B) / T(2);
  const T potential = -mass_moment_B.dot(R_LB.transpose() * apparent_gravity_L);
  const T turning = L_B.dot(W_B);
  return {kinetic + potential - turning, kinetic + norm(mass_moment_B) * norm(apparent_gravity_L) + real::abs(turning)};
}

}  // namespace earthtop
