// SPDX-License-Identifier: GPL-3.0-or-later
/// Loads and stores three components of a state as a vector; loads four as a quaternion.
#pragma once

#include <array>

#include "earthtop/frames/rotation.hpp"

namespace earthtop {

template <class T, std::size_t N>
Vec3<T> load_vector(const std::array<T, N>& x, std::size_t at) {
  return {x[at], x[at + 1], x[at + 2]};
}
template <class T, std::size_t N>
Quaternion<T> load_quaternion(const std::array<T, N>& x, std::size_t at) {
  return {x[at], load_vector(x, at + 1)};
}
template <class T, std::size_t N, class V>
void store_vector(const V& v, std::array<T, N>& x, std::size_t at) {
  const Vec3<T> values = v;
  for (std::size_t i = 0; i < 3; ++i) x[at + i] = values[static_cast<int>(i)];
}

}  // namespace earthtop
