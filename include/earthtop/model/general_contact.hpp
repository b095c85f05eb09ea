// SPDX-License-Identifier: GPL-3.0-or-later
/// Equations of any body on a table, in the table's axes H, with [F]'s torques about the centre of mass C from their tensors
/// (torques.hpp). Variables: the attitude R_HB, L' = Theta_C w with the rate w relative to the laboratory, the slip velocity v_P
/// and the position p_O of the centre of the tip's sphere. With s = -(r z + r_c) from C to the contact point:
///
///   dL'/dt = tau_Cor + tau_cent + s x (N z + F) + M ,  w' = w0 + N w1 ,
///   w0 = Theta^-1 (tau_Cor + tau_cent + s x F0 - w x Theta w) ,  w1 = Theta^-1 (s x (z + phi) + mh) ,
///   N = [-z.(g + f/m) + z.(w0 x r_c + w x (w x r_c))] / [1/m - z.(w1 x r_c)] ,
///   a_O = g + (f + N z + F)/m - w' x r_c - w x (w x r_c) ,  dv_P/dt = a_O - r w' x z ,  dp_O/dt = v_P + r w x z
///
/// Rolling: v_P = 0; with rho = -s and acc = w x (w x r_c) - g - f/m,
///   (Theta + m (rho^2 1 - rho rho^T)) w' = -w x Theta w + tau_Cor + tau_cent - m rho x acc + M ,  N z + F = m (w' x rho + acc)
#pragma once

#include "earthtop/model/contact_forces.hpp"

