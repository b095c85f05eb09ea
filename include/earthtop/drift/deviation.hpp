// SPDX-License-Identifier: GPL-3.0-or-later
/// The deviation of the rotating motion from the non-rotating prediction. It has equations of its own, integrated alongside the
/// two motions (Encke's idea), so that two nearly equal trajectories are never subtracted. Each observer has one form of them,
/// derived independently of the others:
///
/// | observer    | attitude deviation              | rate deviation                                        |
/// | laboratory  | R_rot R_ref^T, axes L           | of w_LB, turned to L; driven by [F]'s torques         |
/// | body        | R_ref^T R_rot, body axes        | of w_IB; the laboratory turns away under the attitude |
/// | inertial    | R_rot R_ref^T, axes N           | of w_IB, turned to N; driven by gravity, which turns  |
///
/// The rate deviation is p = Theta (w_rot - w_ref), each rate in its own body axes: the part that the two spins share cancels
/// exactly.
///
/// The state holds the vector part v of the attitude deviation's quaternion and the rate deviation divided by epsilon (see
/// Model): y = v / epsilon.
#pragma once

#include <array>
#include <cstddef>

#include "earthtop/integrate/options.hpp"
#include "earthtop/model/equations.hpp"

namespace earthtop {

/// The attitude deviation, a quaternion (w, epsilon * y), and the rate deviation epsilon * p (an angular momentum), or their
/// time derivatives; in the model's natural units.
template <class T>
struct Deviation {
  T w = T(1);
  Vec3<T> y = Vec3<T>::Zero();
  Vec3<T> p = Vec3<T>::Zero();
};

/// The deviation's equations in body axes: with inertial rates and Euler's equation; the laboratory turns away under the
/// attitude. Time derivatives of e = (e_w, e_v) = (w, y) and of p, for epsilon = 1:
///   de/dt: e_v x w_ref + (e_w d + e_v x d)/2, -(e_v.d)/2 with d = Theta^-1 p - R_rot^T W
///   dp/dt = p x w_ref + (Theta w_rot) x (Theta^-1 p) + m r x (R_rot^T f_rot - R_ref^T f_ref)
/// where m r is the mass moment about the pivot, W the Earth's rate and f the field at the pivot (apparent gravity).
/// With a rotor inside (rotor.hpp) p is the difference of the total momenta, and Theta w_rot stands for the whole momentum.
/// @param reference  the non-rotating motion (q_LB, w_IB_B)   @param x  the deviation   @param field  at the pivot, axes L
/// @param inside  what turns inside the body in both motions
/// @returns the time derivatives of the deviation
template <SceneKind K, class T, class Inside = NothingInside>
Deviation<T> body_deviation_equation(const Model<T>& model, const Motion<T>& reference, const Deviation<T>& x,
                                     const PivotField<T>& field, const Inside& inside = {}) {
  const T epsilon = model.epsilon;
  const Mat3<T> R_ref = rotation_matrix(reference.q);
  const Vec3<T>& w_ref_B = reference.m;
  const Vec3<T> Dw_B = times<T>(model.I_BP_B_inverse, without_difference(x.p, inside));
  const Vec3<T> w_IB_B = w_ref_B + epsilon * Dw_B;
  const auto into_rotating_body = [&](const Vec3<T>& u_L) -> Vec3<T> {
    const Vec3<T> u_ref = transposed_times(R_ref, u_L);
    return u_ref + epsilon * turn_back_minus_one_scaled(x.w, x.y, epsilon, u_ref);
  };
  const Vec3<T> W_B_scaled = into_rotating_body(model.W_IL_L_scaled);
  const Vec3<T> d_B = Dw_B - W_B_scaled;
  Vec3<T> Dfield_B = turn_back_minus_one_scaled(x.w, x.y, epsilon, transposed_times(R_ref, field.reference_L));
  if constexpr (K != SceneKind::plain) Dfield_B += into_rotating_body(field.difference_L_scaled);
  Vec3<T> L_B = times(model.I_BP_B, w_IB_B);
  if constexpr (kTurnsInside<Inside>) L_B += inside.rotating_B;
  Vec3<T> dp = x.p.cross(w_ref_B) + L_B.cross(Dw_B) + field_torque(model.mass_moment_B, Dfield_B);
  if constexpr (K != SceneKind::plain) {
    const Vec3<T> W_B = epsilon * W_B_scaled;
    dp -= laboratory_torque<K>(model.weights.complement(), W_B, W_B_scaled,
                               velocity_moment_B(model.S_BP_B, Vec3<T>(w_IB_B - W_B), inside), model.S_BP_B);
  }
  return {-epsilon * epsilon * x.y.dot(d_B) / T(2), x.y.cross(w_ref_B) + (x.w * d_B + epsilon * x.y.cross(d_B)) / T(2), dp};
}

/// The equations that the two forms in outer axes A (laboratory or inertial) share. They follow from the body form when its
/// vectors are turned by the reference's attitude: k = R_ref e_v and P = R_ref p do not turn with the spin, and the reference's
/// own rate drops out of both,
///   dk/dt = (e_w d + k x d)/2 ,  de_w/dt = -(k.d)/2 ,  d = R_ref Theta^-1 R_ref^T P
///   dP/dt = (L_ref + P) x d + m r_ref x (D^T f_rot - f_ref) + D^T tau ,  D = R_rot R_ref^T = R(e_w + k)
/// so that no large terms cancel: the spin that both motions have in common appears nowhere.
/// @param reference  the non-rotating motion (q, L in A)   @param x  the deviation (w, k, P)
/// @param field_ref_A  f_ref   @param field_difference_A_scaled  (f_rot - f_ref) / epsilon
/// @param carried_torque_A_scaled  further torque tau on the rotating body, turned back by D^T and divided by epsilon
/// @returns the time derivatives of the deviation
/// With a rotor inside the body (rotor.hpp) d is what Theta^-1 makes of R_ref^T P without the difference of the rotor's momenta.
template <class T, class Inside = NothingInside>
Deviation<T> outer_axes_deviation(const Model<T>& model, const Motion<T>& reference, const Deviation<T>& x,
                                  const Vec3<T>& field_ref_A, const Vec3<T>& field_difference_A_scaled,
                                  const Vec3<T>& carried_torque_A_scaled, const Inside& inside = {}) {
  const T epsilon = model.epsilon;
  const Mat3<T> R_ref = rotation_matrix(reference.q);
  const Vec3<T> d_B = times<T>(model.I_BP_B_inverse, without_difference<T>(transposed_times(R_ref, x.p), inside));
  const Vec3<T> d_A = times(R_ref, d_B);
  const auto D_transposed_minus_one = [&](const Vec3<T>& u) { return turn_back_minus_one_scaled(x.w, x.y, epsilon, u); };
  const Vec3<T> Dfield_A = D_transposed_minus_one(field_ref_A) + field_difference_A_scaled +
                           epsilon * D_transposed_minus_one(field_difference_A_scaled);
  const Vec3<T> momentum_A = reference.m + epsilon * x.p;
  return {-epsilon * epsilon * x.y.dot(d_A) / T(2), (x.w * d_A + epsilon * x.y.cross(d_A)) / T(2),
          momentum_A.cross(d_A) + field_torque(times(R_ref, model.mass_moment_B), Dfield_A) + carried_torque_A_scaled};
}

/// The Earth's rate over epsilon in the axes of the rotating body, from a deviation in outer axes.
template <class T>
Vec3<T> earth_rate_in_body_scaled(const Model<T>& model, const Mat3<T>& R_ref, const Deviation<T>& x) {
  const Vec3<T>& W_A = model.W_IL_L_scaled;  // the laboratory turns about W, which is the same vector in L and in N
  return transposed_times(R_ref, Vec3<T>(W_A + model.epsilon * turn_back_minus_one_scaled(x.w, x.y, model.epsilon, W_A)));
}

/// [F]'s laboratory torques on the rotating body, weighted, divided by epsilon and turned back by D^T. They are found by their
/// tensor forms in body axes, where the second moment is constant, and then turned by the reference's attitude. The attitude
/// and the rate of the rotating body are the ones that the deviation gives, R_rot = D R_ref: the torque along the spin is the
/// small remainder of a large one, and the error of a motion integrated separately would spoil it.
/// @param inertial_momentum  whether the reference's L and the deviation are made of inertial rates, or else of rates relative
/// to the laboratory
/// @returns D^T tau / epsilon, in the outer axes
template <SceneKind K, class T, class Inside = NothingInside>
Vec3<T> carried_laboratory_torque(const Model<T>& model, const TorqueWeights<T>& weights, const Motion<T>& reference,
                                  const Deviation<T>& x, bool inertial_momentum, const Inside& inside = {}) {
  const T epsilon = model.epsilon;
  const Mat3<T> R_ref = rotation_matrix(reference.q);
  const Vec3<T> W_B_scaled = earth_rate_in_body_scaled(model, R_ref, x);
  const Vec3<T> W_B = epsilon * W_B_scaled;
  Vec3<T> momentum_B = transposed_times(R_ref, Vec3<T>(reference.m + epsilon * x.p));
  if constexpr (kTurnsInside<Inside>) momentum_B -= inside.rotating_B;
  Vec3<T> w_LB_B = times(model.I_BP_B_inverse, momentum_B);
  if (inertial_momentum) w_LB_B -= W_B;
  const Mat3<T> J_B = velocity_moment_B(model.S_BP_B, w_LB_B, inside);
  return times(R_ref, laboratory_torque<K>(weights, W_B, W_B_scaled, J_B, model.S_BP_B));
}

/// The deviation's equations in laboratory axes: with rates relative to the laboratory; the deviation is driven by [F]'s
/// Coriolis and centrifugal torques on the rotating body.
/// @param reference  the non-rotating motion (q_LB, L'_L)
/// @returns the time derivatives of the deviation
template <SceneKind K, class T, class Inside = NothingInside>
Deviation<T> laboratory_deviation_equation(const Model<T>& model, const Motion<T>& reference, const Deviation<T>& x,
                                           const PivotField<T>& field, const Inside& inside = {}) {
  return outer_axes_deviation(model, reference, x, field.reference_L, field.difference_L_scaled,
                              carried_laboratory_torque<K>(model, model.weights, reference, x, false, inside), inside);
}

/// The deviation's equations in inertial axes N: the deviation is driven by the laboratory's field, which turns with the Earth.
/// @param reference  the non-rotating motion (q_NB, L_N); its laboratory does not turn
/// @param turn  of the laboratory relative to N since the release
/// @returns the time derivatives of the deviation
template <SceneKind K, class T, class Inside = NothingInside>
Deviation<T> inertial_deviation_equation(const Model<T>& model, const Motion<T>& reference, const Deviation<T>& x,
                                         const PivotField<T>& field, const LaboratoryTurn<T>& turn, const Inside& inside = {}) {
  const T epsilon = model.epsilon;
  const Vec3<T> turned = turn_minus_one_scaled(turn.w, turn.v_scaled, epsilon, field.rotating_L);
  Vec3<T> applied_N = Vec3<T>::Zero();
  if constexpr (K != SceneKind::plain)
    applied_N = -carried_laboratory_torque<K>(model, model.weights.complement(), reference, x, true, inside);
  return outer_axes_deviation(model, reference, x, field.reference_L, Vec3<T>(turned + field.difference_L_scaled), applied_N,
                              inside);
}

}  // namespace earthtop
