/// The deviation of the rotating motion from the non-rotating prediction, integrated itself (Encke's idea) beside the two
/// motions: no two nearly equal trajectories are ever subtracted. One form for each observer, derived apart:
///
/// | observer    | attitude deviation              | rate deviation                                        |
/// | laboratory  | e of R_ref^T R_rot, body axes   | p = Theta (w_LB,rot - w_LB,ref); [F]'s torques drive it |
/// | body        | e of R_ref^T R_rot, body axes   | p = Theta (w_IB,rot - w_IB,ref)                       |
/// | inertial    | d of R_rot R_ref^T, axes N      | Delta L = L_rot - L_ref in N                          |
///
/// The vector part of the quaternion and the rate deviation are carried divided by epsilon (see Model): y = v / epsilon.
#pragma once

#include <array>
#include <cstddef>

#include "earthtop/integrate/options.hpp"
#include "earthtop/model/equations.hpp"

namespace earthtop {

/// Attitude deviation (w, epsilon * y) and rate deviation epsilon * p, or their time derivatives.
template <class T>
struct Deviation {
  T w = T(1);
  Vec3<T> y = Vec3<T>::Zero();
  Vec3<T> p = Vec3<T>::Zero();
};

/// (R(e) - 1) u / epsilon for e = (w, epsilon y), |e| divided out: 2 w y x u + 2 epsilon y x (y x u), over |e|^2.
template <class T>
Vec3<T> turn_minus_one_scaled(T w, const Vec3<T>& y, T epsilon, const Vec3<T>& u) {
  const Vec3<T> yu = y.cross(u);
  const T s = T(2) / (w * w + epsilon * epsilon * y.dot(y));
  return s * (w * yu + epsilon * y.cross(yu));
}
/// (R(e)^T - 1) u / epsilon.
template <class T>
Vec3<T> turn_back_minus_one_scaled(T w, const Vec3<T>& y, T epsilon, const Vec3<T>& u) {
  return turn_minus_one_scaled(w, Vec3<T>(-y), epsilon, u);
}

/// What the two body-axes forms share: e moves by the difference d of the two rates that turn the attitudes (over epsilon),
/// and p by the gyroscopic difference and the difference of the physical torques.
/// @param field_ref_B  the reference's field in its body axes   @param extra_B_scaled  further torque on the rotating body / epsilon
template <SceneKind K, class T>
Deviation<T> body_axes_deviation_rate(const Model<T>& model, const Deviation<T>& x, const Vec3<T>& w_ref_B,
                                      const Vec3<T>& w_rot_B, const Vec3<T>& Dw_B_scaled, const Vec3<T>& d_B_scaled,
                                      const Vec3<T>& field_ref_B, const Vec3<T>& field_difference_B_scaled,
                                      const Vec3<T>& extra_B_scaled) {
  Vec3<T> Dfield_B = turn_back_minus_one_scaled(x.w, x.y, model.epsilon, field_ref_B);
  if constexpr (K == SceneKind::full) Dfield_B += field_difference_B_scaled;
  const Vec3<T> L_rot_B = model.I_BP_B * w_rot_B;
  const T epsilon = model.epsilon;
  return {-epsilon * epsilon * x.y.dot(d_B_scaled) / T(2),
          x.y.cross(w_ref_B) + (x.w * d_B_scaled + epsilon * x.y.cross(d_B_scaled)) / T(2),
          x.p.cross(w_ref_B) + L_rot_B.cross(Dw_B_scaled) + field_torque<T>(model.mass_moment_B, Dfield_B) + extra_B_scaled};
}

/// Laboratory form: relative rates; [F]'s torques on the rotating body drive the deviation.
/// @param reference  the non-rotating motion (q_LB, L'_L)
template <SceneKind K, class T>
Deviation<T> laboratory_deviation_equation(const Model<T>& model, const Motion<T>& reference, const Deviation<T>& x,
                                           const PivotField<T>& field) {
  const Mat3<T> R_ref = rotation_matrix(reference.q);
  const T epsilon = model.epsilon;
  const Vec3<T> w_ref_B = model.I_BP_B_inverse * (R_ref.transpose() * reference.m);
  const Vec3<T> Dw_B = model.I_BP_B_inverse * x.p;
  const Vec3<T> w_LB_B = w_ref_B + epsilon * Dw_B;
  const auto into_rotating_body = [&](const Vec3<T>& u_L) -> Vec3<T> {
    const Vec3<T> u_ref = R_ref.transpose() * u_L;
    return u_ref + epsilon * turn_back_minus_one_scaled(x.w, x.y, epsilon, u_ref);
  };
  const Vec3<T> W_B_scaled = into_rotating_body(model.W_IL_L_scaled);
  const Vec3<T> torque_B =
      laboratory_torque<K>(model.weights, Vec3<T>(epsilon * W_B_scaled), W_B_scaled, w_LB_B, model.S_BP_B);
  Vec3<T> field_difference_B = Vec3<T>::Zero();
  if constexpr (K == SceneKind::full) field_difference_B = into_rotating_body(field.difference_L_scaled);
  return body_axes_deviation_rate<K>(model, x, w_ref_B, w_LB_B, Dw_B, Dw_B, Vec3<T>(R_ref.transpose() * field.reference_L),
                                     field_difference_B, torque_B);
}

/// Body form: inertial rates, Euler's equation; the laboratory turns away under the attitude.
/// @param reference  the non-rotating motion (q_LB, w_IB_B)
template <SceneKind K, class T>
Deviation<T> body_deviation_equation(const Model<T>& model, const Motion<T>& reference, const Deviation<T>& x,
                                     const PivotField<T>& field) {
  const Mat3<T> R_ref = rotation_matrix(reference.q);
  const T epsilon = model.epsilon;
  const Vec3<T> Dw_B = model.I_BP_B_inverse * x.p;
  const Vec3<T> w_IB_B = reference.m + epsilon * Dw_B;
  const auto into_rotating_body = [&](const Vec3<T>& u_L) -> Vec3<T> {
    const Vec3<T> u_ref = R_ref.transpose() * u_L;
    return u_ref + epsilon * turn_back_minus_one_scaled(x.w, x.y, epsilon, u_ref);
  };
  const Vec3<T> W_B_scaled = into_rotating_body(model.W_IL_L_scaled);
  Vec3<T> extra_B = Vec3<T>::Zero(), field_difference_B = Vec3<T>::Zero();
  if constexpr (K == SceneKind::full) {
    const Vec3<T> W_B = epsilon * W_B_scaled;
    extra_B = -laboratory_torque<K>(model.weights.complement(), W_B, W_B_scaled, Vec3<T>(w_IB_B - W_B), model.S_BP_B);
    field_difference_B = into_rotating_body(field.difference_L_scaled);
  }
  return body_axes_deviation_rate<K>(model, x, reference.m, w_IB_B, Dw_B, Vec3<T>(Dw_B - W_B_scaled),
                                     Vec3<T>(R_ref.transpose() * field.reference_L), field_difference_B, extra_B);
}

/// Inertial form, all in axes N: D = R_rot R_ref^T = 1 + A with A = O(epsilon), J = R_ref Theta^-1 R_ref^T,
///   Delta w = D J D^T L_rot - J L_ref = A J D^T L_rot + J A^T L_rot + J Delta L,
///   dDelta L/dt = tau(rot) - tau(ref) = (A m r) x f_rot + m r x (f_rot - f_ref).
/// @param reference  the non-rotating motion (q_NB = q_LB, L_N)
template <SceneKind K, class T>
Deviation<T> inertial_deviation_equation(const Model<T>& model, const Motion<T>& reference, const Deviation<T>& x,
                                         const PivotField<T>& field, const LaboratoryTurn<T>& turn) {
  const Mat3<T> R_ref = rotation_matrix(reference.q);
  const T epsilon = model.epsilon;
  const auto A = [&](const Vec3<T>& u) { return turn_minus_one_scaled(x.w, x.y, epsilon, u); };
  const auto A_transposed = [&](const Vec3<T>& u) { return turn_back_minus_one_scaled(x.w, x.y, epsilon, u); };
  const auto J = [&](const Vec3<T>& u) -> Vec3<T> {
    return R_ref * (model.I_BP_B_inverse * (R_ref.transpose() * u));
  };
  const auto turned_minus_one = [&](const Vec3<T>& u) { return turn_minus_one_scaled(turn.w, turn.v_scaled, epsilon, u); };

  const Vec3<T> w_ref_N = J(reference.m);
  const Vec3<T> L_rot_N = reference.m + epsilon * x.p;
  const Vec3<T> AT_L = A_transposed(L_rot_N);
  const Vec3<T> Dw_N = A(J(Vec3<T>(L_rot_N + epsilon * AT_L))) + J(Vec3<T>(AT_L + x.p));

  const Vec3<T> mr_ref_N = R_ref * model.mass_moment_B;
  Vec3<T> field_difference_N = turned_minus_one(field.rotating_L);
  if constexpr (K == SceneKind::full) field_difference_N += field.difference_L_scaled;
  const Vec3<T> field_rot_N = field.rotating_L + epsilon * turned_minus_one(field.rotating_L);
  Vec3<T> torque_difference_N =
      field_torque<T>(A(mr_ref_N), field_rot_N) + field_torque<T>(mr_ref_N, field_difference_N);
  if constexpr (K == SceneKind::full) {
    const Quaternion<T> q_rot = Quaternion<T>{x.w, epsilon * x.y} * reference.q;
    const Mat3<T> R_rot = rotation_matrix(q_rot);
    const Mat3<T> S_BP_N = R_rot * model.S_BP_B * R_rot.transpose();
    const Vec3<T> W_N = model.W_IL_L;  // the laboratory turns about W, which is the same vector in L and in N
    const Vec3<T> w_LB_N = w_ref_N + epsilon * Dw_N - W_N;
    torque_difference_N -= laboratory_torque<K>(model.weights.complement(), W_N, model.W_IL_L_scaled, w_LB_N, S_BP_N);
  }
  return {-epsilon * epsilon * x.y.dot(Dw_N) / T(2),
          w_ref_N.cross(x.y) + (x.w * Dw_N + epsilon * Dw_N.cross(x.y)) / T(2), torque_difference_N};
}

}  // namespace earthtop