namespace earthtop {

template <class S>
struct GeneralContactState {
  Mat3<S> R_HB;
  Vec3<S> momentum;  ///< L' = Theta_C w
  Vec3<S> v_P, p_O;
};
/// The time derivatives in axes H; that of the attitude is its rate.
template <class S>
struct GeneralContactRates {
  Vec3<S> w;      ///< rate relative to the laboratory
  Vec3<S> w_dot;  ///< its derivative
  Vec3<S> momentum;
  Vec3<S> v_P, p_O;
  ContactReaction<S> reaction;
};

namespace general_contact {

/// The quantities that follow from a state without the table's forces.
template <class S>
struct Kinematics {
  Mat3<S> I, I_inverse;
  Vec3<S> w, r_c, s, v_O, field, torque, centripetal;
};
template <class S>
Kinematics<S> kinematics(const Contact<S>& c, const ContactSurroundings<S>& around, const GeneralContactState<S>& x) {
  Kinematics<S> k;
  k.I = turned_tensor(x.R_HB, c.I_BC_B), k.I_inverse = turned_tensor(x.R_HB, c.I_BC_B_inverse);
  k.w = times(k.I_inverse, x.momentum);
  k.r_c = times(x.R_HB, c.p_OC_B);
  k.s = -(c.tip_radius * around.normal + k.r_c);
  k.v_O = x.v_P + c.tip_radius * Vec3<S>(k.w.cross(around.normal));
  const Vec3<S> wr = k.w.cross(k.r_c);
  k.centripetal = k.w.cross(wr);
  k.field = field_beside_gravity(c, around, Vec3<S>(x.p_O + k.r_c), Vec3<S>(k.v_O + wr));
  const Mat3<S> S_BC = turned_tensor(x.R_HB, c.S_BC_B);
  k.torque = c.weights.coriolis * coriolis_torque(around.W, velocity_moment(S_BC, k.w)) +
             c.weights.centrifugal * centrifugal_torque(around.W, S_BC);
  if (c.has_gradient) k.torque += gradient_torque(around.gradient, S_BC);
  if (c.air.pulls) k.field += air_acceleration(c, Vec3<S>(k.v_O + wr));
  if (c.air.turns) k.torque += times(x.R_HB, air_torque_B(c.air, transposed_times(x.R_HB, k.w)));
  return k;
}

}  // namespace general_contact

/// The time derivatives under a law of sliding friction.
template <class S>
GeneralContactRates<S> general_sliding(const Contact<S>& c, const ContactSurroundings<S>& around,
                                       const GeneralContactState<S>& x) {
  const auto k = general_contact::kinematics(c, around, x);
  const Vec3<S>& z = around.normal;
  const Friction<S> f = friction(c, x.v_P, k.w, z);
  const Vec3<S> torque_0 = k.torque + Vec3<S>(k.s.cross(f.force));
  const Vec3<S> torque_1 = Vec3<S>(k.s.cross(Vec3<S>(z + f.force_per_normal))) + f.moment_per_normal;
  const Vec3<S> w0 = times<S>(k.I_inverse, torque_0 - Vec3<S>(k.w.cross(x.momentum))), w1 = times(k.I_inverse, torque_1);
  const Vec3<S> acceleration = around.gravity + k.field;
  const S denominator = S(1) - c.mass * inner(z, Vec3<S>(w1.cross(k.r_c)));
  const S N = c.mass * inner(z, Vec3<S>(Vec3<S>(w0.cross(k.r_c)) + k.centripetal - acceleration)) / denominator;

  GeneralContactRates<S> rates;
  rates.w = k.w;
  rates.w_dot = w0 + N * w1;
  rates.momentum = torque_0 + N * torque_1;
  rates.p_O = k.v_O;
  rates.reaction = {N, denominator, Vec3<S>(N * f.force_per_normal + f.force), Vec3<S>(N * f.moment_per_normal)};
  const Vec3<S> a_O =
      acceleration + S(S(1) / c.mass) * rates.reaction.friction - Vec3<S>(rates.w_dot.cross(k.r_c)) - k.centripetal;
  rates.v_P = in_table_plane(Vec3<S>(a_O - c.tip_radius * Vec3<S>(rates.w_dot.cross(z))), z);
  return rates;
}

/// The time derivatives without slip; `v_P` of the state is taken to be 0 and stays so.
template <class S>
GeneralContactRates<S> general_rolling(const Contact<S>& c, const ContactSurroundings<S>& around, GeneralContactState<S> x) {
  x.v_P = Vec3<S>(S(0), S(0), S(0));
  const auto k = general_contact::kinematics(c, around, x);
  const Vec3<S>& z = around.normal;
  const Vec3<S> rho = -k.s, acc = k.centripetal - around.gravity - k.field;
  const S square = inner(rho, rho);
  Mat3<S> A = k.I;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A(i, j) += c.mass * ((i == j ? square : S(0)) - rho[i] * rho[j]);

  GeneralContactRates<S> rates;
  rates.w = k.w;
  rates.w_dot = solved(A, Vec3<S>(k.torque - Vec3<S>(k.w.cross(x.momentum)) - c.mass * Vec3<S>(rho.cross(acc))));
  S N = c.mass * inner(z, Vec3<S>(Vec3<S>(rates.w_dot.cross(rho)) + acc)), denominator = S(1);
  Vec3<S> moment(S(0), S(0), S(0));
  if (c.has_spinning_friction || c.has_rolling_resistance) {
    const Vec3<S> per_normal = friction(c, x.v_P, k.w, z).moment_per_normal;
    const Vec3<S> w_dot_1 = solved(A, per_normal);
    denominator = S(1) - c.mass * inner(z, Vec3<S>(w_dot_1.cross(rho)));
    N = N / denominator;
    rates.w_dot += N * w_dot_1;
    moment = N * per_normal;
  }
  const Vec3<S> force = c.mass * Vec3<S>(Vec3<S>(rates.w_dot.cross(rho)) + acc);
  rates.momentum = k.torque + Vec3<S>(k.s.cross(force)) + moment;
  rates.v_P = x.v_P;
  rates.p_O = k.v_O;
  rates.reaction = {N, denominator, in_table_plane(force, z), moment};
  return rates;
}

template <class S>
GeneralContactRates<S> general_rates(const Contact<S>& c, const ContactSurroundings<S>& around,
                                     const GeneralContactState<S>& x) {
  return c.law == ContactLaw::rolling ? general_rolling(c, around, x) : general_sliding(c, around, x);
}

}  // namespace earthtop
