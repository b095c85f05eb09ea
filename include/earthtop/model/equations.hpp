// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of motion, each in the variables of one of three observers. The non-rotating prediction uses the same
/// equations without the Earth's rate (`kEarth` false, or zero non-inertial torque).
///
/// | observer             | attitude | rate variable                        | equation                                   |
/// | rotating laboratory  | q_LB     | L'_L = Theta w_LB in laboratory axes | dL'/dt = tau_Cor + tau_cent + tau_phys [F]  |
/// | body axes            | q_LB     | w_IB in body axes                    | Theta dw/dt = (Theta w) x w + tau_phys     |
/// | inertial axes        | q_NB     | L in axes N                          | dL/dt = tau_phys                           |
///
/// With masses that move in the body (moving_masses.hpp) the second is Liouville's equation, Theta dw/dt + (dTheta/dt) w + dl/dt =
/// (Theta w + l) x w + tau_phys. The model is that at the time of the state, so that all equations take Theta and the mass moment from there.
///
/// N is the inertial frame that is parallel to L at t = 0; [F] is cited in torques.hpp. Rotation matrices are always those of q
/// / |q|.
#pragma once

#include "earthtop/model/model.hpp"

namespace earthtop {

/// Attitude and rate variable of one motion, or their time derivatives. The observer decides which rate variable it is (see the
/// table).
template <class T>
struct Motion {
  Quaternion<T> q;
  Vec3<T> m = Vec3<T>::Zero();
};

/// dq_AB/dt = q_AB w_B / 2 for a rate in body axes.
template <class T>
Quaternion<T> attitude_rate_from_body(const Quaternion<T>& q_AB, const Vec3<T>& w_AB_B) {
  const Vec3<T> h = w_AB_B / T(2);
  return {-q_AB.v.dot(h), q_AB.w * h + q_AB.v.cross(h)};
}

/// dq_AB/dt = w_A q_AB / 2 for a rate in the axes of A.
template <class T>
Quaternion<T> attitude_rate_from_outer(const Quaternion<T>& q_AB, const Vec3<T>& w_AB_A) {
  const Vec3<T> h = w_AB_A / T(2);
  return {-q_AB.v.dot(h), q_AB.w * h + h.cross(q_AB.v)};
}

/// The rate Theta^-1 L with everything in the outer axes A: R Theta^-1 R^T L.   @param inside  what turns inside the body
template <class T, class Inside = NothingInside>
Vec3<T> rate_from_momentum(const Model<T>& model, const Mat3<T>& R_AB, const Vec3<T>& L_A, const Inside& inside = {}) {
  return times(R_AB, times(model.I_BP_B_inverse, without_inside<T>(transposed_times(R_AB, L_A), inside)));
}

/// The torques of [F] on the body in laboratory axes, with the scene's weights, from the velocity moment J and the second
/// moment in L axes.
template <SceneKind K, class T, class Inside = NothingInside>
Vec3<T> non_inertial_torque(const Model<T>& model, const Motion<T>& rotating, const Inside& inside = {}) {
  const Mat3<T> R_LB = rotation_matrix(rotating.q);
  const Vec3<T> w_LB_L = rate_from_momentum(model, R_LB, rotating.m, inside);
  const Mat3<T> S_BP_L = turned_tensor(R_LB, model.S_BP_B);
  return laboratory_torque<K>(model.weights, model.W_IL_L, model.W_IL_L, velocity_moment(S_BP_L, w_LB_L, R_LB, inside), S_BP_L);
}

/// The equation in rotating laboratory axes [F]: dL'/dt = tau_Cor + tau_cent + tau_phys.
/// @param torque_L  the non-inertial torques; zero in a laboratory that does not rotate
template <class T, class Inside = NothingInside>
Motion<T> laboratory_equation(const Model<T>& model, const Motion<T>& x, const Vec3<T>& field_L, const Vec3<T>& torque_L,
                              const Inside& inside = {}) {
  const Mat3<T> R_LB = rotation_matrix(x.q);
  const Vec3<T> w_LB_L = rate_from_momentum(model, R_LB, x.m, inside);
  return {attitude_rate_from_outer(x.q, w_LB_L), field_torque(times(R_LB, model.mass_moment_B), field_L) + torque_L};
}

/// Euler's equation in body axes. It contains all non-inertial effects, so torques that the scene leaves out in the laboratory
/// are subtracted as applied torques.
template <bool kEarth, SceneKind K, class T, class Inside = NothingInside>
Motion<T> body_equation(const Model<T>& model, const Motion<T>& x, const Vec3<T>& field_L, const Inside& inside = {}) {
  const Mat3<T> R_LB = rotation_matrix(x.q);
  const Vec3<T>& w_IB_B = x.m;
  Vec3<T> torque_B = field_torque(model.mass_moment_B, transposed_times(R_LB, field_L));
  Vec3<T> w_LB_B = w_IB_B;
  if constexpr (kEarth) {
    const Vec3<T> W_B = transposed_times(R_LB, model.W_IL_L);
    w_LB_B -= W_B;
    if constexpr (K != SceneKind::plain)
      torque_B -= laboratory_torque<K>(model.weights.complement(), W_B, W_B, velocity_moment_B(model.S_BP_B, w_LB_B, inside),
                                       model.S_BP_B);
  }
  Vec3<T> L_B = times(model.I_BP_B, w_IB_B);
  if constexpr (kTurnsInside<Inside>) {
    L_B += inside.momentum_B, torque_B -= inside.momentum_rate_B;
    if (inside.masses) torque_B -= times(inside.masses->inertia_rate(), w_IB_B);
  }
  return {attitude_rate_from_body(x.q, w_LB_B), times<T>(model.I_BP_B_inverse, L_B.cross(w_IB_B) + torque_B)};
}

/// q_NL(t), the rotation of the laboratory by W t since the release, as (cos, sin / epsilon): dividing the vector part by
/// epsilon keeps its digits at every Earth rate.
template <class T>
struct LaboratoryTurn {
  T w;
  Vec3<T> v_scaled;
  Quaternion<T> quaternion(T epsilon) const { return {w, epsilon * v_scaled}; }
};
template <class T>
LaboratoryTurn<T> laboratory_turn(const Model<T>& model, T t) {
  const T rate_scaled = norm(model.W_IL_L_scaled);
  if (!(rate_scaled > T(0))) return {T(1), Vec3<T>::Zero()};
  const SinCos<T> half = real::sin_cos(T(model.epsilon * rate_scaled * t / T(2)));
  return {half.cos, (half.sin / (model.epsilon * rate_scaled)) * model.W_IL_L_scaled};
}

/// The equation in inertial axes N.   @param R_NL  attitude of the laboratory at this time; gravity turns with it
template <bool kEarth, SceneKind K, class T, class Inside = NothingInside>
Motion<T> inertial_equation(const Model<T>& model, const Motion<T>& x, const Vec3<T>& field_L, const Mat3<T>& R_NL,
                            const Inside& inside = {}) {
  const Mat3<T> R_NB = rotation_matrix(x.q);
  const Vec3<T> w_IB_N = rate_from_momentum(model, R_NB, x.m, inside);
  Vec3<T> torque_N = field_torque(times(R_NB, model.mass_moment_B), times(R_NL, field_L));
  if constexpr (kEarth && K != SceneKind::plain) {
    const Vec3<T> W_N = times(R_NL, model.W_IL_L);
    const Mat3<T> S_BP_N = turned_tensor(R_NB, model.S_BP_B);
    torque_N -= laboratory_torque<K>(model.weights.complement(), W_N, W_N,
                                     velocity_moment(S_BP_N, Vec3<T>(w_IB_N - W_N), R_NB, inside), S_BP_N);
  }
  return {attitude_rate_from_outer(x.q, w_IB_N), torque_N};
}

}  // namespace earthtop
