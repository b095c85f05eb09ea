// SPDX-License-Identifier: GPL-3.0-or-later
/// The change that a given torque may make to a spin within a motion.
#pragma once

#include "earthtop/model/applied_torques.hpp"

namespace earthtop {

/// Whether a given torque changes the spin by half of itself at most, so that friction with a corner does not come to it. Of a table
/// nothing is known beforehand.
template <class T>
bool given_torque_keeps_spin(const GivenTorque<T>& given, T I3, T w3, T duration) {
  constexpr double kMost = 0.5;
  if (!given.acts) return true;
  return !given.table && real::hypot(given.x, given.y, given.z) * duration <= T(kMost) * I3 * real::abs(w3);
}

}  // namespace earthtop
