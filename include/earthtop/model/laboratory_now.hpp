// SPDX-License-Identifier: GPL-3.0-or-later
/// The laboratory of the rotating motion at one instant, at rest on the Earth or on a journey.
#pragma once

#include "earthtop/model/applied_motion.hpp"
#include "earthtop/model/equations.hpp"

namespace earthtop {

template <class T>
struct LaboratoryNow {
  Vec3<T> w_IL_L;      ///< its inertial rate
  Vec3<T> w_EL_L;      ///< its rate over the Earth: the transport rate
  Vec3<T> alpha_IL_L;  ///< the derivative of that, as L or inertial space sees it
  Vec3<T> field_L;     ///< the acceleration field at the pivot: what takes the place of apparent gravity
  Mat3<T> R_NL;        ///< attitude in inertial axes parallel to L at the release
  Quaternion<T> q_AL;  ///< in the axes of the integration (journey.hpp)
  Vec3<T> w_AL_L;

  LaboratoryNow(const Model<T>& model, const T& t) {
    const PivotField<T> field = pivot_field<SceneKind::full>(model, t);
    const Mat3<T> R_NA = rotation_matrix(laboratory_turn(model, t).quaternion(model.epsilon));
    if (model.journey.empty()) {
      w_IL_L = model.W_IL_L, w_EL_L = alpha_IL_L = w_AL_L = Vec3<T>::Zero();
      field_L = field.rotating_L;
      R_NL = R_NA;
      return;
    }
    const LaboratoryAxes<T> axes(model.journey, t);
    const LaboratoryTurning<T> turning(model, axes, t);
    w_IL_L = parts(turning.w_IL_L, &Paired<T>::rot), alpha_IL_L = parts(turning.alpha_IL_L, &Paired<T>::rot);
    w_EL_L = parts(Vec3<Paired<T>>(turning.w_IL_L - turning.earth_L), &Paired<T>::rot);
    w_AL_L = w_IL_L - model.epsilon * turning.W_L_scaled;
    field_L = parts(axes.into_L(field.reference_L, field.difference_L_scaled, model.epsilon), &Paired<T>::rot);
    q_AL = model.journey.attitude(t, true);
    R_NL = R_NA * rotation_matrix(q_AL);
  }
};

/// How the laboratory of one of the two motions turns in space, and what takes the place of apparent gravity in it, for a pivot that no
/// platform carries.
template <class T>
struct LaboratoryOf {
  Vec3<T> w_IL_L, gravity_L;

  LaboratoryOf(const Model<T>& model, const T& t, bool rotating)
      : w_IL_L(rotating ? model.W_IL_L : Vec3<T>(Vec3<T>::Zero())), gravity_L(model.apparent_gravity_L) {
    if (model.journey.empty()) return;
    const auto motion = rotating ? &Paired<T>::rot : &Paired<T>::ref;
    const LaboratoryAxes<T> axes(model.journey, t);
    const PivotField<T> field = field_on_journey(model, t);
    w_IL_L = parts(LaboratoryTurning<T>(model, axes, t).w_IL_L, motion);
    gravity_L = parts(axes.into_L(field.reference_L, field.difference_L_scaled, model.epsilon), motion);
  }
};

/// The applied torque on the rotating motion, in body axes, from what its laboratory sees.
template <class T>
Vec3<T> applied_torque_seen_from(const LaboratoryNow<T>& laboratory, const Model<T>& model, T t, const Quaternion<T>& q_LB,
                                 const Vec3<T>& w_LB_B) {
  if (model.journey.empty()) return applied_torque_B(model, t, q_LB, w_LB_B, true);
  return applied_torque_B(model, t, laboratory.q_AL * q_LB,
                          Vec3<T>(w_LB_B + transposed_times(rotation_matrix(q_LB), laboratory.w_AL_L)), true);
}

}  // namespace earthtop
