// SPDX-License-Identifier: GPL-3.0-or-later
/// Theta series with a nome q <= exp(-pi) (DLMF 20.2).
///
/// For m <= 1/2 the terms of the series are circular functions, sin((2n + 1) v) and cos(2 n v) with v = pi x / (2 K). For m >
/// 1/2 Jacobi's imaginary transformation (DLMF 20.7(viii)) makes them hyperbolic, sinh((2n + 1) xi) and cosh(2 n xi), |xi| <=
/// ln(1/q)/2.
#pragma once

#include <type_traits>

#include "earthtop/real.hpp"

namespace earthtop::elliptic {

/// Number of terms n = 0, 1, ... of a theta series that matter: the n-th is at most exp(-pi (n^2 - n)) times the first, a bound
/// that is reached at the end of the hyperbolic range.
template <class T>
inline constexpr int kThetaTerms = std::is_same_v<T, float128>  ? 6
                                   : std::is_same_v<T, float80> ? 5
                                                                : 4;

/// The nome of a parameter m <= 1/2, with a relative error of a few eps down to m = 0, by Weierstrass's series in (1 - sqrt k')
/// / (1 + sqrt k') / 2 (Whittaker & Watson 21.8).
template <class T>
T nome(T m, T m1) {
  const T k1 = real::sqrt(m1), root = real::sqrt(k1);
  const T half = m / (T(2) * (T(1) + k1) * (T(1) + root) * (T(1) + root));
  const T x = half * half * half * half;
  T series = T(1707);
  if constexpr (std::is_same_v<T, float128>)
    series += x * (T(20910) + x * (T(268616) + x * (T(3567400) + x * T(48555069))));
  else
    series += x * T(20910);
  return half + half * (x * (T(2) + x * (T(15) + x * (T(150) + x * series))));
}

/// The numbers that all series of one parameter share. The nome q is that of m for m <= 1/2, and that of m1 for m > 1/2.
template <class T>
struct Lattice {
  bool hyperbolic = false;
  T q = T(0);                      ///< <= exp(-pi)
  T rate = T(1);                   ///< factor from the argument of Jacobi's functions to that of the series: pi/(2K), or
                                   ///< pi/(2K')
  T K = T(0);                      ///< quarter period; infinite for m1 = 0
  T span = T(0);                   ///< rate * K: pi/2, or ln(1/q)/2
  T square[kThetaTerms<T>];        ///< q^(n^2)
  T pronic[kThetaTerms<T>];        ///< q^(n^2 + n)
  T theta2 = T(0);                 ///< theta_2(0) / (2 q^(1/4)) = sum_n>=0 q^(n^2 + n)
  T theta3 = T(0), theta4 = T(0);  ///< theta_3(0), theta_4(0)
};

template <class T>
Lattice<T> lattice(T m, T m1) {
  Lattice<T> l;
  l.hyperbolic = m > m1;
  l.q = l.hyperbolic ? nome<T>(m1, m) : nome<T>(m, m1);
  T power = T(1);  // q^n
  for (int n = 0; n < kThetaTerms<T>; ++n, power *= l.q) {
    l.square[n] = n == 0 ? T(1) : l.pronic[n - 1] * power;
    l.pronic[n] = l.square[n] * power;
    l.theta2 += l.pronic[n];
    const T twice = n == 0 ? T(1) : T(2) * l.square[n];
    l.theta3 += twice;
    l.theta4 += n % 2 ? -twice : twice;
  }
  l.rate = T(1) / (l.theta3 * l.theta3);
  l.span = l.hyperbolic ? -real::log(l.q) / T(2) : real::pi<T>() / T(2);
  l.K = l.span / l.rate;
  return l;
}

/// An argument xi of the hyperbolic series, in terms that neither overflow nor, near xi = 0, cancel.
template <class T>
struct HyperbolicPoint {
  T sign;  ///< sign of xi
  T E;     ///< exp(-2 |xi|)
  T Q;     ///< q exp(2 |xi|) = exp(2 |xi| - 2 span)
};
template <class T>
HyperbolicPoint<T> hyperbolic_point(const Lattice<T>& l, T xi) {
  const T size = real::abs(xi);
  return {xi < T(0) ? T(-1) : T(1), real::exp(T(-2) * size), l.q > T(0) ? real::exp(T(2) * (size - l.span)) : T(0)};
}

}  // namespace earthtop::elliptic
