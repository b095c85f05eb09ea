// SPDX-License-Identifier: GPL-3.0-or-later
/// Small changes of the non-rotating motion, which the solution of the rotating one is put together from.
///
/// A change x of the motion, measured in the frame F' (plain_torus.hpp), satisfies linear equations dx/dt = L(theta1) x. Their
/// solutions are M(t) x(0). After one period T all motions near this one have come back to where they were, but for their own
/// rates: M(T) = 1 + N T, where N takes a change of the release to a shift along the motion, so that N N = 0. Therefore
/// Q(theta1) = M (1 - N t) is periodic, and x = Q c turns dx/dt = L x + f into dc/dt = N c + Q^-1 f, which the harmonics of c
/// solve one by one. This is regular for every motion that has a period, also without nutation and through the vertical.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "integrate/fourier/plain_torus.hpp"
#include "integrate/fourier/torus_grid.hpp"

namespace earthtop {

template <class T>
struct TangentFrame {
  using Matrix = Eigen::Matrix<T, 5, 5>;
  std::vector<Matrix> Q, Q_inverse;  ///< at the points of the nutation
  Matrix N = Matrix::Zero();

  /// M is taken from differences of closed forms. Its error makes the solution take a pass more, and is in no result.
  /// @param plain  sampled in as many points
  explicit TangentFrame(const PlainTorus<T>& plain);
};

template <class T>
TangentFrame<T>::TangentFrame(const PlainTorus<T>& plain) {
  const SpinlessTop<T>& top = plain.top();
  const std::size_t n = plain.points().size();
  const T period = plain.period(), rate = plain.nutation(), c = plain.turn_about_axis();
  const T apart = T(real::cbrt(static_cast<double>(real::epsilon<T>())));
  std::vector<Matrix> M(n + 1, Matrix::Zero());
  std::vector<ClosedFormState<T>> here(n + 1);
  for (std::size_t i = 0; i <= n; ++i) here[i] = plain.closed_form().at(period * T(i) / T(n));
  for (int column = 0; column < 5; ++column)
    for (const T side : {apart, T(-apart)}) {
      SpinlessTop<T> moved = top;
      if (column < 3) {
        Vec3<T> v = Vec3<T>::Zero();
        v[column] = side;
        moved.q_LF = top.q_LF * Quaternion<T>{real::sqrt(T(1) - side * side), v};
      } else {
        (column == 3 ? moved.across.re : moved.across.im) += side * rate;
      }
      const LagrangeTop<T> motion = closed_form_of(moved, ClosedFormSpan::few_periods);
      for (std::size_t i = 0; i <= n; ++i) {
        const T t = period * T(i) / T(n);
        const ClosedFormState<T> there = motion.at(t);
        const Quaternion<T> e = here[i].q_NB.conjugate() * there.q_NB;
        const T sign = e.w < T(0) ? T(-1) : T(1);
        const Complex<T> into = turned(T(c * t)), v = into * Complex<T>{e.v[0], e.v[1]},
                         w = into * Complex<T>{there.w_NB_B[0] - here[i].w_NB_B[0], there.w_NB_B[1] - here[i].w_NB_B[1]};
        TorusVector<T> x;
        x << sign * v.re, sign * v.im, sign * e.v[2], w.re / rate, w.im / rate;
        M[i].col(column) += x / (T(2) * side);
      }
    }
  N = (M[n] - Matrix::Identity()) / period;
  Q.resize(n), Q_inverse.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Q[i] = M[i] * (Matrix::Identity() - (period * T(i) / T(n)) * N);
    Q_inverse[i] = Q[i].inverse();
  }
}

}  // namespace earthtop
