// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "closed_form/mean_precession.hpp"
#include "earthtop/frames/rotation.hpp"
#include "earthtop/model/body.hpp"

namespace earthtop {

/// What a top that is symmetric about body axis 3 conserves without Earth rotation.
/// @param mgl  torque of gravity (N m), see Scene::axial_gravity_torque_N_m   @param w_B  rate (rad/s)
inline TopConstants top_constants(const Body<double>& body, double mgl, const Quaternion<double>& q_LB,
                                  const Vec3<double>& w_B) {
  const double I1 = body.I_BP_B(0, 0), axial = body.I_BP_B(2, 2) / I1 * w_B[2];
  const Mat3<double> R_LB = rotation_matrix(q_LB);
  const double gravity = 2 * mgl / I1;
  return {w_B[0] * w_B[0] + w_B[1] * w_B[1] + gravity * R_LB(2, 2),
          R_LB(2, 0) * w_B[0] + R_LB(2, 1) * w_B[1] + R_LB(2, 2) * axial, axial, gravity};
}

}  // namespace earthtop
