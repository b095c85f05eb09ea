// SPDX-License-Identifier: GPL-3.0-or-later
/// The series of reduced_motion_series.hpp, for points side by side.
#pragma once

#include "integrate/lanes/kernel.ipp"
#include "integrate/lanes/motion_kernels.hpp"

namespace earthtop::lanes {
namespace {

template <bool kAttitude>
class MotionSeries {
 public:
  static constexpr int kCoordinates = 0;
  static constexpr int kVariables = kAttitude ? 9 : 6;
  static constexpr int kGroupCount = kAttitude ? 3 : 2;
  static constexpr const Group* kGroups = kMotionGroups;

 private:
  static constexpr int kN = 0, kU = 3, kA = 6, kAcross = 9;  // n, u, a, and u without its part along n

 public:
  static constexpr int kStored = kAttitude ? kAcross + 3 : kVariables;

  EARTHTOP_LANE_INLINE MotionSeries(const Row* constants, int chunk)
      : b_(load(constants[MotionConstants::b], chunk)),
        b_rest_(load(constants[MotionConstants::b_rest], chunk)),
        moment_ratio_(load(constants[MotionConstants::moment_ratio], chunk)),
        gravity_(load(constants[MotionConstants::gravity], chunk)),
        W_{load(constants[MotionConstants::W], chunk), load(constants[MotionConstants::W + 1], chunk),
           load(constants[MotionConstants::W + 2], chunk)} {}

  EARTHTOP_LANE_INLINE void start(const Coefficients<kStored>& c) {
    const Vec n = c.vector(0, kN);
    moment_ = moment_ratio_ * (spread(3.0) - dot(n, n)) / spread(2.0) * gravity_;
    along_ = dot(c.vector(0, kU), n);
  }

  EARTHTOP_LANE_INLINE void extend(const Coefficients<kStored>& c, int k) const {
    const Vec n = c.vector(k, kN), u = c.vector(k, kU);
    const Pack factor = spread(1.0 / (k + 1));
    const Vec s = c.cross(k, kU, kN);
    c.put(k + 1, kN, factor * (s - cross(W_, n)));
    const Vec Wu = cross(W_, u);
    // n x g for a gravity along the vertical
    c.put(k + 1, kU,
          factor * Vec{moment_ * n.y - b_ * s.x - (b_rest_ * s.x + Wu.x), -moment_ * n.x - b_ * s.y - (b_rest_ * s.y + Wu.y),
                       -b_ * s.z - (b_rest_ * s.z + Wu.z)});
    if constexpr (kAttitude) {
      c.put(k, kAcross, u - along_ * n);
      c.put(k + 1, kA, factor * (c.cross(k, kAcross, kA) - cross(W_, c.vector(k, kA))));
    }
  }

 private:
  Pack b_, b_rest_, moment_ratio_, gravity_;
  Vec W_;
  Pack moment_{}, along_{};
};

}  // namespace
}  // namespace earthtop::lanes

#define EARTHTOP_MOTION_KERNELS(set)                                                                      \
  namespace earthtop::lanes {                                                                             \
  const Kernel kAxisMotion_##set{step_block<MotionSeries<false>>, evaluate_block<MotionSeries<false>>};   \
  const Kernel kAttitudeMotion_##set{step_block<MotionSeries<true>>, evaluate_block<MotionSeries<true>>}; \
  }
