// SPDX-License-Identifier: GPL-3.0-or-later
/// Decides where a trend of the azimuth drift is meaningful.
#pragma once

#include <algorithm>
#include <cmath>

#include "earthtop/real.hpp"

namespace earthtop {

/// Whether the compass azimuths of two axes describe how the axes stand to each other: both axes are at least as far from the
/// vertical as they are from each other. Closer to the vertical, an azimuth can change by up to half a turn while the axis
/// hardly moves.
/// @param axis_L, ref_axis_L  unit vectors (East, North, Up)   @param apart_rad  angle between them
template <class Vector>
bool azimuths_are_meaningful(const Vector& axis_L, const Vector& ref_axis_L, double apart_rad) {
  return std::min(real::hypot(axis_L[0], axis_L[1]), real::hypot(ref_axis_L[0], ref_axis_L[1])) >= apart_rad;
}

}  // namespace earthtop
