// SPDX-License-Identifier: GPL-3.0-or-later
/// The rates of two balances of a top on a table: of the Jacobi integral, by the power of friction, and of Jellett's lambda
/// (contact_invariants.hpp). They are integrated as states of their own along both motions, so that the balances are known to the
/// integration's error. The integrals belong to each motion by itself: no difference of the two is taken.
#pragma once

#include "drift/table/contact_pairs.hpp"
#include "earthtop/model/reduced_contact.hpp"

namespace earthtop {

/// One motion's part of a pair of vectors.
template <class T>
Vec3<T> motion_of(const Vec3<Paired<T>>& pairs, T Paired<T>::*motion) {
  return {pairs[0].*motion, pairs[1].*motion, pairs[2].*motion};
}

template <class T>
bool has_moment(const Contact<T>& contact) {
  return contact.law == ContactLaw::contensou || contact.has_spinning_friction || contact.has_rolling_resistance;
}

/// The power of friction F.v_P + M.w of one motion. What a law does not have is not computed: in a recording it would be an
/// operation on zeros.
/// @param w  rate relative to the laboratory
template <class T>
T friction_power(const Contact<T>& contact, const ContactReaction<Paired<T>>& reaction, const Vec3<Paired<T>>& v_P,
                 const Vec3<Paired<T>>& w, T Paired<T>::*motion) {
  T power = T(0);
  if (contact.law != ContactLaw::rolling && contact.law != ContactLaw::frictionless)
    power = inner(motion_of(reaction.friction, motion), motion_of(v_P, motion));
  if (has_moment(contact)) power = power + inner(motion_of(reaction.moment, motion), motion_of(w, motion));
  return power;
}

/// The power of the air.   @param torque  of the air about C   @param v_C  velocity of the centre of mass relative to the
/// laboratory
template <class T>
T air_power(const Contact<Paired<T>>& contact, const Vec3<Paired<T>>& torque, const Vec3<Paired<T>>& w,
            const Vec3<Paired<T>>& v_C, T Paired<T>::*motion) {
  T power = T(0);
  if (contact.air.turns) power = inner(motion_of(torque, motion), motion_of(w, motion));
  if (contact.air.pulls)
    power = power + (contact.mass.*motion) * inner(motion_of(air_acceleration(contact, v_C), motion), motion_of(v_C, motion));
  return power;
}

/// r L_C.(W x z) + M.rho of one motion of a symmetric body.
template <class T>
T jellett_power(const Contact<T>& contact, const ContactReaction<Paired<T>>& reaction,
                const ContactSurroundings<Paired<T>>& around, const ReducedContactState<Paired<T>>& x, T Paired<T>::*motion) {
  const Vec3<T> n = motion_of(x.n, motion), z = motion_of(around.normal, motion), W = motion_of(around.W, motion);
  const Vec3<T> L_C = contact.I1 * motion_of(x.u, motion) + T(contact.I3 * (x.w3.*motion)) * n;
  T power = contact.tip_radius * inner(L_C, Vec3<T>(W.cross(z)));
  if (has_moment(contact))
    power = power + inner(motion_of(reaction.moment, motion), Vec3<T>(contact.tip_radius * z + contact.height_of_center * n));
  return power;
}

}  // namespace earthtop
