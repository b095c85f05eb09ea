// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a drift state (drift_integration.hpp) of a top on a table besides attitudes and rates.
#pragma once

#include <array>
#include <optional>

#include "earthtop/model/contact_forces.hpp"

namespace earthtop {

/// Integrals over one motion since its release, in the model's natural units.
template <class T>
struct ContactIntegrals {
  T work = T(0);                      ///< of friction's force and moment
  std::optional<T> jellett_change{};  ///< of r L_C.(W x z) + M.rho; only in the form for symmetric bodies
};

/// Both motions on the table and their differences over epsilon, in the model's natural units.
template <class T>
struct ContactDriftState {
  Vec3<Paired<T>> axis_L;  ///< body axis 3
  Vec3<Paired<T>> tip_L;   ///< centre of the tip's sphere, minus its radius along the table's normal: the contact point
  Vec3<Paired<T>> slip_L;
  Paired<T> slip;                       ///< its size
  Paired<T> spin;                       ///< inertial rate about axis 3
  Paired<T> relative_spin;              ///< rate about axis 3 relative to the laboratory
  Paired<T> turning;                    ///< rate about the table's normal relative to the laboratory
  ContactReaction<Paired<T>> reaction;  ///< vectors in L
  /// Those of the reference, then those of the rotating motion; none where the integration was in inertial axes.
  std::optional<std::array<ContactIntegrals<T>, 2>> integrals{};
};

}  // namespace earthtop
