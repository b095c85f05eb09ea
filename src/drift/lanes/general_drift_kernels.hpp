// SPDX-License-Identifier: GPL-3.0-or-later
/// The kernels of any body's reference and deviation in body axes, and the constants that they read.
#pragma once

#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// The rows of `Block::constants`. Theta and its inverse are given by three elements on the diagonal and three beside it (12,
/// 13, 23). For the diagonal of the inverse, the reciprocals are given: the inverse of a principal moment would be rounded,
/// while the moment to divide by is exact.
struct GeneralDriftConstants {
  enum : int {
    inertia,
    inertia_beside = inertia + 3,
    inverse_reciprocal = inertia_beside + 3,
    inverse_beside = inverse_reciprocal + 3,
    mass_moment = inverse_beside + 3,
    gravity = mass_moment + 3,
    epsilon,
    W_scaled,
    kCount = W_scaled + 3
  };
};
static_assert(GeneralDriftConstants::kCount <= kMostConstants);
/// The component groups of the state q_LB, w_IB_B; w, y, p.
constexpr Group kBodyDriftGroups[] = {{0, 4, true}, {4, 3, false}, {7, 1, true}, {8, 6, false}};
/// The same groups, then W, g and h as seen from the reference body.
constexpr Group kInertialBodyDriftGroups[] = {{0, 4, true},   {4, 3, false},  {7, 1, true},  {8, 6, false},
                                              {14, 3, false}, {17, 3, false}, {20, 3, false}};
/// Numbers of state variables: for the deviation seen from the laboratory, and for that seen from inertial space, where W, g
/// and h as seen from the reference body are added.
inline constexpr int kBodyDriftVariables = 14, kInertialBodyDriftVariables = 23;

extern const Kernel kBodyDrift_baseline, kInertialBodyDrift_baseline;
extern const Kernel kBodyDrift_avx2, kInertialBodyDrift_avx2;
extern const Kernel kBodyDrift_avx512, kInertialBodyDrift_avx512;

}  // namespace earthtop::lanes
