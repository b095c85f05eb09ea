// SPDX-License-Identifier: GPL-3.0-or-later
/// The wider scalar type in which a closed form computes its constants and its phases.
#pragma once

#include "earthtop/frames/rotation.hpp"

namespace earthtop {

namespace detail {
template <class T>
struct WiderScalar {
  using type = float128;
};
template <>
struct WiderScalar<double> {
  using type = float80;
};
}  // namespace detail

/// double -> float80 -> float128 -> float128. A phase of 1e9 rad computed in it keeps every digit of T, and squares of the
/// largest and the smallest doubles neither overflow nor underflow.
template <class T>
using Wider = typename detail::WiderScalar<T>::type;

template <class To, class From>
Vec3<To> converted(const Vec3<From>& v) {
  return {static_cast<To>(v[0]), static_cast<To>(v[1]), static_cast<To>(v[2])};
}
template <class To, class From>
Quaternion<To> converted(const Quaternion<From>& q) {
  return {static_cast<To>(q.w), converted<To>(q.v)};
}

/// A phase minus the nearest multiple of its period; `odd` tells whether that multiple is odd.
template <class W>
struct ReducedPhase {
  W phase;
  bool odd;
};
template <class W>
ReducedPhase<W> reduced_phase(W phase, W period) {
  const W turns = real::rint(phase / period);
  if (turns == W(0)) return {phase, false};  // also for an infinite period
  return {phase - turns * period, real::rint(turns / W(2)) != turns / W(2)};
}

}  // namespace earthtop
