// SPDX-License-Identifier: GPL-3.0-or-later
/// A separate integrator for independent checks in 113 bits: Gragg's modified midpoint rule with Bulirsch and Stoer's
/// extrapolation to step 0 (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, section II.9), with fixed step
/// and order.
#pragma once

#include <array>

namespace earthtop::test {

/// One step of size h from y at order 2 * kColumns; `State` has operator+(State, State) and operator*(Scalar, State).
/// @param rate  dy/dt as a function of y
template <class Scalar, class State, class Rate, int kColumns = 14>
State extrapolated_step(const Rate& rate, const State& y, Scalar h) {
  std::array<State, kColumns> row;  // the last row of the tableau, rebuilt in place
  for (int k = 0; k < kColumns; ++k) {
    const int substeps = 2 * (k + 1);
    const Scalar part = h / Scalar(substeps);
    State before = y, now = y + part * rate(y);
    for (int i = 1; i < substeps; ++i) {
      const State next = before + (Scalar(2) * part) * rate(now);
      before = now;
      now = next;
    }
    State entry = now;
    for (int j = 1; j <= k; ++j) {
      const Scalar ratio = Scalar(k + 1) / Scalar(k + 1 - j);
      const State higher = entry + (Scalar(1) / (ratio * ratio - Scalar(1))) * (entry + Scalar(-1) * row[j - 1]);
      row[j - 1] = entry;
      entry = higher;
    }
    row[k] = entry;
  }
  return row[kColumns - 1];
}

}  // namespace earthtop::test
