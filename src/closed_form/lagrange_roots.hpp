// SPDX-License-Identifier: GPL-3.0-or-later
/// The nutation of the heavy symmetric top: the cubic of u = cos(tilt), its roots, and all differences that the closed form
/// needs of them. None is formed by subtracting nearly equal numbers.
///
/// All quantities are divided by I1: mu = |m g l| / I1, beta = I3 w3 / I1, b = L_z / I1, c = b - beta u (the z component of the
/// angular momentum across the axis), P = |rate across the axis|^2. If the centre of mass lies below the pivot, u and beta
/// change sign, so that mu >= 0:
///
///   (du/dt)^2 = f(u) = (1 - u^2) P(u) - c(u)^2 = 2 mu (u - u1)(u2 - u)(u3 - u),   P(u) = P0 - 2 mu (u - u0)
///
/// -1 <= u1 <= u2 <= 1 <= u3, and P vanishes between u2 and u3, too. Three expansions are used: about the present u0, which
/// lies in [u1, u2]; about u = 1; and about the zero of P; the latter two points lie in [u2, u3]. In each, the root outside the
/// interval is found first, by Newton's method from a side where it converges monotonically; the remaining quadratic has two
/// roots of different sign. The multiple 2 mu u3 is used instead of u3, which goes to infinity for mu -> 0.
///
/// Close to u = 1, at the critical spin (beta^2 = 4 mu) and near the steady rate, the three roots nearly coincide, and the
/// cubic's coefficients are small differences of large terms. There they are computed from numbers that vanish with them,
///
///   V = Omega - i beta conj(A) B,   slack = 4 mu - beta^2,   G = -2 Im(conj(V) conj(A) B) = c - beta (1 - u^2)/2
///
/// so that rounding errors of these numbers act like a change of the start, and all three expansions see the same start.
#pragma once

#include "closed_form/complex.hpp"

