// SPDX-License-Identifier: GPL-3.0-or-later
/// The result of a closed form at one instant, and the parameters of a symmetric top.
#pragma once

#include "earthtop/frames/rotation.hpp"
#include "earthtop/members.hpp"

namespace earthtop {

/// The whole motion at one instant, in inertial axes N that coincide with the laboratory's (East, North, Up) at t = 0.
template <class T>
struct ClosedFormState {
  Quaternion<T> q_NB;                ///< of unit norm; either sign
  Vec3<T> w_NB_B = Vec3<T>::Zero();  ///< rad/s
  T attitude_error = T(0);           ///< stated error: bound on the angle between q_NB and the exact motion (rad)
  T rate_error = T(0);               ///< bound on the error of w_NB_B (rad/s)
};

/// A symmetric top on its pivot: body axis 3 is the axis of symmetry and carries the centre of mass.
template <class T>
struct SymmetricTop {
  T I1 = T(1);   ///< both moments about the pivot across the axis (kg m^2)
  T I3 = T(1);   ///< moment along the axis (kg m^2)
  T mgl = T(0);  ///< mass x apparent gravity x signed distance of the centre of mass from the pivot (N m)
  EARTHTOP_MEMBERS(I1, I3, mgl)
};

}  // namespace earthtop
