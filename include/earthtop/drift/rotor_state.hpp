// SPDX-License-Identifier: GPL-3.0-or-later
/// The rotor of a gyrostat in both motions (model/rotor.hpp).
#pragma once

#include "earthtop/vectors.hpp"

namespace earthtop {

/// How far a body axis has drifted: the angle (rad) between its directions in the two motions, and the rotating one minus that of the
/// reference over epsilon, in laboratory axes.
template <class T>
struct AxisDrift {
  T angle = T(0);
  Vec3<T> difference_L_scaled = Vec3<T>::Zero();
};

/// Rates (rad/s) and angles (rad, since the release) of the rotor relative to the body. Differences are those of the rotating motion
/// minus the reference, over epsilon of the drift state.
template <class T>
struct RotorState {
  T rate = T(0), ref_rate = T(0), rate_difference_scaled = T(0);
  T angle = T(0), ref_angle = T(0), angle_difference_scaled = T(0);
  Vec3<T> axis_B = Vec3<T>::UnitZ();  ///< the rotor's axis, the same in both
  AxisDrift<T> axis = {};             ///< its drift
};

}  // namespace earthtop
