// SPDX-License-Identifier: GPL-3.0-or-later
/// The free body's equations of motion, integrated.
#pragma once

#include "earthtop/closed_form/state.hpp"
#include "support/extended_integration.hpp"

namespace earthtop::testing {

/// Euler's equations and dq/dt = q w / 2, integrated in equal steps of the extrapolation method.
template <class T>
ClosedFormState<T> integrated_free_body(const Vec3<T>& I, const Quaternion<T>& q0_NB, const Vec3<T>& w0, T t_s, int steps) {
  const Quaternion<T> q = q0_NB.normalized();
  const auto rate = [&I](const std::array<T, 7>& x) {
    const T a = x[4], b = x[5], c = x[6];
    return std::array<T, 7>{-(x[1] * a + x[2] * b + x[3] * c) / 2, (x[0] * a + x[2] * c - x[3] * b) / 2,
                            (x[0] * b + x[3] * a - x[1] * c) / 2,  (x[0] * c + x[1] * b - x[2] * a) / 2,
                            (I[1] - I[2]) / I[0] * b * c,          (I[2] - I[0]) / I[1] * c * a,
                            (I[0] - I[1]) / I[2] * a * b};
  };
  const auto x = extrapolated<T, 7>({q.w, q.v[0], q.v[1], q.v[2], w0[0], w0[1], w0[2]}, t_s, steps, rate);
  return {Quaternion<T>{x[0], Vec3<T>(x[1], x[2], x[3])}.normalized(), Vec3<T>(x[4], x[5], x[6]), T(0), T(0)};
}

}  // namespace earthtop::testing
