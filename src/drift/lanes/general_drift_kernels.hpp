// SPDX-License-Identifier: GPL-3.0-or-later
/// The kernels of any body's reference and deviation in body axes, and what they read.
#pragma once

#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// Rows of `Block::constants`. Theta and its inverse as three numbers on the diagonal and three beside it (12, 13, 23); of the
/// inverse's diagonal the reciprocals: a division by a principal moment is exact where its inverse is rounded.
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
/// Of the state q_LB, w_IB_B; w, y, p.
constexpr Group kBodyDriftGroups[] = {{0, 4, true}, {4, 3, false}, {7, 1, true}, {8, 6, false}};
/// The same, and what the reference sees of W, g and h.
constexpr Group kInertialBodyDriftGroups[] = {{0, 4, true},   {4, 3, false},  {7, 1, true},  {8, 6, false},
                                              {14, 3, false}, {17, 3, false}, {20, 3, false}};
/// Numbers of the states: the laboratory's, and the inertial one with W, g and h as the reference sees them.
inline constexpr int kBodyDriftVariables = 14, kInertialBodyDriftVariables = 23;

extern const Kernel kBodyDrift_baseline, kInertialBodyDrift_baseline;
extern const Kernel kBodyDrift_avx2, kInertialBodyDrift_avx2;
extern const Kernel kBodyDrift_avx512, kInertialBodyDrift_avx512;

}  // namespace earthtop::lanes
