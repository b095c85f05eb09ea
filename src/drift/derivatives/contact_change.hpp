// SPDX-License-Identifier: GPL-3.0-or-later
/// A change of the inputs of the non-rotating prediction on a table, along which its derivatives are wanted.
#pragma once

#include <tuple>

#include "earthtop/model/contact.hpp"
#include "earthtop/model/model.hpp"

namespace earthtop {

/// The change per unit of the input, in the model's units.
template <class T>
struct ContactChange {
  T viscosity = T(0), coefficient = T(0), patch_radius = T(0);
  T spinning_length = T(0), rolling_length = T(0);
  Vec3<T> gravity_H = Vec3<T>(T(0), T(0), T(0));
  EARTHTOP_MEMBERS(viscosity, coefficient, patch_radius, spinning_length, rolling_length, gravity_H)

  /// What is changed, in the same order.   @param model  in the table's axes
  template <class S>
  static auto changed(Contact<S>& contact, Model<S>& model) {
    return std::tie(contact.viscosity, contact.coefficient, contact.patch_radius, contact.spinning_length,
                    contact.rolling_length, model.apparent_gravity_L);
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

}  // namespace earthtop
