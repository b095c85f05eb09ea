// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "earthtop/closed_form/mean_precession.hpp"
#include "earthtop/model/body.hpp"

namespace earthtop {

/// The constants of the motion of a top that is symmetric about body axis 3, without Earth rotation.
/// @param w_B  rate (rad/s)   @param mgl  torque of gravity (N m), see Scene::axial_gravity_torque_N_m
inline TopConstants top_constants(const Body<double>& body, double mgl, const Quaternion<double>& q_LB,
                                  const Vec3<double>& w_B) {
  return top_constants(SymmetricTop<double>{body.I_BP_B(0, 0), body.I_BP_B(2, 2), mgl}, q_LB, w_B);
}

}  // namespace earthtop
