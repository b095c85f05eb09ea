// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/pivot/record_drift.ipp"

namespace earthtop {
EARTHTOP_RECORD(float80)
EARTHTOP_RECORD(float128)
}  // namespace earthtop