namespace earthtop {

/// The data of the nutation at one instant, in a frame in which mu >= 0.
template <class T>
struct NutationData {
  T mu, beta;
  T u0, top, bottom;  ///< u, 1 - u and 1 + u, each to full relative accuracy
  T c0, rate0, P0;    ///< c, du/dt and P at u0
  T slack;            ///< 4 mu - beta^2
  T V2, G;            ///< |V|^2 and G
  bool near_top;      ///< whether V and the slack are more accurate than Omega and mu
};

/// x - y^2 with a single rounding, however close the two are.
template <class T>
T minus_square(T x, T y) {
  return -real::fma(y, y, -x);
}
/// The same for float80, which has no fused multiply-add in hardware: the square as an exact sum (T. J. Dekker, Numer.
/// Math. 18 (1971) 224) and a sum with its rounding error (Knuth). For numbers that come from doubles nothing overflows or
/// underflows here.
template <>
inline float80 minus_square(float80 x, float80 y) {
  constexpr float80 kSplitter = 4294967297.0;  // 2^32 + 1: halves of 32 bits
  const float80 c = kSplitter * y, high = c - (c - y), low = y - high;
  const float80 square = y * y, square_rest = ((high * high - square) + 2 * high * low) + low * low;
  const float80 difference = x - square, shared = difference - x;
  const float80 rest = (x - (difference - shared)) - (square + shared);
  return difference + (rest - square_rest);
}

/// @param A, B  the two complex halves of the unit quaternion, w + i z and x + i y   @param Omega  w1 + i w2
template <class T>
NutationData<T> nutation_data(T mu, T beta, const Complex<T>& A, const Complex<T>& B, const Complex<T>& Omega) {
  const bool flipped = mu < T(0);
  const T up = flipped ? T(-1) : T(1);
  const Complex<T> Z = conj(A) * B;
  const Complex<T> moment = conj(Omega) * Z;  // c - i du/dt = 2 i conj(Omega) Z; 2 i Z is Up in body axes
  NutationData<T> d;
  d.mu = up * mu;
  d.beta = up * beta;
  d.c0 = T(-2) * moment.im;
  d.rate0 = up * T(-2) * moment.re;
  d.P0 = norm2(Omega);
  d.top = T(2) * norm2(flipped ? A : B);
  d.bottom = T(2) * norm2(flipped ? B : A);
  d.u0 = d.top < d.bottom ? T(1) - d.top : d.bottom - T(1);

  d.slack = minus_square(T(4) * d.mu, d.beta);
  const Complex<T> V = Omega + Complex<T>{d.beta * Z.im, -d.beta * Z.re};
  const Complex<T> from_steady = conj(V) * Z;
  d.V2 = norm2(V);
  d.G = T(-2) * from_steady.im;
  const T terms = d.V2 + d.top * (d.P0 + real::abs(d.slack));
  d.near_top = d.top < T(0.125) && terms < real::abs(d.c0 * d.beta) + d.P0 + d.mu * d.top;
  if (d.near_top) d.rate0 = up * T(-2) * from_steady.re;
  return d;
}

template <class T>
struct NutationRoots {
  T s1, s2;      ///< u1 - u0 <= 0 <= u2 - u0
  T width;       ///< u2 - u1
  T gap;         ///< 2 mu (u3 - u2)
  T span;        ///< 2 mu (u3 - u1)
  T beyond;      ///< 2 mu (u3 - u0)
  T top1, top2;  ///< 1 - u1, 1 - u2
  T top3;        ///< 2 mu (u3 - 1)
  T bottom1;     ///< 1 + u1
  T bottom2;     ///< 1 + u2
  T bottom3;     ///< 2 mu (u3 + 1)
  T P1, P2;      ///< P(u1), P(u2)
  T P3;          ///< -P(u3)
  T at_top;      ///< c(1) = b - beta
  T at_bottom;   ///< c(-1) = b + beta
  T at_rest;     ///< 2 mu c at the zero of P: 2 mu c0 - beta P0
  T top_energy;  ///< P(1)
  T span_loss;   ///< relative error of `span` in eps: the size of the terms that it is a sum of, over `span`
  T gap_terms;   ///< size of the terms that `gap` is a sum of
};

/// A root of y^3 + a y^2 + b y + c by Newton's method, from a starting point y from which it converges monotonically.
template <class T>
T newton_root(T y, T a, T b, T c) {
  for (int step = 0; step < 64; ++step) {
    const T value = c + y * (b + y * (a + y)), slope = b + y * (T(2) * a + T(3) * y);
    if (value == T(0) || slope == T(0)) break;
    const T change = value / slope;
    y -= change;
    if (!(real::abs(change) > T(2) * real::epsilon<T>() * real::abs(y))) break;
  }
  return y;
}

/// The two roots of x^2 - sum x - product_size with product_size >= 0: one on either side of 0.
template <class T>
struct SplitRoots {
  T above, below_size;  ///< the positive root, and minus the negative one
  T difference;
};
template <class T>
SplitRoots<T> split_roots(T sum, T product_size) {
  const T difference = real::sqrt(sum * sum + T(4) * product_size);
  const T larger = (real::abs(sum) + difference) / T(2);
  const T smaller = larger > T(0) ? product_size / larger : T(0);
  return sum > T(0) ? SplitRoots<T>{larger, smaller, difference} : SplitRoots<T>{smaller, larger, difference};
}

template <class T>
T not_negative(T x) {
  return x > T(0) ? x : T(0);
}
template <class T>
T ratio(T x, T y) {
  return y > T(0) ? x / y : T(0);
}

template <class T>
NutationRoots<T> nutation_roots(const NutationData<T>& d) {
  NutationRoots<T> r;
  const T twice = T(2) * d.mu;
  const T f0 = d.rate0 * d.rate0;
  T f1 = T(2) * (d.c0 * d.beta - d.u0 * d.P0 - d.mu * d.top * d.bottom);
  T f2 = -(d.P0 - T(2) * twice * d.u0 + d.beta * d.beta);
  r.at_top = d.c0 - d.beta * d.top;
  r.at_bottom = d.c0 + d.beta * d.bottom;
  r.at_rest = twice * d.c0 - d.beta * d.P0;
  r.top_energy = d.P0 - twice * d.top;
  T top_slope = r.top_energy - r.at_top * d.beta;  // -f'(1)/2
  T rest_slope = r.top_energy * (d.P0 + twice * d.bottom) + T(2) * r.at_rest * d.beta;
  if (d.near_top) {
    const T beta2 = d.beta * d.beta, lean = d.slack * d.top, bend = beta2 * d.top * d.top;
    f1 = T(2) * (d.top * d.P0 - d.V2) - lean * d.bottom / T(2);
    f2 = d.slack - d.P0 - T(2) * twice * d.top;
    r.at_top = d.G - d.beta * d.top * d.top / T(2);
    r.at_rest = d.G * (twice - beta2) + d.beta * (lean * d.bottom / T(4) - d.V2);
    top_slope = d.V2 - lean / T(2) + bend / T(4);
    r.top_energy = d.V2 + d.beta * d.G - lean / T(2) - bend / T(4);
    rest_slope = r.top_energy * r.top_energy + d.V2 * (d.slack - beta2) + T(2) * d.beta * d.G * d.slack +
                 lean * (beta2 - twice) - bend * (d.slack / T(2) + d.mu);
  }

  // With y = 2 mu (u - u0) the monic cubic is y^3 + f2 y^2 + 2 mu f1 y + 4 mu^2 f0. Its value at the mean of the roots tells
  // which root stands apart from the others. Newton's method starts at the extreme position that this root can have, which it
  // has if the others coincide.
  const T linear = twice * f1, constant = twice * twice * f0;
  const T mean = -f2 / T(3), radius = real::sqrt(not_negative<T>(f2 * f2 - T(3) * linear)) / T(3);
  const bool low_apart = constant + mean * (linear + mean * (f2 + mean)) > T(0);
  if (low_apart) {
    r.s1 = newton_root<T>(mean - T(2) * radius, f2, linear, constant) / twice;
    if (!(r.s1 < T(0))) r.s1 = T(0);
  } else {
    r.beyond = not_negative<T>(newton_root<T>(mean + T(2) * radius, f2, linear, constant));
    const SplitRoots<T> s = split_roots<T>(ratio<T>(f1 + twice * ratio<T>(f0, r.beyond), r.beyond), ratio<T>(f0, r.beyond));
    r.s1 = -s.below_size;
    r.s2 = s.above;
    r.width = s.difference;
  }
  r.top1 = d.top - r.s1;

  // About u = 1, in the variable 2 mu (1 - u): the sum of the other two roots, and their product -2 mu at_top^2 / top1.
  const T top_product = ratio<T>(r.at_top * r.at_top, r.top1);
  const T top_sum = ratio<T>(top_product - T(2) * top_slope, r.top1);
  const SplitRoots<T> top = split_roots<T>(top_sum, twice * top_product);
  r.top3 = top.below_size;
  r.top2 = top_sum > T(0) ? top.above / twice : ratio<T>(top_product, r.top3);

  if (low_apart) {
    r.gap = top.difference;
    r.beyond = twice * d.top + r.top3;
    const T from_top = not_negative<T>(d.top - r.top2);
    r.s2 = -r.s1 > from_top ? ratio<T>(f0, -r.s1 * r.beyond) : from_top;
    r.width = r.s2 - r.s1;
  } else {
    r.gap = not_negative<T>(r.beyond - twice * r.s2);
  }
  r.span = r.gap + twice * r.width;

  r.span_loss = ratio<T>(d.P0 + T(2) * twice + d.beta * d.beta, r.span);
  const T top_terms = ratio<T>(
      top_product + T(2) * (d.P0 + twice * d.top + real::abs(d.beta) * (real::abs(d.c0) + real::abs(d.beta) * d.top)), r.top1);
  r.gap_terms = low_apart ? top_terms : r.span_loss * r.span;

  r.bottom2 = d.bottom + r.s2;
  r.bottom3 = twice * d.bottom + r.beyond;
  r.bottom1 = ratio<T>(ratio<T>(r.at_bottom * r.at_bottom, r.bottom2), r.bottom3);

  if (!(r.span > T(0))) {  // nothing moves: u1 = u2 = u0, and the quotients above are 0/0
    r.top2 = r.top1;
    r.bottom1 = r.bottom2;
  }

  // About the zero of P, in the variable P itself.
  r.P1 = d.P0 - twice * r.s1;
  const T rest_product = ratio<T>(r.at_rest * r.at_rest, r.P1);
  const T rest_sum = ratio<T>(rest_slope + rest_product, r.P1);
  const SplitRoots<T> rest = split_roots<T>(rest_sum, rest_product);
  r.P2 = rest.above;
  r.P3 = rest.below_size;
  return r;
}

}  // namespace earthtop
