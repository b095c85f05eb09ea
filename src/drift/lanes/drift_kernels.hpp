// SPDX-License-Identifier: GPL-3.0-or-later
/// The kernels of a symmetric top's reference and deviation without its spin, and what they read.
#pragma once

#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// Rows of `Block::constants`; of the reference b and its rest, of the deviation k and the factors of `ReducedDriftConstants`.
struct DriftConstants {
  enum : int { b, b_rest, k, of_axis_rate, of_cross, moment_ratio, gravity, epsilon, W_scaled, kCount = W_scaled + 3 };
};
static_assert(DriftConstants::kCount <= kMostConstants);
/// Of the state n, u, a, w, y, V; what the inertial one has beyond is measured nowhere.
constexpr Group kDriftGroups[] = {{0, 3, true}, {3, 3, false}, {6, 3, true}, {9, 1, true}, {10, 6, false}};
/// Numbers of the states: the laboratory's, and the inertial one with gravity's turn h.
inline constexpr int kLaboratoryDriftVariables = 16, kInertialDriftVariables = 19;

extern const Kernel kLaboratoryDrift_baseline, kInertialDrift_baseline;
extern const Kernel kLaboratoryDrift_avx2, kInertialDrift_avx2;
extern const Kernel kLaboratoryDrift_avx512, kInertialDrift_avx512;

}  // namespace earthtop::lanes
