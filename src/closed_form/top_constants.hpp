// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "closed_form/mean_precession.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/frames/rotation.hpp"
#include "earthtop/model/body.hpp"

namespace earthtop {

/// The constants of the motion of a top that is symmetric about body axis 3, without Earth rotation.
/// @param w_B  rate (rad/s)
inline TopConstants top_constants(const SymmetricTop<double>& body, const Quaternion<double>& q_LB, const Vec3<double>& w_B) {
  const double axial = body.I3 / body.I1 * w_B[2], gravity = 2 * body.mgl / body.I1;
  const Mat3<double> R_LB = rotation_matrix(q_LB);
  return {w_B[0] * w_B[0] + w_B[1] * w_B[1] + gravity * R_LB(2, 2),
          R_LB(2, 0) * w_B[0] + R_LB(2, 1) * w_B[1] + R_LB(2, 2) * axial, axial, gravity};
}
/// @param mgl  torque of gravity (N m), see Scene::axial_gravity_torque_N_m
inline TopConstants top_constants(const Body<double>& body, double mgl, const Quaternion<double>& q_LB,
                                  const Vec3<double>& w_B) {
  return top_constants(SymmetricTop<double>{body.I_BP_B(0, 0), body.I_BP_B(2, 2), mgl}, q_LB, w_B);
}

}  // namespace earthtop
