// SPDX-License-Identifier: GPL-3.0-or-later
/// The sizes of torques along a motion that is followed.
#pragma once

#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/model/torques.hpp"

namespace earthtop {

inline Vec3<double> seen_from(const FollowedStep& step, const Vec3<double>& u_L) {
  return transposed_times(rotation_matrix(step.q_LB), u_L);
}

/// The size of a vector product of factors of this size; 0 where they are parallel to round-off.
inline double size_of_product(const Vec3<double>& product, double of_factors) {
  constexpr double kRoundOff = 8 * real::epsilon<double>();
  const double size = norm(product);
  return size <= kRoundOff * of_factors ? 0 : size;
}

/// The Coriolis torque (N m) of a rate W in laboratory axes.
inline double coriolis_size(const FollowedStep& step, const Vec3<double>& W_L, const Mat3<double>& S_BP_B) {
  const Mat3<double> moment = velocity_moment(S_BP_B, step.w_LB_B);
  return size_of_product(coriolis_torque(seen_from(step, W_L), moment), norm(W_L) * moment.norm());
}

}  // namespace earthtop
