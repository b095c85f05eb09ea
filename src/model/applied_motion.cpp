// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/applied_motion.ipp"

namespace earthtop {

template Vec3<double> applied_torque_B(const Model<double>&, double, const Quaternion<double>&, const Vec3<double>&, bool);
template Vec3<float80> applied_torque_B(const Model<float80>&, float80, const Quaternion<float80>&, const Vec3<float80>&, bool);
template Vec3<float128> applied_torque_B(const Model<float128>&, float128, const Quaternion<float128>&, const Vec3<float128>&,
                                         bool);
template Vec3<Paired<double>> applied_torques_B(const Model<double>&, double, const Quaternion<double>&, const Vec3<double>&,
                                                double, const Vec3<double>&, const Vec3<double>&);
template Vec3<Paired<float80>> applied_torques_B(const Model<float80>&, float80, const Quaternion<float80>&,
                                                 const Vec3<float80>&, float80, const Vec3<float80>&, const Vec3<float80>&);
template Vec3<Paired<float128>> applied_torques_B(const Model<float128>&, float128, const Quaternion<float128>&,
                                                  const Vec3<float128>&, float128, const Vec3<float128>&,
                                                  const Vec3<float128>&);

}  // namespace earthtop
