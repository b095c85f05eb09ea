// SPDX-License-Identifier: GPL-3.0-or-later
/// The kernels of a symmetric top's motion without its spin, in laboratory axes, and the constants that they read.
#pragma once

#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// The rows of `Block::constants`.
struct MotionConstants {
  enum : int { b, b_rest, moment_ratio, gravity, W, kCount = W + 3 };
};
/// The component groups of the state n, u and, where the attitude is sought, a.
constexpr Group kMotionGroups[] = {{0, 3, true}, {3, 3, false}, {6, 3, true}};

/// The kernels for each instruction set: of the axis alone (6 variables), and of the attitude (9).
extern const Kernel kAxisMotion_baseline, kAttitudeMotion_baseline;
extern const Kernel kAxisMotion_avx2, kAttitudeMotion_avx2;
extern const Kernel kAxisMotion_avx512, kAttitudeMotion_avx512;

}  // namespace earthtop::lanes
