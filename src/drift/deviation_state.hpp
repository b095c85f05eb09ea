// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts the deviation of any observer's form to the quaternion of R_ref^T R_rot, which the drift measures read.
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// The part of a drift state that the drift measures read: `ref_q_LB`, `e_w`, `e_v_scaled` and `epsilon`.
/// @tparam O  the observer in whose axes the deviation is given: body, laboratory or inertial
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
    // The deviation seen from the laboratory is q_NL^* d in L axes; it is then turned to the reference's body axes.
    const LaboratoryTurn<T> turn = laboratory_turn(model, t);
    const T epsilon = model.epsilon;
    s.e_w = turn.w * deviation.w + epsilon * epsilon * turn.v_scaled.dot(deviation.y);
    const Vec3<T> seen_L = turn.w * deviation.y - deviation.w * turn.v_scaled - epsilon * turn.v_scaled.cross(deviation.y);
    s.e_v_scaled = transposed_times(rotation_matrix(ref_q_LB), seen_L);
  }
  return s;
}

/// The same seen from a laboratory on a journey, from what the axes A of the integration see (journey.hpp): the quaternion of R_ref^T R_rot
/// also turns by what the two laboratories are turned against each other.
template <class T>
DriftState<T> deviation_from_journey(const Model<T>& model, DriftState<T> s, const T& t) {
  if (model.journey.empty()) return s;
  if (model.journey.has_still_reference()) {
    const SmallTurn<T> turn = model.journey.attitude_change(t);
    const Vec3<T> back_B = -transposed_times(rotation_matrix(s.ref_q_LB), turn.v_scaled), e_v = s.e_v_scaled;
    const T e_w = s.e_w;
    s.e_w = turn.w * e_w - s.epsilon * s.epsilon * back_B.dot(e_v);
    s.e_v_scaled = turn.w * e_v + e_w * back_B + s.epsilon * back_B.cross(e_v);
  }
  s.ref_q_LB = model.journey.attitude(t, false).conjugate() * s.ref_q_LB;
  return s;
}
/// A whole state.
template <class T>
DriftState<T> seen_from_journey(const Model<T>& model, const DriftState<T>& in_A, const T& t) {
  if (model.journey.empty()) return in_A;
  DriftState<T> s = deviation_from_journey(model, in_A, t);
  see_rotating_from_journey(model, s, t);
  s.ref_w_LB_B -= transposed_times(rotation_matrix(s.ref_q_LB), model.journey.at(JourneyPart::rate, t));
  return s;
}

}  // namespace earthtop
