/// An independent truth for closed forms: the plain equations of motion by extrapolation of the modified midpoint rule
/// (Gragg, Bulirsch and Stoer; Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.9), fixed steps, in
/// any scalar.
#pragma once

#include <array>

namespace earthtop::testing {

/// The state at t = t_s of dx/dt = rate(x), from x at 0, in equal steps. Sixteen columns of the sequence 2, 4, 6, ...:
/// order 32. With |rate| h <= 1/2 a step is right to 1e-30 or so in float128.
template <class T, std::size_t N, class Rate>
std::array<T, N> extrapolated(std::array<T, N> x, T t_s, int steps, const Rate& rate) {
  using State = std::array<T, N>;
  constexpr int kColumns = 16;
  const auto plus = [](const State& a, T factor, const State& b) {
    State sum;
    for (std::size_t i = 0; i < N; ++i) sum[i] = a[i] + factor * b[i];
    return sum;
  };
  const T step = t_s / T(steps);
  for (int k = 0; k < steps; ++k) {
    std::array<State, kColumns> row;
    for (int j = 0; j < kColumns; ++j) {
      const int n = 2 * (j + 1);
      const T h = step / T(n);
      State before = x, now = plus(x, h, rate(x));
      for (int i = 1; i < n; ++i) {
        const State next = plus(before, T(2) * h, rate(now));
        before = now;
        now = next;
      }
      const State last = plus(before, h, rate(now));
      State value = plus(State{}, T(1) / T(2), plus(now, T(1), last));
      // Aitken and Neville in h^2, in place: row[i] keeps the last value of column i.
      for (int i = 0; i < j; ++i) {
        const T ratio = T(n) / T(2 * (j - i)), weight = T(1) / (ratio * ratio - T(1));
        const State improved = plus(value, weight, plus(value, T(-1), row[static_cast<std::size_t>(i)]));
        row[static_cast<std::size_t>(i)] = value;
        value = improved;
      }
      row[static_cast<std::size_t>(j)] = value;
    }
    x = row[kColumns - 1];
  }
  return x;
}

}  // namespace earthtop::testing
