// SPDX-License-Identifier: GPL-3.0-or-later
/// The top in inertial axes: attitude and angular momentum about the pivot, integrated from dL/dt = torque alone.
#pragma once

#include "scene.hpp"

namespace headlines {

/// Attitude and angular momentum in inertial axes: those of the laboratory at t = 0, with their origin at the moving pivot.
struct State {
  Quat q_IB;
  Vec L_I;  ///< angular momentum about the pivot (kg m^2/s)
};

/// One of the two predictions: for the Earth as it turns, or for one at rest.
class Motion {
 public:
  /// @param rotation_rate the Earth's (rad/s); 0 for the non-rotating prediction
  Motion(const Scene& scene, Real rotation_rate);

  const State& state() const { return state_; }
  Real time() const { return t_; }

  /// Tries a step of Gragg, Bulirsch and Stoer. @returns its error: the larger of the quaternion's, and of L's in units of
  /// `scale`
  Real try_step(Real step, Real scale, State& result) const;
  void accept(Real t, const State& state) { t_ = t, state_ = state; }

  Quat q_LB() const;   ///< unit quaternion; its sign is continuous in time
  Vec w_LB_B() const;  ///< rad/s
  Vec w_IB_B() const { return angular_velocity(state_); }

 private:
  State slope(Real t, const State& state) const;  ///< time derivative of the state
  Vec angular_velocity(const State& state) const;
  /// Apparent gravity minus the pivot's acceleration on its platform, in inertial axes (m/s^2).
  Vec falling_I(Real t) const;

  const Scene* scene_;
  Real rate_;
  Real t_ = 0;
  State state_;
};

}  // namespace headlines
