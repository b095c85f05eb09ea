// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts the arrays of rows to quaternions and vectors.
#pragma once

#include "earthtop/drift/drift.hpp"
#include "earthtop/frames/rotation.hpp"
#include "verify/differences.hpp"

namespace earthtop::verify_detail {

template <class T = double>
Quaternion<T> quaternion(const std::array<double, 4>& q) {
  return {T(q[0]), Vec3<T>(T(q[1]), T(q[2]), T(q[3]))};
}
template <class T = double>
Vec3<T> vector(const std::array<double, 3>& v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}

/// The angle between two attitudes (rad); norms and signs do not matter.
template <class T>
double attitude_distance(const Quaternion<T>& p, const Quaternion<T>& q) {
  const Quaternion<T> d = p.conjugate() * q;
  return static_cast<double>(T(2) * real::atan2(norm(d.v), real::abs(d.w)));
}

}  // namespace earthtop::verify_detail
