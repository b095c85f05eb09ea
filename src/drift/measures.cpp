#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {
namespace {

/// atan2 that never gives -0.
template <class T>
T angle_of(T y, T x) {
  return real::atan2(y, x) + T(0);
}

}  // namespace

template <class T>
DriftMeasures<T> measure_drift(const DriftState<T>& s) {
  const T epsilon = s.epsilon;
  const T size = real::hypot(s.e_w, T(epsilon * norm(s.e_v_scaled)));
  const T w = s.e_w / size;
  const Vec3<T> y = s.e_v_scaled / size;
  DriftMeasures<T> m;
  m.axis = T(2) * angle_of(T(epsilon * real::hypot(y[0], y[1])), real::hypot(w, T(epsilon * y[2])));
  m.attitude = T(2) * angle_of(T(epsilon * norm(y)), real::abs(w));
  m.half_spin = angle_of(T(epsilon * y[2]), w);

  const Mat3<T> R_ref = rotation_matrix(s.ref_q_LB);
  const Vec3<T> axis_B = Vec3<T>::UnitZ();
  m.axis_difference_L_scaled = R_ref * turn_minus_one_scaled(w, y, epsilon, axis_B);
  m.attitude_vector_L_scaled = R_ref * y;

  // East, North, Up of the reference axis n and of the difference d; n + d is the rotating axis.
  const Vec3<T> n = R_ref.col(2);
  const Vec3<T> d = epsilon * m.axis_difference_L_scaled;
  const T horizontal_ref = real::hypot(n[0], n[1]);
  const T horizontal_rot = real::hypot(T(n[0] + d[0]), T(n[1] + d[1]));
  const T round_off = T(8) * real::epsilon<T>();
  const bool ref_defined = horizontal_ref > round_off;
  m.azimuth_defined = ref_defined && horizontal_rot > round_off;
  m.ref_azimuth = ref_defined ? angle_of(n[0], n[1]) : T(0);
  m.azimuth = T(0);
  if (m.azimuth_defined)
    m.azimuth = angle_of(T(n[1] * d[0] - n[0] * d[1]), T(horizontal_ref * horizontal_ref + n[0] * d[0] + n[1] * d[1]));
  // The horizontal lengths differ by (2 n.d + d.d) / (their sum), without subtracting them.
  const T longer = horizontal_ref > T(0)
                       ? T((T(2) * (n[0] * d[0] + n[1] * d[1]) + d[0] * d[0] + d[1] * d[1]) / (horizontal_ref + horizontal_rot))
                       : horizontal_rot;
  m.tilt = angle_of(T(longer * n[2] - d[2] * horizontal_ref), T(horizontal_rot * horizontal_ref + (n[2] + d[2]) * n[2]));
  return m;
}
template DriftMeasures<double> measure_drift(const DriftState<double>&);
template DriftMeasures<long double> measure_drift(const DriftState<long double>&);
template DriftMeasures<float128> measure_drift(const DriftState<float128>&);

}  // namespace earthtop
