// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the part of a row on the rotor of a gyrostat.
#pragma once

#include "earthtop/drift/drift.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "run/row_vectors.hpp"

namespace earthtop {

/// The angle between an axis of the body in both motions, found without subtracting one from the other.
template <class T>
T angle_between(const DriftState<T>& s, const Vec3<T>& axis_B) {
  const Vec3<T> v = s.e_v_scaled;
  return T(2) * real::atan2(T(s.epsilon * norm(Vec3<T>(v.cross(axis_B)))), real::hypot(s.e_w, T(s.epsilon * v.dot(axis_B))));
}

/// The bound on the error of the drift of the rotor's axis: that of body axis 3 where it is this axis; otherwise that of the attitude,
/// whose error turns no axis by more than itself.
template <class T>
T rotor_axis_bound(const BasicDriftRow<T>& row) {
  return row.rotor->axis_L == row.axis_L ? row.drift_axis_bound_rad : row.drift_attitude_bound_rad;
}

/// @param row  whose other parts are there
template <class T>
void add_rotor_row(const DriftState<T>& s, const RotorState<T>& rotor, BasicDriftRow<T>& row) {
  BasicRotorRow<T>& made = row.rotor.emplace();
  const auto axis = [&](const Quaternion<T>& q_LB) {
    return to_array(Vec3<T>(times(rotation_matrix(q_LB.normalized()), rotor.axis_B)));
  };
  made.rate_rad_s = rotor.rate, made.angle_rad = rotor.angle;
  made.axis_L = axis(s.q_LB);
  made.ref_rate_rad_s = rotor.ref_rate, made.ref_angle_rad = rotor.ref_angle;
  made.ref_axis_L = axis(s.ref_q_LB);
  made.drift_rate_rad_s = s.epsilon * rotor.rate_difference_scaled;
  made.drift_angle_rad = s.epsilon * rotor.angle_difference_scaled;
  made.drift_axis_rad = angle_between(s, rotor.axis_B);
  made.drift_axis_bound_rad = rotor_axis_bound(row);
}

}  // namespace earthtop
