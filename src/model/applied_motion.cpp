// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/applied_motion.ipp"

namespace earthtop {

Vec3<double> applied_torque_change_B(const Model<double>& model, double t, const Quaternion<double>& q_LB,
                                     const Vec3<double>& w_LB_B, bool earth, const Vec3<double>& theta_B,
                                     const Vec3<double>& dw_B) {
  const Mat3<double> R_LB = rotation_matrix(q_LB);
  const double epsilon = earth ? model.epsilon : 0;
  const auto see = [&](const Vec3<double>& u_L, const Vec3<double>& change_L) {
    const Vec3<double> u_B = transposed_times(R_LB, Vec3<double>(u_L + epsilon * change_L));
    return paired_vector(u_B, u_B, Vec3<double>(u_B.cross(theta_B)));
  };
  const Vec3<double> w_IB_B = w_LB_B + epsilon * transposed_times(R_LB, model.W_IL_L_scaled);
  const auto torque = applied_motion::torque_of(
      model, applied_motion::seen_from_body<Paired<double>>(model, t, paired_vector(w_IB_B, w_IB_B, dw_B), see));
  return parts(torque, &Paired<double>::diff);
}

template Vec3<double> applied_torque_B(const Model<double>&, double, const Quaternion<double>&, const Vec3<double>&, bool);
template Vec3<long double> applied_torque_B(const Model<long double>&, long double, const Quaternion<long double>&,
                                            const Vec3<long double>&, bool);
template Vec3<float128> applied_torque_B(const Model<float128>&, float128, const Quaternion<float128>&, const Vec3<float128>&,
                                         bool);
template Vec3<Paired<double>> applied_torques_B(const Model<double>&, double, const Quaternion<double>&, const Vec3<double>&,
                                                double, const Vec3<double>&, const Vec3<double>&);
template Vec3<Paired<long double>> applied_torques_B(const Model<long double>&, long double, const Quaternion<long double>&,
                                                     const Vec3<long double>&, long double, const Vec3<long double>&,
                                                     const Vec3<long double>&);
template Vec3<Paired<float128>> applied_torques_B(const Model<float128>&, float128, const Quaternion<float128>&,
                                                  const Vec3<float128>&, float128, const Vec3<float128>&,
                                                  const Vec3<float128>&);

}  // namespace earthtop
