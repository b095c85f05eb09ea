// SPDX-License-Identifier: GPL-3.0-or-later
/// What a platform asks of those who follow it.
#pragma once

#include "earthtop/model/platform_spec.hpp"

namespace earthtop {

/// How fast a platform turns, and how it accelerates the pivot, at most.
struct PlatformDemand {
  double rate_rad_s = 0;
  double acceleration_m_s2 = 0;
};

PlatformDemand demand_of(const PlatformSpec& platform, double duration_s, double earth_rate_rad_s);

}  // namespace earthtop
