// SPDX-License-Identifier: GPL-3.0-or-later
/// Jacobi's elliptic functions for every scalar type (DLMF 22.2), by theta series. Includes Carlson's integrals and the
/// lattice.
///
/// A lattice is made from the parameter m = k^2 *and* its complement m1 = 1 - m, both with full relative accuracy: then no
/// digits are lost for m -> 0 or m -> 1.
#pragma once

#include "closed_form/carlson.hpp"
#include "closed_form/theta.hpp"

namespace earthtop::elliptic {

/// sn, cn, dn and the amplitude (rad, continuous in the argument) at one argument.
template <class T>
struct JacobiValues {
  T sn, cn, dn, am;
};

/// Jacobi's functions at x. The absolute errors are a few eps, plus the effect of an error |x| eps of the argument; near its
/// zero at 0 sn has a small relative error.
template <class T>
JacobiValues<T> jacobi(T x, const Lattice<T>& l) {
  constexpr int N = kThetaTerms<T>;
  const T turns = real::isfinite(l.K) ? real::rint(x / (T(2) * l.K)) : T(0);
  const T argument = turns != T(0) ? real::fma(T(-2) * turns, l.K, x) : x;
  JacobiValues<T> j;
  if (!l.hyperbolic) {
    const auto [s, c] = real::sin_cos(T(l.rate * argument));
    const T twice = T(2) * (c - s) * (c + s);  // 2 cos 2v
    T sn = T(0), cn = T(0), up = T(1), down = T(1);
    // sin((2n+1)v)/sin v, cos((2n+1)v)/cos v and 2 cos(2nv), each by its three-term recurrence.
    T s0 = T(-1), s1 = T(1), c0 = T(1), c1 = T(1), d0 = twice, d1 = T(2);
    for (int n = 0; n < N; ++n) {
      const T sign = n % 2 ? T(-1) : T(1);
      sn += sign * l.pronic[n] * s1;
      cn += l.pronic[n] * c1;
      if (n > 0) up += l.square[n] * d1, down += sign * l.square[n] * d1;
      const T s2 = twice * s1 - s0, c2 = twice * c1 - c0, d2 = twice * d1 - d0;
      s0 = s1, s1 = s2, c0 = c1, c1 = c2, d0 = d1, d1 = d2;
    }
    j.sn = l.theta3 / l.theta2 * s * sn / down;
    j.cn = l.theta4 / l.theta2 * c * cn / down;
    j.dn = l.theta4 / l.theta3 * up / down;
  } else {
    const HyperbolicPoint<T> p = hyperbolic_point<T>(l, l.rate * argument);
    const T root = real::exp(-real::abs(l.rate * argument));
    // All sums are divided by exp(|xi|)/2: sinh((2n+1)xi) = (1 - E) (1 + E + ... + E^2n) q^-n Q^n, and so on.
    T sinh = T(0), cosh = T(0), up = T(1), down = T(1), geometric = T(1), odd_E = p.E;
    T power_E = T(1), power_Q = T(1);
    for (int n = 0; n < N; ++n) {
      const T sign = n % 2 ? T(-1) : T(1);
      const T rising = l.square[n] * power_Q;
      sinh += sign * rising * geometric;
      cosh += rising + l.pronic[n] * power_E * p.E;
      if (n > 0) {
        const T pair = l.pronic[n - 1] * power_Q + l.square[n] * power_E;
        up += pair;
        down += sign * pair;
      }
      power_E *= p.E;
      power_Q *= p.Q;
      geometric += odd_E * (T(1) + p.E);
      odd_E *= p.E * p.E;
    }
    const T difference = -real::expm1(T(-2) * real::abs(l.rate * argument));
    j.sn = p.sign * l.theta3 / l.theta4 * difference * sinh / cosh;
    j.cn = l.theta2 / l.theta4 * T(2) * root * down / cosh;
    j.dn = l.theta2 / l.theta3 * T(2) * root * up / cosh;
  }
  j.am = turns * real::pi<T>() + real::atan2(j.sn, j.cn);
  if (real::fmod(turns, T(2)) != T(0)) j.sn = -j.sn, j.cn = -j.cn;
  return j;
}

}  // namespace earthtop::elliptic
