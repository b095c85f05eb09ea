// SPDX-License-Identifier: GPL-3.0-or-later
/// Equations of a symmetric top on a table, in the table's axes H, without its angle of spin. Variables: the axis n, the
/// transverse inertial rate u = n x (dn/dt in inertial space), the inertial spin w3, the slip velocity v_P and the position p_O of
/// the centre of the tip's sphere. With W the Earth's rate, w = u + w3 n - W, s' = u x n, b = I3 w3 / I1 and tau the sum of the
/// torques about the centre of mass C, at which s = -(r z + l n) points to the contact point:
///
///   dn/dt = s' - W x n ,  du/dt = tau_perp/I1 - b s' - W x u ,  dw3/dt = tau.n/I3 ,  tau = s x (N z + F) + M + ...
///   a_C = g + f/m + (N z + F)/m ,  a_O = a_C - l n'' ,  dv_P/dt = a_O - r w' x z ,  dp_O/dt = v_O = v_P + r w x z
///
/// Sliding: n'' is affine in N, and z.a_O = 0 gives N. As n.n = 1 and u.n = 0,
///   n'' = (tau x n)/I1 + b u - u^2 n - 2 W x s' + W x (W x n) ,
///   z.((s x (N z + F)) x n) = -l N (1 - (z.n)^2) + (r + l z.n) F.n
/// Rolling: v_P = 0; with rho = -s,
///   (Theta + m (rho^2 1 - rho rho^T)) w' = -w_IB x L_C + Theta (w x W) + ... - m rho x acc + M ,  N z + F = m (w' x rho + acc)
/// with acc = w x (w x r_c) - g - f/m, and rho x (w x (w x r_c)) = -l ((w.n) v_C + r w^2 z x n).
///
/// The forms are those with the fewest products: a product of two variables takes n^2/2 multiplications
/// in a series of n orders.
#pragma once

#include "earthtop/model/contact_forces.hpp"
#include "earthtop/model/rolling_inertia.hpp"

