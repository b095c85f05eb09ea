// SPDX-License-Identifier: GPL-3.0-or-later
#define EARTHTOP_LANE_WIDTH 2
#include "integrate/lanes/motion_kernels.ipp"

EARTHTOP_MOTION_KERNELS(baseline)
