// SPDX-License-Identifier: GPL-3.0-or-later
/// The top in inertial axes: attitude and angular momentum about the pivot, dL/dt = torque, nothing else.
#pragma once

#include "scene.hpp"

namespace headlines {

/// Inertial axes are those of the laboratory at t = 0, with their origin carried along by the pivot.
struct State {
  Quat q_IB;
  Vec L_I;  ///< angular momentum about the pivot (kg m^2/s)
};

/// One of the two predictions: on the Earth as it turns, or on one that does not.
class Motion {
 public:
  /// @param rotation_rate  of the Earth (rad/s); 0: the non-rotating prediction
  Motion(const Scene& scene, Real rotation_rate);

  const State& state() const { return state_; }
  Real time() const { return t_; }

  /// Tries a step of Gragg, Bulirsch and Stoer. @returns its error: of the quaternion, or of L in units of `scale`.
  Real try_step(Real step, Real scale, State& result) const;
  void accept(Real t, const State& state) { t_ = t, state_ = state; }

  Quat q_LB() const;   ///< unit; its sign follows the motion without a jump
  Vec w_LB_B() const;  ///< rad/s
  Vec w_IB_B() const { return angular_velocity(state_); }

 private:
  State slope(Real t, const State& state) const;  ///< its time derivative
  Vec angular_velocity(const State& state) const;
  /// Apparent gravity less the pivot's acceleration on its platform, inertial axes (m/s^2).
  Vec falling_I(Real t) const;

  const Scene* scene_;
  Real rate_;
  Real t_ = 0;
  State state_;
};

}  // namespace headlines
