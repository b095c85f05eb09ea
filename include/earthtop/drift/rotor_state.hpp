// SPDX-License-Identifier: GPL-3.0-or-later
/// The rotor of a gyrostat in both motions (model/rotor.hpp).
#pragma once

#include "earthtop/vectors.hpp"

namespace earthtop {

/// Rates (rad/s) and angles (rad, since the release) of the rotor relative to the body. Differences are those of the rotating motion
/// minus the reference, over epsilon of the drift state.
template <class T>
struct RotorState {
  T rate = T(0), ref_rate = T(0), rate_difference_scaled = T(0);
  T angle = T(0), ref_angle = T(0), angle_difference_scaled = T(0);
  Vec3<T> axis_B = Vec3<T>::UnitZ();  ///< the rotor's axis, the same in both
};

}  // namespace earthtop
