// SPDX-License-Identifier: GPL-3.0-or-later
/// The kernels of a symmetric top's reference and deviation as quaternions (spherical_top_drift.hpp), and the constants that
/// they read.
#pragma once

#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// The rows of `Block::constants`. The last two are read in inertial axes only.
struct DriftConstants {
  enum : int {
    gravity,  ///< Gamma
    c,        ///< c, and below it what its rounding left out
    c_rest,
    j,
    epsilon,
    b,  ///< of the reference
    mu,
    W_scaled,                  ///< three rows
    last_term = W_scaled + 3,  ///< the highest order at which the series of gravity's change h counts
    kCount
  };
};
static_assert(DriftConstants::kCount <= kMostConstants);
/// The component groups of the coordinates q and delta; velocities are not in any.
constexpr Group kDriftGroups[] = {{0, 4, true}, {4, 4, false}};
/// Numbers of state variables: q, delta and their velocities; in inertial axes also the change h of gravity's direction.
inline constexpr int kLaboratoryDriftVariables = 16, kInertialDriftVariables = 19;

extern const Kernel kLaboratoryDrift_baseline, kInertialDrift_baseline;
extern const Kernel kLaboratoryDrift_avx2, kInertialDrift_avx2;
extern const Kernel kLaboratoryDrift_avx512, kInertialDrift_avx512;

}  // namespace earthtop::lanes
