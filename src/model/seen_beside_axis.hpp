// SPDX-License-Identifier: GPL-3.0-or-later
/// A symmetric top's axis sees this around it in the rotating motion alone.
#pragma once

#include "earthtop/model/reduced_torques.hpp"
#include "model/applied_motion.ipp"

namespace earthtop {

/// Sets the directions of the torques that act, and the rate of the carrier where anything rubs; in the axes of the integration.
template <class T>
void see_rotating_motion(const ReducedTop<T>& top, const Model<T>& model, const T& t, SeenBesideAxis<T>& seen) {
  if (model.journey.empty()) {
    see_torques(
        top, model, t, [](const Vec3<T>& u_L) { return u_L; }, seen);
    if (model.applied.friction()) seen.w_IP = applied_motion::Carrier<T>(model.platform, t).w_LP_L + model.W_IL_L;
    return;
  }
  if (!model.applied.any) return;
  const auto rotating = [&](const Vec3<T>& u_A, const Vec3<T>& change_A) { return Vec3<T>(u_A + model.epsilon * change_A); };
  const applied_motion::SeeOnJourney<T, decltype(rotating)> see{LaboratoryAxes<T>(model.journey, t), model.epsilon, rotating};
  const Vec3<T> unchanged = Vec3<T>::Zero();
  see_torques(
      top, model, t, [&](const Vec3<T>& u_L) { return see(u_L, unchanged); }, seen);
  if (model.applied.friction()) seen.w_IP = applied_motion::carrier_rate(model, t, see);
}

}  // namespace earthtop
