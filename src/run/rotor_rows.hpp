// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the parts of a row on a rotor and on gimbals.
#pragma once

#include "earthtop/drift/drift.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "run/drift_bound.hpp"
#include "run/row_vectors.hpp"

namespace earthtop {

template <class T>
void add_rotor_row(const DriftState<T>& s, const RotorState<T>& rotor, const DriftBound<T>& bound, BasicDriftRow<T>& row) {
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
  made.drift_axis_rad = rotor.axis.angle;
  made.drift_axis_bound_rad = bound.rotor_axis();
  made.drift_rate_bound_rad_s = bound.rotor_rate();
  made.drift_angle_bound_rad = bound.rotor_angle();
}

template <class T>
void add_gimbal_row(const DriftState<T>& s, const GimbalState<T>& gimbals, const DriftBound<T>& bound, BasicDriftRow<T>& row) {
  BasicGimbalRow<T>& made = row.gimbals.emplace();
  made.outer_angle_rad = gimbals.outer.rot, made.inner_angle_rad = gimbals.inner.rot;
  made.outer_rate_rad_s = gimbals.outer_rate.rot, made.inner_rate_rad_s = gimbals.inner_rate.rot;
  made.ref_outer_angle_rad = gimbals.outer.ref, made.ref_inner_angle_rad = gimbals.inner.ref;
  made.ref_outer_rate_rad_s = gimbals.outer_rate.ref, made.ref_inner_rate_rad_s = gimbals.inner_rate.ref;
  made.drift_outer_angle_rad = s.epsilon * gimbals.outer.diff, made.drift_inner_angle_rad = s.epsilon * gimbals.inner.diff;
  made.drift_outer_rate_rad_s = s.epsilon * gimbals.outer_rate.diff;
  made.drift_inner_rate_rad_s = s.epsilon * gimbals.inner_rate.diff;
  made.drift_outer_angle_bound_rad = bound.outer_angle(), made.drift_inner_angle_bound_rad = bound.inner_angle();
  made.headline = gimbals.headline;
}

}  // namespace earthtop
