// SPDX-License-Identifier: GPL-3.0-or-later
/// The kernels of drifts whose right-hand side is recorded, by the shapes of their states.
#pragma once

#include "integrate/lanes/block.hpp"

namespace earthtop::lanes {

/// As DrivenReducedShape, CompassShape, DriftShape (with the rotating motion composed, without and with a rotor) and GimbalShape have them.
constexpr Group kDrivenDriftGroups[] = {{0, 3, true},   {3, 3, false}, {6, 3, true},  {9, 1, false},
                                        {10, 1, false}, {11, 1, true}, {12, 7, false}};
constexpr Group kCompassDriftGroups[] = {{0, 2, true}, {2, 1, false}, {3, 1, false}, {4, 1, false},
                                         {5, 1, true}, {6, 2, false}, {8, 1, false}, {9, 1, false}};
constexpr Group kComposedDriftGroups[] = {{0, 4, true}, {4, 3, false}, {7, 1, true}, {8, 6, false}};
constexpr Group kGyrostatDriftGroups[] = {{0, 4, true},   {4, 3, false},  {7, 1, true},  {8, 7, false},
                                          {15, 1, false}, {16, 1, false}, {17, 1, false}};
constexpr Group kGimbalDriftGroups[] = {{0, 2, true}, {2, 3, false}, {5, 1, false}, {6, 5, false}, {11, 1, false}};
inline constexpr int kDrivenDriftVariables = 19, kCompassDriftVariables = 10, kComposedDriftVariables = 14,
                     kGyrostatDriftVariables = 18, kGimbalDriftVariables = 12;

extern const Kernel kDrivenDrift_baseline, kCompassDrift_baseline, kComposedDrift_baseline, kGyrostatDrift_baseline,
    kGimbalDrift_baseline;
extern const Kernel kDrivenDrift_avx2, kCompassDrift_avx2, kComposedDrift_avx2, kGyrostatDrift_avx2, kGimbalDrift_avx2;
extern const Kernel kDrivenDrift_avx512, kCompassDrift_avx512, kComposedDrift_avx512, kGyrostatDrift_avx512,
    kGimbalDrift_avx512;

}  // namespace earthtop::lanes
