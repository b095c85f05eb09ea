// SPDX-License-Identifier: GPL-3.0-or-later
/// The distance of a computed motion from the reference, without subtracting angles.
#pragma once

#include <algorithm>
#include <vector>

#include "earthtop/bench/bench.hpp"

namespace earthtop {

template <class T>
Checkpoint checkpoint_of(const MotionSample<T>& sample) {
  return {{float128(sample.q_LB.w), sample.q_LB.v.template cast<float128>()}, std::nullopt};
}
template <class T>
Checkpoint checkpoint_of(const DriftSample<T>& sample) {
  return {{float128(sample.state.q_LB.w), sample.state.q_LB.v.template cast<float128>()}, float128(sample.measures.axis)};
}

/// The checkpoint of a motion, with the angle between its axis and that of another motion.
inline Checkpoint subtracted(const Quaternion<float128>& q_LB, const Quaternion<float128>& other_q_LB) {
  const Quaternion<float128> e = other_q_LB.conjugate() * q_LB;
  return {q_LB, 2 * real::atan2(real::hypot(e.v[0], e.v[1]), real::hypot(e.w, e.v[2]))};
}

/// The largest errors of checkpoints relative to those of a reference.   @param attitude  whether the attitude was computed
inline BenchErrors largest_errors(const std::vector<Checkpoint>& computed, const std::vector<Checkpoint>& reference,
                                  bool attitude) {
  BenchErrors errors;
  if (attitude) errors.attitude = 0;
  for (std::size_t i = 0; i < computed.size(); ++i) {
    const Quaternion<float128> d = computed[i].q_LB.conjugate() * reference[i].q_LB;
    const auto angle = [](float128 sine, float128 cosine) { return static_cast<double>(2 * real::atan2(sine, cosine)); };
    errors.axis = std::max(errors.axis, angle(real::hypot(d.v[0], d.v[1]), real::hypot(d.w, d.v[2])));
    if (attitude) errors.attitude = std::max(*errors.attitude, angle(norm(d.v), real::abs(d.w)));
    if (computed[i].drift_axis && reference[i].drift_axis) {
      const float128 off = *computed[i].drift_axis - *reference[i].drift_axis;
      errors.drift = std::max(errors.drift.value_or(0), static_cast<double>(real::abs(off)));
    }
  }
  return errors;
}

}  // namespace earthtop
