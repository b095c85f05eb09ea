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
#include "earthtop/model/rolling_inertia.hpp"

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
  Mat3<S> R_NB;       ///< attitude of a body that is not symmetric; read only where the air acts
  /// A symmetric body's axis, that axis's derivative, L_C x w_IB, and the inverse of the inertia as
  /// `across` + `beyond_across` n n^T. The matrix is then not set.
  bool is_symmetric = false;
  Vec3<S> n, n_dot, gyroscopic;
  S across = S(0), beyond_across = S(0);

  /// The inverse of the inertia times a vector that is normal to the axis of a symmetric body.
  Vec3<S> inverse_times_across(const Vec3<S>& y) const {
    return is_symmetric ? Vec3<S>(across * y) : Vec3<S>(times(I_inverse, y));
  }
  /// dw_IB/dt under a torque about C.   @param gyro  L_C x w_IB
  Vec3<S> rate_under(const Vec3<S>& torque, const Vec3<S>& gyro) const {
    if (is_symmetric) return across * Vec3<S>(torque + gyro) + S(beyond_across * inner(n, torque)) * n;
    return times(I_inverse, Vec3<S>(torque + gyro));
  }
};
template <class S>
struct InertialContactRates {
  Vec3<S> X_C;  ///< V_C
  Vec3<S> v_P;
  Vec3<S> w_IB;
  S w3 = S(0);       ///< of a symmetric body: of w_IB.n, as w_IB.dn/dt = 0
  Vec3<S> momentum;  ///< dL_C/dt
  ContactReaction<S> reaction;
};