namespace earthtop {

template <class S>
struct ReducedContactState {
  Vec3<S> n, u;
  S w3 = S(0);
  Vec3<S> v_P, p_O;  ///< v_P.z = 0, p_O.z = r
};
/// The time derivatives in axes H, and the table's reaction.
template <class S>
struct ReducedContactRates {
  Vec3<S> n, u;
  S w3 = S(0);
  Vec3<S> v_P, p_O;
  ContactReaction<S> reaction;
};

namespace reduced_contact {

/// The quantities that follow from a state without the forces.
template <class S>
struct Kinematics {
  Vec3<S> s_dot, n_dot, w3_n, w, r_c, v_O, v_C, field;
  S b, up;  ///< z.n
};
template <class S>
Kinematics<S> kinematics(const Contact<S>& c, const ContactSurroundings<S>& around, const ReducedContactState<S>& x) {
  Kinematics<S> k;
  k.s_dot = x.u.cross(x.n);
  k.n_dot = k.s_dot - Vec3<S>(around.W.cross(x.n));
  k.w3_n = x.w3 * x.n;
  k.w = x.u + k.w3_n - around.W;
  k.r_c = c.height_of_center * x.n;
  k.v_O = x.v_P + c.tip_radius * Vec3<S>(k.w.cross(around.normal));
  k.v_C = k.v_O + c.height_of_center * k.n_dot;
  k.field = field_beside_gravity(c, around, Vec3<S>(x.p_O + k.r_c), k.v_C);
  if (c.air.pulls) k.field += air_acceleration(c, k.v_C);
  k.b = (c.I3 / c.I1) * x.w3;
  k.up = inner(around.normal, x.n);
  return k;
}

/// The torque about C that is neither gyroscopic nor the table's: those of the gradient and of the air, minus those of [F] that
/// the scene leaves out. With the second moment S = s1 (1 - n n^T) + s3 n n^T about C these are -2 (S W) x w and -(S W) x W
/// (reduced_torques.hpp).
template <class S>
Vec3<S> further_torque(const Contact<S>& c, const ContactSurroundings<S>& around, const Vec3<S>& n, const Vec3<S>& w) {
  Vec3<S> torque(S(0), S(0), S(0));
  if (c.has_gradient) torque += S(c.I1 - c.I3) * Vec3<S>(n.cross(times(around.gradient, n)));
  if (c.air.turns) torque += air_torque_beside_axis(c.air, w, n);
  if (c.omits_torques) {
    const S s1 = c.I3 / S(2), s3 = c.I1 - s1;
    const Vec3<S> SW = s1 * around.W + S((s3 - s1) * inner(n, around.W)) * n;
    torque += SW.cross(Vec3<S>(S(S(2) * (S(1) - c.weights.coriolis)) * w + S(S(1) - c.weights.centrifugal) * around.W));
  }
  return torque;
}

}  // namespace reduced_contact

/// Whether the inertial spin is constant: nothing turns the body about its axis.
template <class S>
bool keeps_spin(const Contact<S>& c) {
  const bool moments = c.law == ContactLaw::contensou || c.has_spinning_friction || c.has_rolling_resistance;
  const bool no_arm = c.law == ContactLaw::frictionless || (c.tip_radius == S(0) && c.law != ContactLaw::rolling);
  return no_arm && !moments && !c.omits_torques && !c.air.turns;
}

/// The time derivatives under a law of sliding friction.
template <class S>
ReducedContactRates<S> reduced_sliding(const Contact<S>& c, const ContactSurroundings<S>& around,
                                       const ReducedContactState<S>& x) {
  using namespace reduced_contact;
  const Vec3<S>& z = around.normal;
  const Vec3<S>& W = around.W;
  const Kinematics<S> k = kinematics(c, around, x);
  const Friction<S> f = friction(c, x.v_P, k.w, z);
  const Vec3<S> further = further_torque(c, around, x.n, k.w);
  const S across = S(1) / c.I1, along = S(1) / c.I3;

  // n'' without the table's force and the further torque, and the parts of z.(tau x n) that have no factor N and that have one
  const Vec3<S> bend = S(k.b) * x.u - inner(x.u, x.u) * x.n + Vec3<S>(W.cross(Vec3<S>(W.cross(x.n) - S(2) * k.s_dot)));
  const S lever = c.tip_radius + c.height_of_center * k.up;
  const S without_N = lever * inner(f.force, x.n) + inner(z, Vec3<S>(further.cross(x.n)));
  const S per_N = lever * inner(f.force_per_normal, x.n) - c.height_of_center * (S(1) - k.up * k.up) +
                  inner(z, Vec3<S>(f.moment_per_normal.cross(x.n)));
  const S numerator = c.height_of_center * (inner(z, bend) + across * without_N) - inner(z, Vec3<S>(around.gravity + k.field));
  const S denominator = S(1) - (c.mass * c.height_of_center * across) * per_N;
  const S N = c.mass * numerator / denominator;

  ReducedContactRates<S> rates;
  rates.reaction = {N, denominator, Vec3<S>(N * f.force_per_normal + f.force), Vec3<S>(N * f.moment_per_normal)};
  const Vec3<S>& F = rates.reaction.friction;
  // The torque of the force at the arm -l n is across the axis.
  const Vec3<S> beside = rates.reaction.moment + further - c.tip_radius * Vec3<S>(z.cross(F));
  const S twist = inner(beside, x.n);
  const Vec3<S> torque = beside - c.height_of_center * Vec3<S>(x.n.cross(Vec3<S>(N * z + F)));
  rates.n = k.n_dot;
  rates.u = across * Vec3<S>(torque - twist * x.n) - k.b * k.s_dot - Vec3<S>(W.cross(x.u));
  rates.w3 = along * twist;
  rates.p_O = k.v_O;
  const Vec3<S> n_ddot = bend + across * Vec3<S>(torque.cross(x.n));
  const Vec3<S> a_O = around.gravity + k.field + S(S(1) / c.mass) * F - c.height_of_center * n_ddot;
  const Vec3<S> w_dot = rates.u + rates.w3 * x.n + x.w3 * k.s_dot - Vec3<S>(W.cross(k.w3_n));
  rates.v_P = in_table_plane(Vec3<S>(a_O - c.tip_radius * Vec3<S>(w_dot.cross(z))), z);
  return rates;
}

/// The time derivatives without slip; `v_P` of the state is taken to be 0 and stays so.
template <class S>
ReducedContactRates<S> reduced_rolling(const Contact<S>& c, const ContactSurroundings<S>& around, ReducedContactState<S> x) {
  using namespace reduced_contact;
  const Vec3<S>& z = around.normal;
  const Vec3<S>& W = around.W;
  x.v_P = Vec3<S>(S(0), S(0), S(0));
  const Kinematics<S> k = kinematics(c, around, x);
  const RollingInertia<S> inertia(c, z, x.n);
  const Vec3<S>& rho = inertia.arm();
  const Vec3<S> further = further_torque(c, around, x.n, k.w), pull = around.gravity + k.field;
  // -w_IB x L_C + Theta (w x W) with Theta = I1 + (I3 - I1) n n^T; n.(w x W) = -W.s'
  const S beyond_across = c.I3 - c.I1, W_turn = inner(W, k.s_dot);
  const Vec3<S> gyroscopic = c.I1 * Vec3<S>(k.w.cross(W)) - S(beyond_across * W_turn) * x.n - S(beyond_across * x.w3) * k.s_dot;
  // -rho x (w x (w x r_c)) / l
  const Vec3<S> centrifugal = S(x.w3 - inner(W, x.n)) * k.v_C + S(c.tip_radius * inner(k.w, k.w)) * Vec3<S>(z.cross(x.n));
  const Vec3<S> right = gyroscopic + further + c.mass * Vec3<S>(c.height_of_center * centrifugal + Vec3<S>(rho.cross(pull)));
  Vec3<S> w_dot = inertia.solved(right);
  const Vec3<S> acc = k.w.cross(Vec3<S>(c.height_of_center * k.n_dot)) - pull;
  const auto normal_force = [&](const Vec3<S>& rate) { return S(c.mass * inner(z, Vec3<S>(Vec3<S>(rate.cross(rho)) + acc))); };

  S N = normal_force(w_dot), denominator = S(1);
  Vec3<S> moment(S(0), S(0), S(0));
  if (c.has_spinning_friction || c.has_rolling_resistance) {
    const Vec3<S> per_normal = friction(c, x.v_P, k.w, z).moment_per_normal;
    const Vec3<S> w_dot_1 = inertia.solved(per_normal);
    denominator = S(1) - c.mass * inner(z, Vec3<S>(w_dot_1.cross(rho)));
    N = N / denominator;
    w_dot += N * w_dot_1;
    moment = N * per_normal;
  }
  ReducedContactRates<S> rates;
  const S turn = inner(w_dot, x.n);
  rates.n = k.n_dot;
  // w_IB = u + w3 n, W does not change in these axes, and W.dn/dt = W.s'
  rates.u = w_dot - turn * x.n - W_turn * x.n - x.w3 * k.s_dot + Vec3<S>(W.cross(k.w3_n));
  rates.w3 = turn + W_turn;
  rates.p_O = k.v_O;
  rates.v_P = x.v_P;
  const Vec3<S> force = c.mass * Vec3<S>(Vec3<S>(w_dot.cross(rho)) + acc);
  rates.reaction = {N, denominator, in_table_plane(force, z), moment};
  return rates;
}

template <class S>
ReducedContactRates<S> reduced_rates(const Contact<S>& c, const ContactSurroundings<S>& around,
                                     const ReducedContactState<S>& x) {
  return c.law == ContactLaw::rolling ? reduced_rolling(c, around, x) : reduced_sliding(c, around, x);
}

}  // namespace earthtop
