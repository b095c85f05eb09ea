// SPDX-License-Identifier: GPL-3.0-or-later
/// Quaternions and vectors as the arrays of a row, and back.
#pragma once

#include <array>

#include "earthtop/frames/rotation.hpp"

namespace earthtop {

/// Replaces -0 by 0, because zeros in a row have no sign.
template <class T>
std::array<T, 3> to_array(const Vec3<T>& v) {
  return {v[0] + T(0), v[1] + T(0), v[2] + T(0)};
}
template <class T>
std::array<T, 4> to_array(const Quaternion<T>& q) {
  return {q.w + T(0), q.v[0] + T(0), q.v[1] + T(0), q.v[2] + T(0)};
}

template <class T>
Quaternion<T> quaternion_of(const std::array<T, 4>& q) {
  return {q[0], Vec3<T>(q[1], q[2], q[3])};
}
template <class T>
Vec3<T> vector_of(const std::array<T, 3>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace earthtop
