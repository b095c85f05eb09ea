// SPDX-License-Identifier: GPL-3.0-or-later
/// A change of the inputs of a motion on a table. In place of the Earth's rotation it makes the two motions of a pair differ: with
/// epsilon = 0 in the model the differences of a drift integration are then the derivatives of the non-rotating prediction along
/// the change, to first order and without a step of differences.
#pragma once

#include "earthtop/model/contact.hpp"

namespace earthtop {

/// The change per unit of the input, in the model's units.
template <class T>
struct ContactChange {
  T viscosity = T(0), coefficient = T(0), patch_radius = T(0);
  T spinning_length = T(0), rolling_length = T(0);
  Vec3<T> gravity_H = Vec3<T>(T(0), T(0), T(0));
  EARTHTOP_MEMBERS(viscosity, coefficient, patch_radius, spinning_length, rolling_length, gravity_H)

  void apply(Contact<Paired<T>>& pairs) const {
    pairs.viscosity.diff = viscosity, pairs.coefficient.diff = coefficient, pairs.patch_radius.diff = patch_radius;
    pairs.spinning_length.diff = spinning_length, pairs.rolling_length.diff = rolling_length;
  }
};

/// The change of gravity, in the table's axes, per radian by which the table is tilted further toward a compass direction. The
/// top is released at the same angles to the table.
/// @param gravity_H  in the table's axes, which are L's turned about a horizontal axis with this azimuth, or by nothing
template <class T>
ContactChange<T> table_tilt_change(const Vec3<T>& gravity_H, const SinCos<T>& azimuth) {
  const Vec3<T> axis(-azimuth.cos, azimuth.sin, T(0));
  ContactChange<T> change;
  change.gravity_H = gravity_H.cross(axis);
  return change;
}

/// The model of the non-rotating prediction in which only a change makes two motions differ.
template <class T>
Model<T> model_for_change(const Model<T>& model) {
  Model<T> made = model;
  made.epsilon = T(0);
  made.W_IL_L = made.W_IL_L_scaled = Vec3<T>::Zero();
  return made;
}

}  // namespace earthtop
