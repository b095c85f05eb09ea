// SPDX-License-Identifier: GPL-3.0-or-later
/// Implementation of the applied torques on a motion, for the scalar types of applied_motion.cpp and for the one that
/// records operations.
#pragma once

#include "earthtop/model/applied_motion.hpp"

namespace earthtop {
namespace applied_motion {

/// How the platform moves in a laboratory without a journey.
template <class T>
struct Carrier {
  Vec3<T> w_LP_L = Vec3<T>::Zero(), alpha_LP_L = Vec3<T>::Zero(), up_P_L = Vec3<T>::UnitZ();

  Carrier(const Platform<T>& platform, T t) {
    const PrescribedMotion<T>& turn = platform.turn;
    if (turn.angle0 == T(0) && turn.rate == T(0) && turn.acceleration == T(0) && turn.amplitude == T(0) && !turn.table) return;
    w_LP_L = turn.angle_rate(t) * turn.axis;
    alpha_LP_L = turn.angle_acceleration(t) * turn.axis;
    up_P_L = turn_matrix(turn.axis, turn.angle(t)).col(2);
  }
};

/// Sees vectors of a laboratory on a journey from its axes A: takes them there, and hands them on.
template <class T, class See>
struct SeeOnJourney {
  LaboratoryAxes<T> axes;
  const T& epsilon;
  const See& see;

