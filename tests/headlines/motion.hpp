// SPDX-License-Identifier: GPL-3.0-or-later
/// The top in inertial axes: attitude and angular momentum about the pivot, integrated from dL/dt = torque alone; on a table
/// attitude, angular momentum about the centre of mass, and the path of the centre of mass. A rotor adds its momentum about its axis, which
/// only its bearing changes; masses that move in the body add theirs relative to it. In gimbals it is the two angles and their rates,
/// integrated from the accelerations.
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
  Real outer_angle = 0, inner_angle = 0, outer_rate = 0, inner_rate = 0;  ///< of gimbals (rad, rad/s)
  Real latitude = 0, longitude = 0, course = 0;                           ///< of a journey, less those at the start (rad)
};

/// The laboratory on its journey, in the inertial axes: from its place on the Earth, differentiated twice.
struct Travelling {
  Quat q_IL;
  Vec w_I, alpha_I;  ///< inertial rate, and its time derivative
  Vec falling_I;     ///< apparent gravity minus the acceleration over what an Earth-bound pivot has (m/s^2)
  Real latitude_rate, longitude_rate, course_rate;
};
/// @param rate  the Earth's
Travelling travelling(const Scene& scene, Real rate, Real t, const State& state);

/// One of the two predictions: for the Earth as it turns, or for one at rest.
class Motion {
 public:
  /// @param rotation_rate the Earth's (rad/s); 0 for the non-rotating prediction   @param travels  whether it makes the scene's journey
  Motion(const Scene& scene, Real rotation_rate, bool travels);

  const State& state() const { return state_; }
  bool on_table() const { return scene_->contact.has_value(); }
  bool has_rotor() const { return scene_->rotor.has_value(); }
  bool in_gimbals() const { return scene_->gimbals.has_value(); }
  Real time() const { return t_; }

  /// Tries a step of Gragg, Bulirsch and Stoer. @returns its error: the largest of the quaternion's, of the momenta's in units
  /// of `scale`, and of place and velocity in metres and metres per second; in gimbals of the angles and rates in rad and rad/s
  Real try_step(Real step, Real scale, State& result) const;
  void accept(Real t, const State& state) { t_ = t, state_ = state; }

  Quat q_LB() const;   ///< unit quaternion; its sign is continuous in time
  Vec w_LB_B() const;  ///< rad/s
  Vec w_IB_B() const;
  Real rotor_rate() const;  ///< relative to the body (rad/s)
  Vec rotor_axis_L() const { return matrix(q_LB()) * scene_->rotor->axis; }
  Vec tip_L() const;  ///< on a table: centre of the tip's sphere in laboratory axes (m)

 private:
  State slope(Real t, const State& state) const;  ///< time derivative of the state
  State slope_on_table(Real t, const State& state) const;
  /// The torque of what acts beside gravity, about the pivot, on a table about the centre of mass.   @param w  inertial rate;
  /// all in inertial axes
  Vec acting_torque_I(Real t, const Mat& R_IB, const Vec& w) const;
  State slope_in_gimbals(Real t, const State& state) const;
  /// How far a step may be off: the largest of the quantities that try_step names.
  Real size_of(const State& error, Real scale) const;
  Vec angular_velocity(Real t, const State& state) const;
  Real rotor_rate(Real t, const State& state) const;
  /// Axes and rates of all parts in gimbals.
  struct Posture {
    Mat R_PA, R_PB;    ///< from the axes of either gimbal into those of the laboratory or the platform
    Vec a, b;          ///< the outer and the inner axis, P axes, as all that follow
    Vec earth;         ///< the Earth's rate
    Vec carrier;       ///< inertial rate of P, the laboratory or the platform
    Vec carrier_rate;  ///< its inertial time derivative
    Vec w_A, w_B;      ///< inertial rates of both gimbals
  };
  Posture posture(Real t, const State& state) const;
  Vec falling_P(Real t, const State& state) const;  ///< falling_I in P axes (m/s^2)
  void release_in_gimbals();
  std::array<Real, 3> platform_turn(Real t) const;  ///< angle of the platform, its rate and acceleration; 0 without one
  Quat q_PB() const;                                ///< of the body in gimbals
  /// Apparent gravity minus the pivot's acceleration on its platform, in inertial axes (m/s^2).
  Vec falling_I(Real t, const State& state) const;
  /// Inertial rate of the reference's laboratory at release, in laboratory axes: rates are given relative to that.
  Vec reference_rate_L() const;
  bool travels() const { return travels_; }

  const Scene* scene_;
  Real rate_;
  bool travels_;
  Real t_ = 0;
  State state_;
};

}  // namespace headlines
