// SPDX-License-Identifier: GPL-3.0-or-later
/// The arrays of a row as quaternions and vectors again.
#pragma once

#include <array>

#include "earthtop/frames/rotation.hpp"

namespace earthtop {

template <class T>
Quaternion<T> quaternion_of(const std::array<T, 4>& q) {
  return {q[0], Vec3<T>(q[1], q[2], q[3])};
}
template <class T>
Vec3<T> vector_of(const std::array<T, 3>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace earthtop