  auto operator()(const Vec3<T>& u_L, const Vec3<T>& change_L) const {
    return see(axes.reference(u_L), axes.difference(u_L, change_L, epsilon));
  }
  auto operator()(const Vec3<Paired<T>>& u_L) const {
    return (*this)(parts(u_L, &Paired<T>::ref), parts(u_L, &Paired<T>::diff));
  }
};
/// The inertial rate of the carrier as a body sees it.
template <class T, class See>
auto carrier_rate(const Model<T>& model, const T& t, const SeeOnJourney<T, See>& see) {
  return see(CarrierTurning<T>(LaboratoryTurning<T>(model, see.axes, t), model.platform.turn, t).w_IP_L);
}

/// Sets the directions of the torques that act, and the given torque.
template <class S, class T, class See>
void see_directions(const AppliedTorques<T>& applied, const T& t, const See& see, SeenFromBody<S>& seen) {
  const Vec3<T> unchanged = Vec3<T>::Zero();
  for (std::size_t i = 0; i < 2; ++i)
    if (applied.gradient[i].strength != T(0)) seen.gradient_B[i] = see(applied.gradient[i].direction_L, unchanged);
  if (applied.support.acts())
    seen.east_B = see(Vec3<T>(Vec3<T>::UnitX()), unchanged), seen.north_B = see(Vec3<T>(Vec3<T>::UnitY()), unchanged);
  if (!applied.given.acts) return;
  const Vec3<T> given = applied.given.at(t);
  seen.given_B = applied.given.in_laboratory ? see(given, unchanged) : Vec3<S>(S(given[0]), S(given[1]), S(given[2]));
}

/// @param see  see(u_L, change_L) gives the body's view of a vector, from its value u_L for the reference and its change by the
/// Earth's rate over epsilon
template <class S, class T, class See>
SeenFromBody<S> seen_from_body(const Model<T>& model, T t, const Vec3<S>& w_IB_B, const See& see) {
  const AppliedTorques<T>& applied = model.applied;
  SeenFromBody<S> seen;
  seen.w_IB_B = w_IB_B;
  if (!model.journey.empty()) {
    const SeeOnJourney<T, See> from_L{LaboratoryAxes<T>(model.journey, t), model.epsilon, see};
    seen.w_IP_B = carrier_rate(model, t, from_L);
    see_directions(applied, t, from_L, seen);
    return seen;
  }
  const Carrier<T> carrier(model.platform, t);
  const Vec3<T> unchanged = Vec3<T>::Zero();
  seen.w_IP_B = see(carrier.w_LP_L, model.W_IL_L_scaled);
  see_directions(applied, t, see, seen);
  if (!applied.level_axis) return seen;
  seen.up_P_B = see(carrier.up_P_L, unchanged);
  // The derivative of W + w_LP in inertial space: the rotating laboratory carries the platform's rate round.
  seen.alpha_IP_B = see(carrier.alpha_LP_L, model.W_IL_L_scaled.cross(carrier.w_LP_L));
  const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
  const Vec3<S> field_B = see(field.reference_L, field.difference_L_scaled);
  const Vec3<S> mass_moment_B = Vec3<S>(S(model.mass_moment_B[0]), S(model.mass_moment_B[1]), S(model.mass_moment_B[2]));
  seen.other_torque_B = mass_moment_B.cross(field_B);
  return seen;
}

/// The torques of [F] (torques.hpp) that a scene leaves out, as the applied torques that cancel them; the gimbal needs them. If
/// nothing is left out they are zero, but their derivatives with respect to the weights are not.
template <class T>
Vec3<T> left_out_torque(const Model<T>& model, const Vec3<T>& W_B, const Vec3<T>& W_B_scaled, const Vec3<T>& w_LB_B) {
  return -laboratory_torque<SceneKind::full>(model.weights.complement(), W_B, W_B_scaled, w_LB_B, model.S_BP_B);
}

template <class T, class S>
Vec3<S> torque_of(const Model<T>& model, const SeenFromBody<S>& seen) {
  // A gradient takes hold of all mass: of a free rotor's axial moment, too.
  return applied_torque(model.applied, inertia_of_all(model), model.I_BP_B_inverse, seen);
}

}  // namespace applied_motion

template <class T>
Vec3<T> applied_torque_B(const Model<T>& model, T t, const Quaternion<T>& q_LB, const Vec3<T>& w_LB_B, bool earth) {
  const Mat3<T> R_LB = rotation_matrix(q_LB);
  const T epsilon = earth ? model.epsilon : T(0);
  const auto see = [&](const Vec3<T>& u_L, const Vec3<T>& change_L) {
    return transposed_times(R_LB, Vec3<T>(u_L + epsilon * change_L));
  };
  const Vec3<T> W_B = see(Vec3<T>::Zero(), model.W_IL_L_scaled);  // computed as for the platform, so that a body at rest feels
                                                                  // no friction
  auto seen = applied_motion::seen_from_body<T>(model, t, Vec3<T>(w_LB_B + W_B), see);
  if (model.applied.level_axis) seen.other_torque_B += applied_motion::left_out_torque(model, W_B, W_B, w_LB_B);
  return applied_motion::torque_of(model, seen);
}

template <class T>
Vec3<Paired<T>> applied_torques_B(const Model<T>& model, T t, const Quaternion<T>& ref_q_LB, const Vec3<T>& ref_w_LB_B, T e_w,
                                  const Vec3<T>& e_v_scaled, const Vec3<T>& Dw_IB_B_scaled) {
  const Mat3<T> R_ref = rotation_matrix(ref_q_LB);
  const T epsilon = model.epsilon;
  const auto turned_back = [&](const Vec3<T>& u_B) { return turn_back_minus_one_scaled(e_w, e_v_scaled, epsilon, u_B); };
  const auto see = [&](const Vec3<T>& u_L, const Vec3<T>& change_L) {
    const Vec3<T> u_B = transposed_times(R_ref, u_L), change_B = transposed_times(R_ref, change_L);
    return paired_vector(u_B, Vec3<T>(turned_back(u_B) + change_B + epsilon * turned_back(change_B)), epsilon);
  };
  auto seen = applied_motion::seen_from_body<Paired<T>>(model, t, paired_vector(ref_w_LB_B, Dw_IB_B_scaled, epsilon), see);
  if (model.applied.level_axis) {
    const Vec3<T> W_ref_B_scaled = transposed_times(R_ref, model.W_IL_L_scaled);
    const Vec3<T> W_B_scaled = W_ref_B_scaled + epsilon * turned_back(W_ref_B_scaled), W_B = epsilon * W_B_scaled;
    const Vec3<T> w_LB_B = ref_w_LB_B + epsilon * Dw_IB_B_scaled - W_B;
    const Vec3<T> zero = Vec3<T>::Zero();
    seen.other_torque_B += paired_vector(zero, applied_motion::left_out_torque(model, W_B, W_B_scaled, w_LB_B), epsilon);
  }
  return applied_motion::torque_of(model, seen);
}

}  // namespace earthtop
