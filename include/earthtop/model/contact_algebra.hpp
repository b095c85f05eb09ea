// SPDX-License-Identifier: GPL-3.0-or-later
/// Products and a linear solution for three components over any scalar: numbers, pairs and recorded results, for which Eigen's
/// own are not made.
#pragma once

#include "earthtop/vectors.hpp"

namespace earthtop {

template <class S>
S inner(const Vec3<S>& a, const Vec3<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The solution x of m x = b by Cramer's rule. The matrices of contact are sums of positive definite ones of similar size, for
/// which the rule loses no more digits than elimination.
template <class S>
Vec3<S> solved(const Mat3<S>& m, const Vec3<S>& b) {
  const Vec3<S> c0 = m.col(0), c1 = m.col(1), c2 = m.col(2);
  const Vec3<S> c12 = c1.cross(c2), c20 = c2.cross(c0), c01 = c0.cross(c1);
  const S determinant = inner(c0, c12);
  return {inner(b, c12) / determinant, inner(b, c20) / determinant, inner(b, c01) / determinant};
}

}  // namespace earthtop
