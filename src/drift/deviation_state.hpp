// SPDX-License-Identifier: GPL-3.0-or-later
/// The deviation of any observer's form as the drift measures read it: the quaternion of R_ref^T R_rot.
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Fills `ref_q_LB`, `e_w`, `e_v_scaled` and `epsilon`.
/// @tparam O  whose form the deviation is in: body axes, or axes of the laboratory or inertial space
/// @param ref_q_LB  attitude of the non-rotating reference   @param t  natural units
template <Observer O, class T>
DriftState<T> seen_from_laboratory(const Model<T>& model, const Quaternion<T>& ref_q_LB, const Deviation<T>& deviation, T t) {
  DriftState<T> s;
  s.epsilon = model.epsilon;
  s.ref_q_LB = ref_q_LB;
  s.e_w = deviation.w;
  if constexpr (O == Observer::body) {
    s.e_v_scaled = deviation.y;
  } else if constexpr (O == Observer::laboratory) {
    s.e_v_scaled = transposed_times(rotation_matrix(ref_q_LB), deviation.y);
  } else {
    // q_NL^* d, the deviation seen from the laboratory, in L axes; then in the reference's body axes.
    const LaboratoryTurn<T> turn = laboratory_turn(model, t);
    const T epsilon = model.epsilon;
    s.e_w = turn.w * deviation.w + epsilon * epsilon * turn.v_scaled.dot(deviation.y);
    const Vec3<T> seen_L = turn.w * deviation.y - deviation.w * turn.v_scaled - epsilon * turn.v_scaled.cross(deviation.y);
    s.e_v_scaled = transposed_times(rotation_matrix(ref_q_LB), seen_L);
  }
  return s;
}

}  // namespace earthtop