namespace inertial_contact {

template <class S>
struct Kinematics {
  Vec3<S> s, s_dot, V_C, r_c_dot, z_dot, acceleration;
  Vec3<S> centripetal;         ///< w_IB x dr_c/dt
  Vec3<S> torque, gyroscopic;  ///< about C: of others than the table, and L_C x w_IB
};
template <class S>
Kinematics<S> kinematics(const Contact<S>& c, const ContactSurroundings<S>& around, const InertialContactBody<S>& body,
                         const InertialContactState<S>& x) {
  const Vec3<S>& W = around.W;
  Kinematics<S> k;
  k.s = -(c.tip_radius * around.normal + body.r_c);
  k.z_dot = W.cross(around.normal);
  k.r_c_dot = body.is_symmetric ? Vec3<S>(c.height_of_center * body.n_dot) : Vec3<S>(x.w_IB.cross(body.r_c));
  k.s_dot = -(c.tip_radius * k.z_dot + k.r_c_dot);
  k.centripetal = x.w_IB.cross(k.r_c_dot);
  k.V_C = x.v_P + c.tip_radius * Vec3<S>(x.w_IB.cross(around.normal)) + k.r_c_dot + Vec3<S>(W.cross(Vec3<S>(x.X_C + k.s)));
  k.acceleration = around.gravity;
  k.torque = Vec3<S>(S(0), S(0), S(0));
  k.gyroscopic = body.is_symmetric ? body.gyroscopic : Vec3<S>(body.L_C.cross(x.w_IB));
  if (c.has_gradient) {
    k.acceleration += times(around.gradient, x.X_C);
    k.torque += gradient_torque(around.gradient, body.S_BC);
  }
  if (c.air.pulls) k.acceleration += air_acceleration(c, Vec3<S>(k.V_C - Vec3<S>(W.cross(x.X_C))));
  if (c.air.turns) {
    const Vec3<S> w = x.w_IB - W;
    k.torque += body.is_symmetric ? air_torque_beside_axis(c.air, w, body.n)
                                  : times(body.R_NB, air_torque_B(c.air, transposed_times(body.R_NB, w)));
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
Vec3<S> slip_rate(const Contact<S>& c, const ContactSurroundings<S>& around, const InertialContactState<S>& x,
                  const Kinematics<S>& k, const Vec3<S>& A_C, const Vec3<S>& w_dot) {
  return A_C + Vec3<S>(w_dot.cross(k.s)) - c.tip_radius * Vec3<S>(x.w_IB.cross(k.z_dot)) - k.centripetal -
         Vec3<S>(around.W.cross(Vec3<S>(k.V_C + k.s_dot)));
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
  // z''.X_O + 2 z'.V_O + z.A_O = 0 with A_O = A_C - w' x r_c - w x r_c', and z.(w' x r_c) = w'.(r_c x z)
  const Vec3<S> X_O = x.X_C - body.r_c, V_O = k.V_C - k.r_c_dot, z_ddot = W.cross(k.z_dot);
  const Vec3<S> tip = body.inverse_times_across(Vec3<S>(body.r_c.cross(z)));
  const S slope = inner(z, A_1) - inner(tip, torque_1);
  const S rest = inner(z, Vec3<S>(A_0 - k.centripetal)) - inner(tip, Vec3<S>(torque_0 + k.gyroscopic));
  const S N = -(inner(z_ddot, X_O) + S(2) * inner(k.z_dot, V_O) + rest) / slope;

  InertialContactRates<S> rates;
  rates.X_C = k.V_C;
  rates.momentum = torque_0 + N * torque_1;
  rates.w_IB = body.rate_under(rates.momentum, k.gyroscopic);
  if (body.is_symmetric) rates.w3 = S(body.across + body.beyond_across) * inner(body.n, rates.momentum);
  rates.v_P = inertial_contact::slip_rate(c, around, x, k, Vec3<S>(A_0 + N * A_1), rates.w_IB);
  rates.reaction = {N, S(c.mass * slope), Vec3<S>(f.force + N * f.force_per_normal), Vec3<S>(N * f.moment_per_normal)};
  return rates;
}

namespace inertial_contact {

/// A symmetric body that rolls: with A_C = A - w' x s where the derivative of the slip is 0, and the force m (A_C - g),
/// (Theta + m (s^2 1 - s s^T)) w' = torque + L_C x w + m s x (A - g) + N per_normal.
template <class S>
InertialContactRates<S> rolling_symmetric(const Contact<S>& c, const ContactSurroundings<S>& around,
                                          const InertialContactBody<S>& body, const InertialContactState<S>& x,
                                          const Kinematics<S>& k, const Vec3<S>& per_normal) {
  const Vec3<S>& z = around.normal;
  const RollingInertia<S> inertia(c, z, body.n);
  const Vec3<S> none(S(0), S(0), S(0)), unturned = -slip_rate(c, around, x, k, none, none) - k.acceleration;
  InertialContactRates<S> rates;
  rates.X_C = k.V_C, rates.v_P = x.v_P;
  rates.w_IB = inertia.solved(Vec3<S>(k.torque + k.gyroscopic + c.mass * Vec3<S>(k.s.cross(unturned))));
  const auto force_of = [&](const Vec3<S>& w_dot) { return Vec3<S>(c.mass * Vec3<S>(unturned - Vec3<S>(w_dot.cross(k.s)))); };
  S N = inner(z, force_of(rates.w_IB));
  if (c.has_spinning_friction || c.has_rolling_resistance) {
    const Vec3<S> w_dot_1 = inertia.solved(per_normal);
    N = N / (S(1) + c.mass * inner(z, Vec3<S>(w_dot_1.cross(k.s))));
    rates.w_IB += N * w_dot_1;
  }
  rates.w3 = inner(rates.w_IB, body.n);
  const Vec3<S> force = force_of(rates.w_IB);
  rates.momentum = k.torque + Vec3<S>(k.s.cross(force)) + N * per_normal;
  rates.reaction = {N, S(1), Vec3<S>(force - N * z), Vec3<S>(N * per_normal)};
  return rates;
}

}  // namespace inertial_contact

/// Without slip; `v_P` of the state is taken to be 0.
template <class S>
InertialContactRates<S> inertial_rolling(const Contact<S>& c, const ContactSurroundings<S>& around,
                                         const InertialContactBody<S>& body, InertialContactState<S> x) {
  x.v_P = Vec3<S>(S(0), S(0), S(0));
  const auto k = inertial_contact::kinematics(c, around, body, x);
  const Vec3<S>& z = around.normal;
  const Vec3<S> per_normal = friction(c, x.v_P, Vec3<S>(x.w_IB - around.W), z).moment_per_normal;
  if (body.is_symmetric) return inertial_contact::rolling_symmetric(c, around, body, x, k, per_normal);
  const S per_mass = S(1) / c.mass;
  // The derivative of the slip is affine in the table's force: its part without a force, and that of each component.
  const Vec3<S> w_0 = body.rate_under(k.torque, k.gyroscopic);
  const Vec3<S> slip_0 = inertial_contact::slip_rate(c, around, x, k, k.acceleration, w_0);
  Mat3<S> w_of, slip_of;
  for (int j = 0; j < 3; ++j) {
    Vec3<S> unit(S(0), S(0), S(0));
    unit[j] = S(1);
    const Vec3<S> w = times(body.I_inverse, Vec3<S>(Vec3<S>(k.s.cross(unit)) + z[j] * per_normal));
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
  const S s1 = c.I3 / S(2), s3 = c.I1 - s1;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) body.S_BC(i, j) = (i == j ? s1 : S(0)) + (s3 - s1) * (n[i] * n[j]);
  body.is_symmetric = true;
  body.n = n, body.n_dot = u.cross(n);
  body.gyroscopic = S((c.I1 - c.I3) * w3) * body.n_dot;
  body.across = S(1) / c.I1, body.beyond_across = S(1) / c.I3 - body.across;
  return body;
}
/// Any body, with the attitude R_NB and the angular momentum L_C.
template <class S>
InertialContactBody<S> inertial_body(const Contact<S>& c, const Mat3<S>& R_NB, const Vec3<S>& L_C) {
  InertialContactBody<S> body;
  body.r_c = times(R_NB, c.p_OC_B), body.L_C = L_C, body.R_NB = R_NB;
  body.I_inverse = turned_tensor(R_NB, c.I_BC_B_inverse), body.S_BC = turned_tensor(R_NB, c.S_BC_B);
  return body;
}

}  // namespace earthtop
