// SPDX-License-Identifier: GPL-3.0-or-later
/// The kernels of a symmetric top's reference and deviation without its spin, and the constants that they read.
#pragma once

#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// The rows of `Block::constants`. b and its rest belong to the reference; k, axis_rate_factor and cross_factor to the deviation, see
/// `ReducedDriftConstants`.
struct DriftConstants {
  enum : int { b, b_rest, k, axis_rate_factor, cross_factor, moment_ratio, gravity, epsilon, W_scaled, kCount = W_scaled + 3 };
};
static_assert(DriftConstants::kCount <= kMostConstants);
/// The component groups of the state n, u, a, w, y, V. The inertial state has further variables, which no group measures.
constexpr Group kDriftGroups[] = {{0, 3, true}, {3, 3, false}, {6, 3, true}, {9, 1, true}, {10, 6, false}};
/// Numbers of state variables: in laboratory axes, and in inertial axes, where the change h of gravity is added.
inline constexpr int kLaboratoryDriftVariables = 16, kInertialDriftVariables = 19;

extern const Kernel kLaboratoryDrift_baseline, kInertialDrift_baseline;
extern const Kernel kLaboratoryDrift_avx2, kInertialDrift_avx2;
extern const Kernel kLaboratoryDrift_avx512, kInertialDrift_avx512;

}  // namespace earthtop::lanes
