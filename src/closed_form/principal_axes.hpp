// SPDX-License-Identifier: GPL-3.0-or-later
/// Principal moments and axes of a symmetric tensor, by Jacobi's rotations.
#pragma once

#include "earthtop/frames/rotation.hpp"

namespace earthtop {

template <class T>
struct PrincipalAxes {
  Vec3<T> moments;
  Quaternion<T> q_BP;  ///< takes components in the principal axes P to the axes B of the tensor
};

/// q_BP of axes P that are the body's, renumbered cyclically so that axis 3 is the one given: a third of a turn about
/// (1, 1, 1), or none.
template <class T>
Quaternion<T> third_axis_is(int axis) {
  if (axis == 2) return {};
  const T half = T(1) / T(2), v = axis == 0 ? half : -half;
  return {half, Vec3<T>(v, v, v)};
}

/// The errors of the moments are a few eps of the largest moment. A tensor without products of inertia keeps its diagonal
/// exactly, with q_BP = 1. Only the lower triangle is read.
template <class T>
PrincipalAxes<T> principal_axes(const Mat3<T>& tensor_B) {
  Vec3<T> diagonal = tensor_B.diagonal();
  Vec3<T> product(tensor_B(2, 1), tensor_B(2, 0), tensor_B(1, 0));  // product[k] couples the two axes other than k
  Quaternion<T> q_BP;
  // Convergence is quadratic: at most a dozen sweeps even at 113 bits.
  for (int sweep = 0; sweep < 40; ++sweep) {
    bool done = true;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const T small =
          real::epsilon<T>() * real::epsilon<T>() * real::sqrt(real::abs(diagonal[i])) * real::sqrt(real::abs(diagonal[j]));
      if (!(real::abs(product[k]) > small)) {
        product[k] = T(0);
        continue;
      }
      done = false;
      // The rotation about axis k that removes the product; t is the tangent of its angle.
      const T theta = (diagonal[j] - diagonal[i]) / (T(2) * product[k]);
      const T t = (theta < T(0) ? T(-1) : T(1)) / (real::abs(theta) + real::sqrt(T(1) + theta * theta));
      const T c = T(1) / real::sqrt(T(1) + t * t), s = t * c;
      diagonal[i] -= t * product[k];
      diagonal[j] += t * product[k];
      product[k] = T(0);
      const T with_i = product[j], with_j = product[i];  // couplings of axis k with i and with j
      product[j] = c * with_i - s * with_j;
      product[i] = s * with_i + c * with_j;
      // New axis i = c e_i - s e_j, new axis j = s e_i + c e_j: a rotation about e_k by minus the angle.
      const T half = real::sqrt((T(1) + c) / T(2));
      q_BP = q_BP * Quaternion<T>{half, (-s / (T(2) * half)) * Vec3<T>::Unit(k)};
    }
    if (done) break;
  }
  return {diagonal, q_BP.normalized()};
}

}  // namespace earthtop
