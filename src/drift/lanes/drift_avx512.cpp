// SPDX-License-Identifier: GPL-3.0-or-later
#define EARTHTOP_LANE_WIDTH 8
#include "drift/lanes/drift_kernels.ipp"
#include "drift/lanes/general_drift_kernels.ipp"
#include "drift/lanes/recorded_drift_kernels.ipp"

EARTHTOP_DRIFT_KERNELS(avx512)
EARTHTOP_GENERAL_DRIFT_KERNELS(avx512)
EARTHTOP_RECORDED_DRIFT_KERNELS(avx512)
