// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a trend of the azimuth drift means something.
#pragma once

#include <algorithm>
#include <cmath>

#include "earthtop/real.hpp"

namespace earthtop {

/// Whether the compass azimuths of two axes tell where these stand to each other: neither is nearer to the vertical than the
/// two are apart. Nearer to it an azimuth goes round by up to half a turn while the axes hardly move.
/// @param axis_L, ref_axis_L  unit vectors (East, North, Up)   @param apart_rad  angle between them
template <class Vector>
bool azimuths_tell(const Vector& axis_L, const Vector& ref_axis_L, double apart_rad) {
  return std::min(real::hypot(axis_L[0], axis_L[1]), real::hypot(ref_axis_L[0], ref_axis_L[1])) >= apart_rad;
}

}  // namespace earthtop
