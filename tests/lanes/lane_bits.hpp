// SPDX-License-Identifier: GPL-3.0-or-later
/// Trajectories integrated in lanes, as their bits, for exact comparison.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "earthtop/drift/drift_lanes.hpp"
#include "earthtop/integrate/motion_lanes.hpp"

namespace earthtop::testing {

class Bits {
 public:
  void add(double x) { bits_.push_back(std::bit_cast<std::uint64_t>(x)); }
  void add(const Vec3<double>& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const Quaternion<double>& q) { add(q.w), add(q.v); }
  void add(const StepCounters& counters) {
    for (const std::int64_t count : {counters.accepted, counters.rejected, counters.evaluations})
      bits_.push_back(static_cast<std::uint64_t>(count));
  }
  void add(RunStatus status) { bits_.push_back(static_cast<std::uint64_t>(status)); }
  const std::vector<std::uint64_t>& all() const { return bits_; }

 private:
  std::vector<std::uint64_t> bits_;
};

inline std::vector<std::uint64_t> bits_of(const MotionTrajectory<double>& trajectory) {
  Bits bits;
  bits.add(trajectory.status);
  bits.add(trajectory.counters);
  for (const MotionSample<double>& sample : trajectory.samples)
    bits.add(sample.t_s), bits.add(sample.q_LB), bits.add(sample.w_LB_B);
  return bits.all();
}

inline std::vector<std::uint64_t> bits_of(const DriftTrajectory<double>& trajectory) {
  Bits bits;
  bits.add(trajectory.status);
  bits.add(trajectory.counters);
  bits.add(trajectory.threshold ? trajectory.threshold->time_s().value_or(-1) : -1);
  for (const DriftSample<double>& sample : trajectory.samples) {
    const DriftState<double>& s = sample.state;
    bits.add(s.t_s), bits.add(s.q_LB), bits.add(s.w_LB_B), bits.add(s.ref_q_LB), bits.add(s.ref_w_LB_B);
    bits.add(s.e_w), bits.add(s.e_v_scaled);
    bits.add(sample.measures.axis), bits.add(sample.spin), bits.add(sample.azimuth);
  }
  return bits.all();
}

}  // namespace earthtop::testing
