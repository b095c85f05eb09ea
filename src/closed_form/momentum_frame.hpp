// SPDX-License-Identifier: GPL-3.0-or-later
/// An attitude from the direction l of the angular momentum in the body and the angle psi about it: R_MB = Rz(psi) Rmin(l), where Rmin is
/// the smallest rotation that takes l to axis 3 (R. van Zon and J. Schofield, J. Comput. Phys. 225 (2007) 145).
#pragma once

#include "closed_form/precession_theta.hpp"
#include "earthtop/frames/rotation.hpp"

namespace earthtop {

/// The Hamilton product without Eigen's temporaries.
template <class T>
Quaternion<T> product(const Quaternion<T>& p, const Quaternion<T>& q) {
  return {p.w * q.w - p.v[0] * q.v[0] - p.v[1] * q.v[1] - p.v[2] * q.v[2],
          Vec3<T>(p.w * q.v[0] + q.w * p.v[0] + p.v[1] * q.v[2] - p.v[2] * q.v[1],
                  p.w * q.v[1] + q.w * p.v[1] + p.v[2] * q.v[0] - p.v[0] * q.v[2],
                  p.w * q.v[2] + q.w * p.v[2] + p.v[0] * q.v[1] - p.v[1] * q.v[0])};
}

/// A multiple of the quaternion of Rz(psi) Rmin(l), which is (cos, 0, 0, sin)(1 + l3, l2, -l1, 0): first the smallest rotation
/// that takes l to axis 3, then the rotation about axis 3.
/// @param half_turn  of psi / 2   @param w  1 + l3
template <class T>
Quaternion<T> from_momentum_frame(const elliptic::UnitPhasor<T>& half_turn, const Vec3<T>& l, T w) {
  const T c = half_turn.cos, s = half_turn.sin;
  return {c * w, Vec3<T>(c * l[1] + s * l[0], s * l[1] - c * l[0], s * w)};
}

template <class T>
Quaternion<T> scaled_to_unit(const Quaternion<T>& q) {
  const T inverse = T(1) / real::sqrt(q.w * q.w + q.v[0] * q.v[0] + q.v[1] * q.v[1] + q.v[2] * q.v[2]);
  return {inverse * q.w, Vec3<T>(inverse * q.v[0], inverse * q.v[1], inverse * q.v[2])};
}

}  // namespace earthtop
