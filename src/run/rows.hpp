// SPDX-License-Identifier: GPL-3.0-or-later
/// From a sample of an integration to a row of results, in the scalar of the run, and from one scalar to another.
#pragma once

#include "earthtop/drift/drift.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "run/drift_bound.hpp"

namespace earthtop {

/// Zeros of a row have no sign.
template <class T>
std::array<T, 3> to_array(const Vec3<T>& v) {
  return {v[0] + T(0), v[1] + T(0), v[2] + T(0)};
}
template <class T>
std::array<T, 4> to_array(const Quaternion<T>& q) {
  return {q.w + T(0), q.v[0] + T(0), q.v[1] + T(0), q.v[2] + T(0)};
}

template <class T>
BasicDriftRow<T> make_row(const DriftSample<T>& sample, const DriftBound<T>& bound) {
  const DriftState<T>& s = sample.state;
  const DriftMeasures<T>& m = sample.measures;
  BasicDriftRow<T> row;
  row.t_s = s.t_s;
  const Quaternion<T> q_LB = s.q_LB.normalized(), ref_q_LB = s.ref_q_LB.normalized();
  row.q_LB = to_array(q_LB);
  row.w_LB_B = to_array(s.w_LB_B);
  row.ref_q_LB = to_array(ref_q_LB);
  row.ref_w_LB_B = to_array(s.ref_w_LB_B);
  row.axis_L = to_array(Vec3<T>(rotation_matrix(q_LB).col(2)));
  row.ref_axis_L = to_array(Vec3<T>(rotation_matrix(ref_q_LB).col(2)));
  row.drift_axis_rad = m.axis;
  row.drift_axis_bound_rad = bound.axis();
  if (m.azimuth_defined) row.drift_azimuth_rad = sample.azimuth;
  row.drift_tilt_rad = m.tilt;
  row.drift_attitude_rad = m.attitude;
  row.drift_attitude_bound_rad = bound.attitude();
  row.drift_spin_rad = sample.spin;
  return row;
}

template <class To, class From, std::size_t n>
std::array<To, n> array_cast(const std::array<From, n>& values) {
  std::array<To, n> cast;
  for (std::size_t i = 0; i < n; ++i) cast[i] = static_cast<To>(values[i]);
  return cast;
}

template <class To, class From>
BasicDriftRow<To> row_cast(const BasicDriftRow<From>& row) {
  BasicDriftRow<To> cast;
  cast.t_s = static_cast<To>(row.t_s);
  cast.q_LB = array_cast<To>(row.q_LB);
  cast.w_LB_B = array_cast<To>(row.w_LB_B);
  cast.ref_q_LB = array_cast<To>(row.ref_q_LB);
  cast.ref_w_LB_B = array_cast<To>(row.ref_w_LB_B);
  cast.axis_L = array_cast<To>(row.axis_L);
  cast.ref_axis_L = array_cast<To>(row.ref_axis_L);
  cast.drift_axis_rad = static_cast<To>(row.drift_axis_rad);
  cast.drift_axis_bound_rad = static_cast<To>(row.drift_axis_bound_rad);
  if (row.drift_azimuth_rad) cast.drift_azimuth_rad = static_cast<To>(*row.drift_azimuth_rad);
  cast.drift_tilt_rad = static_cast<To>(row.drift_tilt_rad);
  cast.drift_attitude_rad = static_cast<To>(row.drift_attitude_rad);
  cast.drift_attitude_bound_rad = static_cast<To>(row.drift_attitude_bound_rad);
  cast.drift_spin_rad = static_cast<To>(row.drift_spin_rad);
  cast.drift_reliable = row.drift_reliable;
  return cast;
}

}  // namespace earthtop
