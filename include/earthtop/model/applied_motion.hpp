// SPDX-License-Identifier: GPL-3.0-or-later
/// The applied torques on one motion in the laboratory, and on both predictions at once.
#pragma once

#include "earthtop/model/model.hpp"

namespace earthtop {

/// The applied torque on one motion, in body axes. It is compiled once and called, so that a scene without applied torques pays
/// only for a branch. Time, rate and torque are in natural units.
/// @param w_LB_B  rate relative to the laboratory   @param earth  whether the laboratory rotates with the Earth
template <class T>
Vec3<T> applied_torque_B(const Model<T>& model, T t, const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B, bool earth);
extern template Vec3<double> applied_torque_B(const Model<double>&, double, const Quaternion<double>&, const Vec3<double>&,
                                              bool);
extern template Vec3<float80> applied_torque_B(const Model<float80>&, float80, const Quaternion<float80>&, const Vec3<float80>&,
                                               bool);
extern template Vec3<float128> applied_torque_B(const Model<float128>&, float128, const Quaternion<float128>&,
                                                const Vec3<float128>&, bool);

/// The applied torques on the reference and on the rotating motion, each in its own body axes, and their difference over
/// epsilon. All in natural units.
/// @param ref_q_LB, ref_w_LB_B  the non-rotating motion   @param e_w, e_v_scaled  quaternion of R_ref^T R_rot, its vector part
/// divided by epsilon   @param Dw_IB_B_scaled  (w_IB of the rotating motion - w_IB of the reference) / epsilon
template <class T>
Vec3<Paired<T>> applied_torques_B(const Model<T>& model, T t, const Quaternion<T>& ref_q_LB, const Vec3<T>& ref_w_LB_B, T e_w,
                                  const Vec3<T>& e_v_scaled, const Vec3<T>& Dw_IB_B_scaled);
extern template Vec3<Paired<double>> applied_torques_B(const Model<double>&, double, const Quaternion<double>&,
                                                       const Vec3<double>&, double, const Vec3<double>&, const Vec3<double>&);
extern template Vec3<Paired<float80>> applied_torques_B(const Model<float80>&, float80, const Quaternion<float80>&,
                                                        const Vec3<float80>&, float80, const Vec3<float80>&,
                                                        const Vec3<float80>&);
extern template Vec3<Paired<float128>> applied_torques_B(const Model<float128>&, float128, const Quaternion<float128>&,
                                                         const Vec3<float128>&, float128, const Vec3<float128>&,
                                                         const Vec3<float128>&);

}  // namespace earthtop
