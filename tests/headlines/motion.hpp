// SPDX-License-Identifier: GPL-3.0-or-later
/// The top in inertial axes: attitude and angular momentum about the pivot, integrated from dL/dt = torque alone; on a table
/// attitude, angular momentum about the centre of mass, and the path of the centre of mass. A rotor adds its momentum about its axis, which
/// only its bearing changes.
#pragma once

#include "scene.hpp"

namespace headlines {

/// Attitude and angular momentum in inertial axes: those of the laboratory at t = 0, with their origin at the moving pivot.
struct State {
  Quat q_IB;
  Vec L_I;                  ///< angular momentum about the pivot, on a table about the centre of mass (kg m^2/s)
  Vec X_I;                  ///< on a table: centre of mass from the laboratory's origin (m)
  Vec V_I;                  ///< its time derivative (m/s)
  Real rotor_momentum = 0;  ///< inertial, about the rotor's axis (kg m^2/s)
  Real rotor_angle = 0;     ///< relative to the body (rad)
};

/// One of the two predictions: for the Earth as it turns, or for one at rest.
class Motion {
 public:
  /// @param rotation_rate the Earth's (rad/s); 0 for the non-rotating prediction
  Motion(const Scene& scene, Real rotation_rate);

  const State& state() const { return state_; }
  bool on_table() const { return scene_->contact.has_value(); }
  bool has_rotor() const { return scene_->rotor.has_value(); }
  Real time() const { return t_; }

  /// Tries a step of Gragg, Bulirsch and Stoer. @returns its error: the largest of the quaternion's, of the momenta's in units
  /// of `scale`, and of place and velocity in metres and metres per second
  Real try_step(Real step, Real scale, State& result) const;
  void accept(Real t, const State& state) { t_ = t, state_ = state; }

  Quat q_LB() const;   ///< unit quaternion; its sign is continuous in time
  Vec w_LB_B() const;  ///< rad/s
  Vec w_IB_B() const { return angular_velocity(state_); }
  Real rotor_rate() const { return rotor_rate(state_); }  ///< relative to the body (rad/s)
  Vec rotor_axis_L() const { return matrix(q_LB()) * scene_->rotor->axis; }
  Vec tip_L() const;  ///< on a table: centre of the tip's sphere in laboratory axes (m)

 private:
  State slope(Real t, const State& state) const;  ///< time derivative of the state
  State slope_on_table(Real t, const State& state) const;
  Vec angular_velocity(const State& state) const;
  Real rotor_rate(const State& state) const;
  /// Apparent gravity minus the pivot's acceleration on its platform, in inertial axes (m/s^2).
  Vec falling_I(Real t) const;

  const Scene* scene_;
  Real rate_;
  Real t_ = 0;
  State state_;
};

}  // namespace headlines
