// SPDX-License-Identifier: GPL-3.0-or-later
/// Defines the measures of a drift, for the scalars of measures.cpp and for jets.
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {
namespace drift_measures {

/// atan2 that never gives -0.
template <class T>
T angle_of(T y, T x) {
  return real::atan2(y, x) + T(0);
}

/// The difference of an axis of the rotating body from that of the reference, over epsilon; in East, North, Up.
/// @param R_ref  attitude of the reference
template <class T>
Vec3<T> axis_difference_scaled(const DriftState<T>& s, const Mat3<T>& R_ref, const Vec3<T>& axis_B = Vec3<T>::UnitZ()) {
  return times(R_ref, turn_minus_one_scaled(s.e_w, s.e_v_scaled, s.epsilon, axis_B));
}

/// Body axis 3 of the reference, n, and the difference d of that of the rotating body from it; in East, North, Up.
template <class T>
struct AxisPair {
  Vec3<T> n, d_scaled, d;
  T horizontal_ref, horizontal_rot;
  bool ref_defined, azimuth_defined;

  explicit AxisPair(const DriftState<T>& s) : AxisPair(s, rotation_matrix(s.ref_q_LB)) {}
  AxisPair(const DriftState<T>& s, const Mat3<T>& R_ref) {
    n = R_ref.col(2);
    d_scaled = axis_difference_scaled(s, R_ref);
    d = s.epsilon * d_scaled;
    horizontal_ref = real::hypot(n[0], n[1]);
    horizontal_rot = real::hypot(T(n[0] + d[0]), T(n[1] + d[1]));
    const T round_off = T(8) * real::epsilon<T>();
    ref_defined = horizontal_ref > round_off;
    azimuth_defined = ref_defined && horizontal_rot > round_off;
  }
  /// Sine, times a positive number, of the compass azimuth of n + d minus that of n. It is a component of n x d, so that two
  /// directions are never subtracted. Adding 0 turns -0 into 0.
  T azimuth_sine() const { return n[1] * d[0] - n[0] * d[1] + T(0); }
  T azimuth_cosine() const { return horizontal_ref * horizontal_ref + n[0] * d[0] + n[1] * d[1]; }
};

}  // namespace drift_measures

template <class T>
AxisDrift<T> drift_of_axis(const DriftState<T>& s, const Vec3<T>& axis_B) {
  const Vec3<T>& v = s.e_v_scaled;
  const T sine = s.epsilon * norm(Vec3<T>(v.cross(axis_B)));
  const T half = drift_measures::angle_of(sine, real::hypot(s.e_w, T(s.epsilon * v.dot(axis_B))));
  return {T(2) * half, drift_measures::axis_difference_scaled(s, rotation_matrix(s.ref_q_LB), axis_B)};
}

template <class T>
DriftPhases<T> drift_phases(const DriftState<T>& s) {
  const drift_measures::AxisPair<T> axes(s);
  return {s.epsilon * s.e_v_scaled[2] + T(0), s.e_w, axes.azimuth_defined, axes.azimuth_sine(), axes.azimuth_cosine()};
}

template <class T>
DriftMeasures<T> measure_drift(const DriftState<T>& s, DriftSought sought) {
  using drift_measures::angle_of;
  const T epsilon = s.epsilon;
  const T size = real::hypot(s.e_w, T(epsilon * norm(s.e_v_scaled)));
  const T w = s.e_w / size;
  const Vec3<T> y = s.e_v_scaled / size;
  const Mat3<T> R_ref = rotation_matrix(s.ref_q_LB);
  DriftMeasures<T> m;
  m.axis = T(2) * angle_of(T(epsilon * real::hypot(y[0], y[1])), real::hypot(w, T(epsilon * y[2])));
  m.attitude = T(2) * angle_of(T(epsilon * norm(y)), real::abs(w));
  m.attitude_vector_L_scaled = times(R_ref, y);
  if (sought == DriftSought::distances) {
    m.axis_difference_L_scaled = drift_measures::axis_difference_scaled(s, R_ref);
    m.tilt = m.azimuth = m.half_spin = T(0);
    m.azimuth_defined = false;
    return m;
  }
  m.half_spin = angle_of(T(epsilon * y[2] + T(0)), w);

  const drift_measures::AxisPair<T> axes(s, R_ref);
  const Vec3<T>&n = axes.n, &d = axes.d;
  m.axis_difference_L_scaled = axes.d_scaled;
  m.azimuth_defined = axes.azimuth_defined;
  m.azimuth = axes.azimuth_defined ? angle_of(axes.azimuth_sine(), axes.azimuth_cosine()) : T(0);
  // The difference of the two horizontal lengths is (2 n.d + d.d) / (their sum), which avoids subtracting them.
  const T sum = axes.horizontal_ref + axes.horizontal_rot;
  const T longer = axes.horizontal_ref > T(0) ? T((T(2) * (n[0] * d[0] + n[1] * d[1]) + d[0] * d[0] + d[1] * d[1]) / sum)
                                              : axes.horizontal_rot;
  m.tilt = angle_of(T(longer * n[2] - d[2] * axes.horizontal_ref),
                    T(axes.horizontal_rot * axes.horizontal_ref + (n[2] + d[2]) * n[2]));
  return m;
}

}  // namespace earthtop
