// SPDX-License-Identifier: GPL-3.0-or-later
/// A number with its derivatives by N inputs. Arithmetic applies the chain rule, so that derivatives are exact except for
/// rounding.
///
/// Jets live in the namespace `real`. This header has to be included before any header whose templates call the functions of
/// that namespace.
#pragma once

#include <array>

#include "earthtop/vectors.hpp"

namespace earthtop::real {

template <std::size_t N>
struct Jet {
  double value = 0;
  std::array<double, N> d = {};

  Jet() = default;
  constexpr Jet(double x) : value(x) {}  // NOLINT(google-explicit-constructor): numbers in formulas are constants
  explicit Jet(int x) : value(x) {}

  Jet& operator+=(const Jet& y) {
    value += y.value;
    for (std::size_t i = 0; i < N; ++i) d[i] += y.d[i];
    return *this;
  }
  Jet& operator-=(const Jet& y) {
    value -= y.value;
    for (std::size_t i = 0; i < N; ++i) d[i] -= y.d[i];
    return *this;
  }
  Jet& operator*=(const Jet& y) {
    for (std::size_t i = 0; i < N; ++i) d[i] = d[i] * y.value + value * y.d[i];
    value *= y.value;
    return *this;
  }
  Jet& operator/=(const Jet& y) {
    value /= y.value;
    for (std::size_t i = 0; i < N; ++i) d[i] = (d[i] - value * y.d[i]) / y.value;
    return *this;
  }
  friend Jet operator+(Jet x, const Jet& y) { return x += y; }
  friend Jet operator-(Jet x, const Jet& y) { return x -= y; }
  friend Jet operator*(Jet x, const Jet& y) { return x *= y; }
  friend Jet operator/(Jet x, const Jet& y) { return x /= y; }
  friend Jet operator-(Jet x) {
    x.value = -x.value;
    for (double& di : x.d) di = -di;
    return x;
  }
  explicit operator int() const { return static_cast<int>(value); }
  friend bool operator<(const Jet& x, const Jet& y) { return x.value < y.value; }
  friend bool operator>(const Jet& x, const Jet& y) { return x.value > y.value; }
  friend bool operator<=(const Jet& x, const Jet& y) { return x.value <= y.value; }
  friend bool operator>=(const Jet& x, const Jet& y) { return x.value >= y.value; }
  friend bool operator==(const Jet& x, const Jet& y) { return x.value == y.value; }
};

/// x y + z with one rounding of the value.
template <std::size_t N>
Jet<N> fma(const Jet<N>& x, const Jet<N>& y, const Jet<N>& z) {
  Jet<N> sum = fma(x.value, y.value, z.value);
  for (std::size_t i = 0; i < N; ++i) sum.d[i] = x.d[i] * y.value + x.value * y.d[i] + z.d[i];
  return sum;
}
template <std::size_t N>
Jet<N> round(const Jet<N>& x) {
  return round(x.value);
}
template <std::size_t N>
Jet<N> scale(Jet<N> x, int exponent) {
  x.value = scale(x.value, exponent);
  for (double& di : x.d) di = scale(di, exponent);
  return x;
}
/// A function of x, given its value f and its slope there.
template <std::size_t N>
Jet<N> composed(const Jet<N>& x, double f, double slope) {
  Jet<N> y = f;
  for (std::size_t i = 0; i < N; ++i) y.d[i] = slope * x.d[i];
  return y;
}
template <std::size_t N>
Jet<N> sqrt(const Jet<N>& x) {
  const double root = std::sqrt(x.value);
  return composed(x, root, 0.5 / root);
}
/// x to a power that does not depend on the inputs.
template <std::size_t N>
Jet<N> pow(const Jet<N>& x, const Jet<N>& exponent) {
  const double p = exponent.value;
  return composed(x, real::pow(x.value, p), p * real::pow(x.value, p - 1));
}
template <std::size_t N>
Jet<N> atan2(const Jet<N>& y, const Jet<N>& x) {
  // Numbers are scaled, as the squares of deviations would underflow for a tiny Earth rate.
  const double size = hypot(x.value, y.value), c = x.value / size, s = y.value / size;
  Jet<N> angle = real::atan2(y.value, x.value);
  for (std::size_t i = 0; i < N; ++i) angle.d[i] = c * (y.d[i] / size) - s * (x.d[i] / size);
  return angle;
}
template <std::size_t N>
Jet<N> sin(const Jet<N>& x) {
  const SinCos<double> both = sin_cos(x.value);
  return composed(x, both.sin, both.cos);
}
template <std::size_t N>
Jet<N> cos(const Jet<N>& x) {
  const SinCos<double> both = sin_cos(x.value);
  return composed(x, both.cos, -both.sin);
}

}  // namespace earthtop::real

namespace Eigen {
template <std::size_t N>
struct NumTraits<earthtop::real::Jet<N>> : GenericNumTraits<double> {
  using Real = earthtop::real::Jet<N>;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = N, AddCost = N, MulCost = 2 * N };
};
}  // namespace Eigen
