// SPDX-License-Identifier: GPL-3.0-or-later
/// Three-dimensional vectors and matrices over every scalar type of real.hpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "earthtop/real.hpp"

// The library is compiled with this macro. A linker keeps only one copy of each Eigen function for all objects. If user code
// were compiled without the macro, that copy might be the user's, which sums in another order (vector instructions): the last
// digits of results would then depend on the order of linking.
#ifndef EIGEN_DONT_VECTORIZE
#error "earthtop's headers need EIGEN_DONT_VECTORIZE, which its CMake targets and pkg-config files define"
#endif

namespace earthtop {

template <class T>
using Vec3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Mat3 = Eigen::Matrix<T, 3, 3>;

template <class T>
T norm(const Vec3<T>& v) {
  return real::hypot(v[0], v[1], v[2]);
}

/// Products of 3x3 matrices and vectors for the inner loops, written out: compilers make code from this that is twice as fast
/// as from Eigen's vectorised code for three components.
template <class T>
Vec3<T> times(const Mat3<T>& m, const Vec3<T>& v) {
  return {m(0, 0) * v[0] + m(0, 1) * v[1] + m(0, 2) * v[2], m(1, 0) * v[0] + m(1, 1) * v[1] + m(1, 2) * v[2],
          m(2, 0) * v[0] + m(2, 1) * v[1] + m(2, 2) * v[2]};
}
template <class T>
Vec3<T> transposed_times(const Mat3<T>& m, const Vec3<T>& v) {
  return {m(0, 0) * v[0] + m(1, 0) * v[1] + m(2, 0) * v[2], m(0, 1) * v[0] + m(1, 1) * v[1] + m(2, 1) * v[2],
          m(0, 2) * v[0] + m(1, 2) * v[1] + m(2, 2) * v[2]};
}
/// R m R^T: transforms the components of a tensor from body axes to outer axes.
template <class T>
Mat3<T> turned_tensor(const Mat3<T>& R, const Mat3<T>& m) {
  Mat3<T> half, turned;
  for (int j = 0; j < 3; ++j) half.col(j) = times<T>(R, m.col(j));
  const Mat3<T> half_transposed = half.transpose();
  for (int j = 0; j < 3; ++j) turned.row(j) = times<T>(R, half_transposed.col(j)).transpose();
  return turned;
}

/// The matrix [v]x with [v]x u = v x u.
template <class T>
Mat3<T> cross_matrix(const Vec3<T>& v) {
  Mat3<T> m;
  m << T(0), -v[2], v[1], v[2], T(0), -v[0], -v[1], v[0], T(0);
  return m;
}

}  // namespace earthtop

#ifdef __SIZEOF_FLOAT128__
namespace Eigen {
template <>
struct NumTraits<earthtop::float128> : GenericNumTraits<double> {
  using Real = earthtop::float128;
  using NonInteger = earthtop::float128;
  using Literal = earthtop::float128;
  using Nested = earthtop::float128;
  static earthtop::float128 epsilon() { return earthtop::real::epsilon<earthtop::float128>(); }
  static earthtop::float128 dummy_precision() { return 16 * epsilon(); }
};
}  // namespace Eigen
#endif
