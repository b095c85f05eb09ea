// SPDX-License-Identifier: GPL-3.0-or-later
/// Equations of any body on a table, in axes N that do not turn and whose origin rides with the laboratory's. No Coriolis or
/// centrifugal term appears in them; the table's normal z, gravity and the constraint turn instead. With X_C the position of the
/// centre of mass, V_C its velocity in N, r_c = p_OC, s = -(r z + r_c), X_P = X_C + s and w_IB the inertial rate:
///
///   m dV_C/dt = m g + N z + F ,  dL_C/dt = s x (N z + F) + M ,  dz/dt = W x z ,
///   slip v_P = V_C + w_IB x s - W x X_P ,  constraint z.X_O = r with X_O = X_C - r_c, differentiated twice
///
/// Rolling: the derivative of the slip is 0, three equations for the three components of the table's force.
#pragma once

#include "earthtop/model/contact_forces.hpp"

namespace earthtop {

/// The state in axes N. The slip is a variable, rather than V_C: near rolling it is the small difference of two velocities.
template <class S>
struct InertialContactState {
  Vec3<S> X_C, v_P;
  Vec3<S> w_IB;
};
/// The body as its attitude leaves it, in axes N.
template <class S>
struct InertialContactBody {
  Vec3<S> r_c;        ///< from O to C
  Mat3<S> I_inverse;  ///< of the inertia about C
  Vec3<S> L_C;        ///< inertial angular momentum about C
  Mat3<S> S_BC;       ///< second moment about C; read only where the gradient acts or torques are left out
};
template <class S>
struct InertialContactRates {
  Vec3<S> X_C;  ///< V_C
  Vec3<S> v_P;
  Vec3<S> w_IB;
  Vec3<S> momentum;  ///< dL_C/dt
  ContactReaction<S> reaction;
};

namespace inertial_contact {

template <class S>
struct Kinematics {
  Vec3<S> s, s_dot, V_C, r_c_dot, z_dot, acceleration;
  Vec3<S> torque, gyroscopic;  ///< about C: of others than the table, and L_C x w_IB
};
template <class S>
Kinematics<S> kinematics(const Contact<S>& c, const ContactSurroundings<S>& around, const InertialContactBody<S>& body,
                         const InertialContactState<S>& x) {
  const Vec3<S>& W = around.W;
  Kinematics<S> k;
  k.s = -(c.tip_radius * around.normal + body.r_c);
  k.z_dot = W.cross(around.normal);
  k.r_c_dot = x.w_IB.cross(body.r_c);
  k.s_dot = -(c.tip_radius * k.z_dot + k.r_c_dot);
  k.V_C = x.v_P - Vec3<S>(x.w_IB.cross(k.s)) + Vec3<S>(W.cross(Vec3<S>(x.X_C + k.s)));
  k.acceleration = around.gravity;
  k.torque = Vec3<S>(S(0), S(0), S(0));
  k.gyroscopic = body.L_C.cross(x.w_IB);
  if (c.has_gradient) {
    k.acceleration += times(around.gradient, x.X_C);
    k.torque += gradient_torque(around.gradient, body.S_BC);
  }
  if (c.omits_torques) {
    k.acceleration -= left_out_acceleration(c, W, x.X_C, Vec3<S>(k.V_C - Vec3<S>(W.cross(x.X_C))));
    const Vec3<S> w = x.w_IB - W;
    k.torque -= S(S(1) - c.weights.coriolis) * coriolis_torque(W, velocity_moment(body.S_BC, w)) +
                S(S(1) - c.weights.centrifugal) * centrifugal_torque(W, body.S_BC);
  }
  return k;
}

/// The derivative of the slip for given accelerations of C and of the rate.
template <class S>
Vec3<S> slip_rate(const ContactSurroundings<S>& around, const InertialContactState<S>& x, const Kinematics<S>& k,
                  const Vec3<S>& A_C, const Vec3<S>& w_dot) {
  return A_C + Vec3<S>(w_dot.cross(k.s)) + Vec3<S>(x.w_IB.cross(k.s_dot)) - Vec3<S>(around.W.cross(Vec3<S>(k.V_C + k.s_dot)));
}

}  // namespace inertial_contact

template <class S>
InertialContactRates<S> inertial_sliding(const Contact<S>& c, const ContactSurroundings<S>& around,
                                         const InertialContactBody<S>& body, const InertialContactState<S>& x) {
  const auto k = inertial_contact::kinematics(c, around, body, x);
  const Vec3<S>&z = around.normal, &W = around.W;
  const Friction<S> f = friction(c, x.v_P, Vec3<S>(x.w_IB - W), z);
  const S per_mass = S(1) / c.mass;
  const Vec3<S> A_0 = k.acceleration + per_mass * f.force, A_1 = per_mass * Vec3<S>(z + f.force_per_normal);
  const Vec3<S> torque_0 = k.torque + Vec3<S>(k.s.cross(f.force));
  const Vec3<S> torque_1 = Vec3<S>(k.s.cross(Vec3<S>(z + f.force_per_normal))) + f.moment_per_normal;
  const Vec3<S> w_0 = times<S>(body.I_inverse, torque_0 + k.gyroscopic), w_1 = times(body.I_inverse, torque_1);
  // z''.X_O + 2 z'.V_O + z.A_O = 0
  const Vec3<S> X_O = x.X_C - body.r_c, V_O = k.V_C - k.r_c_dot, z_ddot = W.cross(k.z_dot);
  const Vec3<S> A_O_0 = A_0 - Vec3<S>(w_0.cross(body.r_c)) - Vec3<S>(x.w_IB.cross(k.r_c_dot));
  const Vec3<S> A_O_1 = A_1 - Vec3<S>(w_1.cross(body.r_c));
  const S slope = inner(z, A_O_1);
  const S N = -(inner(z_ddot, X_O) + S(2) * inner(k.z_dot, V_O) + inner(z, A_O_0)) / slope;

  InertialContactRates<S> rates;
  rates.X_C = k.V_C;
  rates.w_IB = w_0 + N * w_1;
  rates.momentum = torque_0 + N * torque_1;
  rates.v_P = inertial_contact::slip_rate(around, x, k, Vec3<S>(A_0 + N * A_1), rates.w_IB);
  rates.reaction = {N, S(c.mass * slope), Vec3<S>(f.force + N * f.force_per_normal), Vec3<S>(N * f.moment_per_normal)};
  return rates;
}

/// Without slip; `v_P` of the state is taken to be 0.
template <class S>
InertialContactRates<S> inertial_rolling(const Contact<S>& c, const ContactSurroundings<S>& around,
                                         const InertialContactBody<S>& body, InertialContactState<S> x) {
  x.v_P = Vec3<S>(S(0), S(0), S(0));
  const auto k = inertial_contact::kinematics(c, around, body, x);
  const Vec3<S>& z = around.normal;
  const Vec3<S> per_normal = friction(c, x.v_P, Vec3<S>(x.w_IB - around.W), z).moment_per_normal;
  const S per_mass = S(1) / c.mass;
  // The derivative of the slip is affine in the table's force: its part without a force, and that of each component.
  const Vec3<S> w_0 = times<S>(body.I_inverse, k.torque + k.gyroscopic);
  const Vec3<S> slip_0 = inertial_contact::slip_rate(around, x, k, k.acceleration, w_0);
  Mat3<S> w_of, slip_of;
  for (int j = 0; j < 3; ++j) {
    Vec3<S> unit(S(0), S(0), S(0));
    unit[j] = S(1);
    const Vec3<S> w = times<S>(body.I_inverse, Vec3<S>(k.s.cross(unit)) + z[j] * per_normal);
    w_of.col(j) = w;
    slip_of.col(j) = per_mass * unit + Vec3<S>(w.cross(k.s));
  }
  const Vec3<S> force = solved(slip_of, Vec3<S>(-slip_0));
  InertialContactRates<S> rates;
  rates.X_C = k.V_C;
  rates.v_P = x.v_P;
  rates.w_IB = w_0 + times(w_of, force);
  const S N = inner(z, force);
  rates.momentum = k.torque + Vec3<S>(k.s.cross(force)) + N * per_normal;
  // The three components are found together; a moment that made N ambiguous would make their matrix singular.
  rates.reaction = {N, S(1), Vec3<S>(force - N * z), Vec3<S>(N * per_normal)};
  return rates;
}

template <class S>
InertialContactRates<S> inertial_rates(const Contact<S>& c, const ContactSurroundings<S>& around,
                                       const InertialContactBody<S>& body, const InertialContactState<S>& x) {
  return c.law == ContactLaw::rolling ? inertial_rolling(c, around, body, x) : inertial_sliding(c, around, body, x);
}

/// A body symmetric about n, with the inertial rate u + w3 n.
template <class S>
InertialContactBody<S> inertial_body(const Contact<S>& c, const Vec3<S>& n, const Vec3<S>& u, const S& w3) {
  InertialContactBody<S> body;
  body.r_c = c.height_of_center * n;
  body.L_C = c.I1 * u + S(c.I3 * w3) * n;
  const S across = S(1) / c.I1, along = S(1) / c.I3, s1 = c.I3 / S(2), s3 = c.I1 - s1;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const S nn = n[i] * n[j];
      body.I_inverse(i, j) = (i == j ? across : S(0)) + (along - across) * nn;
      body.S_BC(i, j) = (i == j ? s1 : S(0)) + (s3 - s1) * nn;
    }
  return body;
}
/// Any body, with the attitude R_NB and the angular momentum L_C.
template <class S>
InertialContactBody<S> inertial_body(const Contact<S>& c, const Mat3<S>& R_NB, const Vec3<S>& L_C) {
  return {times(R_NB, c.p_OC_B), turned_tensor(R_NB, c.I_BC_B_inverse), L_C, turned_tensor(R_NB, c.S_BC_B)};
}

}  // namespace earthtop
