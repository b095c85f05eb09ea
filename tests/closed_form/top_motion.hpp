// SPDX-License-Identifier: GPL-3.0-or-later
/// The heavy symmetric top's equations of motion in its attitude and angular momentum, for integration in 113 bits.
#pragma once

#include "closed_form/lagrange_cases.hpp"
#include "support/extrapolation.hpp"

namespace earthtop::test {

struct TopMotion {
  Quaternion<float128> q_NB;
  Vec3<float128> L_N;
  friend TopMotion operator+(const TopMotion& a, const TopMotion& b) {
    return {{a.q_NB.w + b.q_NB.w, a.q_NB.v + b.q_NB.v}, a.L_N + b.L_N};
  }
  friend TopMotion operator*(float128 s, const TopMotion& a) { return {{s * a.q_NB.w, s * a.q_NB.v}, s * a.L_N}; }
};

inline Vec3<float128> rate_of(const SymmetricTop<float128>& top, const TopMotion& x) {  // w_NB_B
  const Vec3<float128> L_B = rotation_matrix(x.q_NB).transpose() * x.L_N;
  return {L_B[0] / top.I1, L_B[1] / top.I1, L_B[2] / top.I3};
}

/// q and w at time t, from dq/dt = q w / 2 and dL/dt = mgl z x n, in `steps` steps.
inline ClosedFormState<float128> integrated(const LagrangeCase& c, float128 t, int steps) {
  const SymmetricTop<float128> top{float128(c.top.I1), float128(c.top.I3), float128(c.top.mgl)};
  const auto rate = [&](const TopMotion& x) {
    const Vec3<float128> w = rate_of(top, x) / float128(2), n = rotation_matrix(x.q_NB).col(2);
    const Quaternion<float128>& q = x.q_NB;
    return TopMotion{{-q.v.dot(w), q.w * w + q.v.cross(w)}, {-top.mgl * n[1], top.mgl * n[0], float128(0)}};
  };
  TopMotion x{wide(c.q0_NB).normalized(), Vec3<float128>::Zero()};
  const Vec3<float128> w0 = wide(c.w0_NB_B);
  x.L_N = rotation_matrix(x.q_NB) * Vec3<float128>(top.I1 * w0[0], top.I1 * w0[1], top.I3 * w0[2]);
  for (int k = 0; k < steps; ++k) x = extrapolated_step<float128>(rate, x, t / float128(steps));
  ClosedFormState<float128> state;
  state.q_NB = x.q_NB.normalized();
  state.w_NB_B = rate_of(top, x);
  return state;
}

}  // namespace earthtop::test
