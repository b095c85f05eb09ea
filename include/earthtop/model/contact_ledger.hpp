// SPDX-License-Identifier: GPL-3.0-or-later
/// The torques about the centre O of the tip's sphere on a top that stands on a table, seen from the laboratory. O moves, so that
/// its acceleration acts on the body like a field; the normal force goes through O and exerts no torque:
///
///   dL'_O/dt = m r_c x (g - A_O) + tau_Cor(O) + tau_cent(O) + tau_gradient(O) - r z x F + M ,
///   L'_O = Theta_O w ,  A_O = a_O + 2 W x v_O + W x (W x p_O)
///
/// This is the form of the ledger of a driven pivot (ledger.hpp), with the table's force beside it.
#pragma once

#include "earthtop/model/general_contact.hpp"

namespace earthtop {

/// Torques about O in axes H.
template <class S>
struct ContactLedger {
  Vec3<S> gravity;      ///< m r_c x g
  Vec3<S> tip;          ///< -m r_c x A_O, with the weights of the Earth's torques
  Vec3<S> coriolis;     ///< weighed
  Vec3<S> centrifugal;  ///< weighed
  Vec3<S> gradient;
  Vec3<S> friction;  ///< -r z x F + M, and the air's torque about O
  Vec3<S> sum() const { return gravity + tip + coriolis + centrifugal + gradient + friction; }
};

/// Second moment about O, from that about C.
template <class S>
Mat3<S> second_moment_about_tip(const Contact<S>& c, const Mat3<S>& R_HB) {
  Mat3<S> about_O = turned_tensor(R_HB, c.S_BC_B);
  const Vec3<S> r_c = times(R_HB, c.p_OC_B);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) about_O(i, j) += c.mass * (r_c[i] * r_c[j]);
  return about_O;
}
/// L'_O = Theta_O w with Theta = tr S - S.
template <class S>
Vec3<S> momentum_about_tip(const Contact<S>& c, const Mat3<S>& R_HB, const Vec3<S>& w) {
  const Mat3<S> S_O = second_moment_about_tip(c, R_HB);
  return S(S_O(0, 0) + S_O(1, 1) + S_O(2, 2)) * w - times(S_O, w);
}

/// @param rates  of the state x, as found by general_contact.hpp
template <class S>
ContactLedger<S> contact_ledger(const Contact<S>& c, const ContactSurroundings<S>& around, const GeneralContactState<S>& x,
                                const GeneralContactRates<S>& rates) {
  const Vec3<S>&z = around.normal, &W = around.W;
  const Vec3<S> moment = c.mass * times(x.R_HB, c.p_OC_B);
  const Mat3<S> S_O = second_moment_about_tip(c, x.R_HB);
  const Vec3<S> a_O = rates.v_P + c.tip_radius * Vec3<S>(rates.w_dot.cross(z));
  const Vec3<S> of_earth = S(S(2) * c.weights.coriolis) * Vec3<S>(W.cross(rates.p_O)) +
                           c.weights.centrifugal * Vec3<S>(W.cross(Vec3<S>(W.cross(x.p_O))));
  ContactLedger<S> ledger;
  ledger.gravity = moment.cross(around.gravity);
  ledger.tip = -moment.cross(Vec3<S>(a_O + of_earth));
  ledger.coriolis = c.weights.coriolis * coriolis_torque(W, velocity_moment(S_O, rates.w));
  ledger.centrifugal = c.weights.centrifugal * centrifugal_torque(W, S_O);
  ledger.gradient = Vec3<S>(S(0), S(0), S(0));
  if (c.has_gradient)
    ledger.gradient = gradient_torque(around.gradient, S_O) + Vec3<S>(moment.cross(times(around.gradient, x.p_O)));
  ledger.friction = rates.reaction.moment - c.tip_radius * Vec3<S>(z.cross(rates.reaction.friction));
  if (c.air.pulls) {
    const Vec3<S> v_C = rates.p_O + Vec3<S>(rates.w.cross(times(x.R_HB, c.p_OC_B)));
    ledger.friction += moment.cross(air_acceleration(c, v_C));
  }
  if (c.air.turns) ledger.friction += times(x.R_HB, air_torque_B(c.air, transposed_times(x.R_HB, rates.w)));
  return ledger;
}

}  // namespace earthtop
