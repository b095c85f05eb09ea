// SPDX-License-Identifier: GPL-3.0-or-later
/// Quotients theta(v - i eta)/theta_4(v) in the closed form of the top: where the zero lies, how it affects the phase, and the
/// coefficients of the numerator's series. `low` quotients vanish below or at v = 0 (theta_1), the others above or at the
/// half-period (theta_2; on the hyperbolic branch theta_4 over theta_2).
#pragma once

#include "closed_form/elliptic.hpp"

namespace earthtop {

template <class T>
T sign_of(T x) {
  return x < T(0) ? T(-1) : T(1);
}

/// The zero of a theta quotient above the real axis, at the argument eta of the series. On the circular branch 0 <= eta <=
/// ln(1/q)/2, and exp(-2 eta) is stored; on the hyperbolic branch 0 <= eta <= pi/2, and eta itself is stored.
template <class W>
struct Zero {
  W sign;
  W E = W(1), Q = W(0);  ///< exp(-2 eta), q exp(2 eta)
  W eta = W(0);
  W sin2 = W(0), cos2 = W(1);  ///< sine and cosine of 2 eta, hyperbolic branch
};

/// Computes eta from the squares of sn, cn and dn of the zero's imaginary part, with the complementary parameter.
template <class W>
Zero<W> make_zero(const elliptic::Lattice<W>& l, W sign, W sn2, W cn2, W dn2) {
  Zero<W> zero;
  zero.sign = sign;
  if (!(sn2 > W(0))) {
    zero.Q = l.q;
    return zero;
  }
  if (!(cn2 + dn2 > W(0))) {  // only for q = 0: the zero is infinitely far away
    zero.E = W(0);
    return zero;
  }
  const W y = real::sqrt(sn2) * elliptic::carlson_rf<W>(cn2, dn2, W(1));
  zero.eta = l.rate * y;
  if (l.hyperbolic) {
    zero.sin2 = real::sin(W(2) * zero.eta);
    zero.cos2 = real::cos(W(2) * zero.eta);
  } else {
    zero.E = real::exp(W(-2) * zero.eta);
    zero.Q = zero.E > l.q ? l.q / zero.E : W(1);
  }
  return zero;
}

/// The derivative of a quotient's phase with respect to v, taken where the quotient is real or imaginary (at u2 for the low
/// one, at u1 for the others), as `whole - missing`. On the circular branch it is 1 - missing, and the ones cancel between two
/// quotients.
template <class W>
struct PhaseSlope {
  W whole, missing;
};
template <class W>
PhaseSlope<W> phase_slope(const elliptic::Lattice<W>& l, const Zero<W>& zero) {
  constexpr int N = elliptic::kThetaTerms<W>;
  if (l.hyperbolic) {  // theta_4'/theta_4 (eta) at the nome q
    W above = W(0), below = W(1), s0 = W(0), s1 = zero.sin2, c0 = W(1), c1 = zero.cos2;
    for (int n = 1; n < N; ++n) {
      const W sign = n % 2 ? W(1) : W(-1);
      above += sign * W(4 * n) * l.square[n] * s1;
      below -= sign * W(2) * l.square[n] * c1;
      const W s2 = W(2) * zero.cos2 * s1 - s0, c2 = W(2) * zero.cos2 * c1 - c0;
      s0 = s1, s1 = s2, c0 = c1, c1 = c2;
    }
    return {W(0), -zero.sign * above / below};
  }
  W above = W(0), below = W(0), power_E = zero.E, power_Q = W(1);
  for (int n = 0; n < N; ++n, power_E *= zero.E, power_Q *= zero.Q) {
    const W rising = l.square[n] * power_Q, falling = l.pronic[n] * power_E;
    above += W(2 * n + 2) * falling - W(2 * n) * rising;
    below += rising + falling;
  }
  return {zero.sign, zero.sign * above / below};
}

template <class T, class W, class Q>
void set_coefficients(const elliptic::Lattice<W>& l, const Zero<W>& zero, bool low, Q& quotient) {
  constexpr int N = elliptic::kThetaTerms<T>;
  if (l.hyperbolic) {
    // cos and sin of (2n + 1) eta for the low quotient, of 2 n eta for the others.
    const T sin1 = real::sin(static_cast<T>(zero.eta)), cos1 = real::cos(static_cast<T>(zero.eta));
    const T twice = static_cast<T>(W(2) * zero.cos2);
    T s0 = low ? -sin1 : -static_cast<T>(zero.sin2), s1 = low ? sin1 : T(0);
    T c0 = low ? cos1 : static_cast<T>(zero.cos2), c1 = low ? cos1 : T(1);
    for (int n = 0; n < N; ++n) {
      const T sign = n % 2 ? T(-1) : T(1);
      quotient.re[n] = sign * c1;
      quotient.im[n] = -static_cast<T>(zero.sign) * sign * s1;
      const T s2 = twice * s1 - s0, c2 = twice * c1 - c0;
      s0 = s1, s1 = s2, c0 = c1, c1 = c2;
    }
    return;
  }
  W power_E = zero.E, power_Q = W(1);
  for (int n = 0; n < N; ++n, power_E *= zero.E, power_Q *= zero.Q) {
    const W rising = l.square[n] * power_Q, falling = l.pronic[n] * power_E;
    const W sign = low && n % 2 ? W(-1) : W(1);
    quotient.re[n] = static_cast<T>(sign * (rising + falling));
    quotient.im[n] = static_cast<T>(zero.sign * (low ? -sign : sign) * (rising - falling));
  }
}

}  // namespace earthtop
