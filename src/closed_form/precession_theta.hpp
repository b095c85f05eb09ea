// SPDX-License-Identifier: GPL-3.0-or-later
/// The theta function whose argument (phase) is the periodic part of a free body's rotation about its angular momentum.
#pragma once

#include "closed_form/theta.hpp"

namespace earthtop::elliptic {

template <class T>
struct UnitPhasor {
  T cos, sin;
};

/// theta_4(x + i y) with the nome q^2, where q is the nome of Jacobi's functions, x = pi u / (2 K), y = pi eta / (2 K) and 0 <=
/// y <= pi K' / (2 K). The phase of its values has no secular part. For m > 1/2 Jacobi's imaginary transformation turns it, up
/// to a positive factor, into
///   exp(-i y' v / V) theta_2(y' - i v / 2),  nome exp(-V),  v = pi u / (2 K'), V = pi K / (2 K'), y' = pi eta / (4 K').
/// In the notation of `Lattice`, x and v are rate * u, and V is its span.
template <class T>
struct PrecessionTheta {
  /// The n-th term is at most exp(-pi n^2 / 2) times the first.
  static constexpr int kTerms = std::is_same_v<T, float128> ? 8 : std::is_same_v<T, float80> ? 6 : 5;

  bool hyperbolic = false;
  T span = T(0);
  T even[kTerms], odd[kTerms];       ///< weights of the real and of the imaginary part
  T square[kTerms], pronic[kTerms];  ///< exp(-V n^2), exp(-V (n^2 + n)); hyperbolic only
  T linear = T(0);                   ///< y' / V: the phasor omits the part -linear v of the phase; hyperbolic only

  PrecessionTheta() = default;
  /// @param eta  imaginary part of u, 0 <= eta <= K'   @param sign  sign of that imaginary part
  PrecessionTheta(const Lattice<T>& l, T eta, T sign) : hyperbolic(l.hyperbolic), span(l.span) {
    const T y = l.rate * eta;
    for (int n = 0; n < kTerms; ++n) {
      if (hyperbolic) {
        square[n] = n == 0 ? T(1) : real::exp(-span * T(n * n));
        pronic[n] = n == 0 ? T(1) : real::exp(-span * T(n * n + n));
        even[n] = real::cos(T(2 * n + 1) * y / T(2));
        odd[n] = sign * real::sin(T(2 * n + 1) * y / T(2));
      } else {
        const bool counts = n > 0 && l.q > T(0);
        const T size = counts ? T(2 * n * n) * real::log(l.q) : T(0);
        const T alternating = n % 2 ? T(-1) : T(1);
        const T up = counts ? real::exp(size + T(2 * n) * y) : T(0), down = counts ? real::exp(size - T(2 * n) * y) : T(0);
        even[n] = n == 0 ? T(1) : alternating * (up + down);
        odd[n] = -sign * alternating * (up - down);
        square[n] = pronic[n] = T(0);
      }
    }
    if (hyperbolic) linear = sign * (y / T(2)) / span;
  }
  template <class W>
  explicit PrecessionTheta(const PrecessionTheta<W>& wide)
      : hyperbolic(wide.hyperbolic), span(static_cast<T>(wide.span)), linear(static_cast<T>(wide.linear)) {
    for (int n = 0; n < kTerms; ++n) {
      even[n] = static_cast<T>(wide.even[n]);
      odd[n] = static_cast<T>(wide.odd[n]);
      square[n] = static_cast<T>(wide.square[n]);
      pronic[n] = static_cast<T>(wide.pronic[n]);
    }
  }

  /// A positive multiple of exp(i (phase + linear v)) at x or v, whose absolute value is at most the span.
  UnitPhasor<T> phasor(T x) const {
    UnitPhasor<T> sum{T(0), T(0)};
    if (hyperbolic) {
      // Divided by exp(|v| / 2) / 2, so that nothing overflows.
      const T size = real::abs(x), fall = real::exp(-size);
      const T rise = real::exp(size - span);  // 0 on the separatrix, whose span is infinite
      T power_rise = T(1), power_fall = fall;
      for (int n = 0; n < kTerms; ++n) {
        const T up = square[n] * power_rise, down = pronic[n] * power_fall;
        sum.cos += even[n] * (up + down);
        sum.sin += odd[n] * (up - down);
        power_rise *= rise;
        power_fall *= fall;
      }
      if (x < T(0)) sum.sin = -sum.sin;
    } else {
      const auto [s, c] = real::sin_cos(x);
      const T cos_2x = (c - s) * (c + s), sin_2x = T(2) * s * c;
      sum.cos = even[0];
      T cn = cos_2x, sn = sin_2x;
      for (int n = 1; n < 4; ++n) {
        sum.cos += even[n] * cn;
        sum.sin += odd[n] * sn;
        const T next = cn * cos_2x - sn * sin_2x;
        sn = sn * cos_2x + cn * sin_2x;
        cn = next;
      }
    }
    return sum;
  }

  /// The derivative of the phase with respect to x or v at 0.
  T slope() const {
    T value = T(0), derivative = T(0);
    for (int n = 0; n < kTerms; ++n) {
      value += hyperbolic ? pronic[n] * even[n] : even[n];
      derivative += hyperbolic ? pronic[n] * odd[n] * T(2 * n + 1) / T(2) : odd[n] * T(2 * n);
    }
    return derivative / value - linear;
  }
};

}  // namespace earthtop::elliptic
