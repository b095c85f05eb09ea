// SPDX-License-Identifier: GPL-3.0-or-later
/// An independent check of closed forms: the equations of motion, integrated by extrapolation in any scalar type.
#pragma once

#include "support/extrapolation.hpp"

namespace earthtop::testing {

/// An array of numbers that can be added and scaled.
template <class T, std::size_t N>
struct Numbers {
  std::array<T, N> x;
  friend Numbers operator+(Numbers a, const Numbers& b) {
    for (std::size_t i = 0; i < N; ++i) a.x[i] += b.x[i];
    return a;
  }
  friend Numbers operator*(T factor, Numbers a) {
    for (T& value : a.x) value *= factor;
    return a;
  }
};

/// The solution of dx/dt = rate(x) at t = t_s from x at 0, in equal steps of order 32. If |rate| h <= 1/2, a step in float128
/// is exact to about 1e-30.
template <class T, std::size_t N, class Rate>
std::array<T, N> extrapolated(const std::array<T, N>& x, T t_s, int steps, const Rate& rate) {
  const auto of_state = [&rate](const Numbers<T, N>& y) { return Numbers<T, N>{rate(y.x)}; };
  Numbers<T, N> y{x};
  for (int k = 0; k < steps; ++k)
    y = test::extrapolated_step<T, Numbers<T, N>, decltype(of_state), 16>(of_state, y, t_s / T(steps));
  return y.x;
}

}  // namespace earthtop::testing
