// SPDX-License-Identifier: GPL-3.0-or-later
/// A symmetric cage with its rotor along the axis, and the rigid top that moves as it does (is_caged_top). With C the rotor's axial
/// moment, I3 that of both and s the rotor's rate relative to the cage, the momentum along the axis L = I3 w3 + C s does not depend on
/// what bearing or motor do, w3 being the cage's inertial rate. The rigid top of the same moments has the rate L / I3 = w3 + (C / I3) s.
/// Beside it the cage turns about the axis by -(C / I3) times the rotor's angle. As s is the same in both predictions, so is this turn:
/// no measure of the drift depends on it.
#pragma once

#include "earthtop/model/gyrostat.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

template <class T>
class CagedTop {
 public:
  explicit CagedTop(const Scenario& scenario);

  /// The release of the rigid top.   @param gravity  (m/s^2)   @throws ScenarioError where a steady precession does not exist
  Release<T> release(T gravity) const;
  /// The rotor's rate relative to the cage (rad/s), and its angle since the release (rad), after the time t (s).
  T rotor_rate(T t) const;
  T rotor_angle(T t) const;
  /// The cage's rate beside that of the rigid top (rad/s), and the angle by which it has turned beside it (rad).
  T beside_rate(T t) const { return share_ * rotor_rate(t); }
  T beside_angle(T t) const { return share_ * rotor_angle(t); }
  /// The cage's rate along its own axes, of the rigid top's along its own (rad/s).
  Vec3<T> rate_of_cage(const Vec3<T>& w_B, T t) const {
    const SinCos<T> turn = real::sin_cos(beside_angle(t));
    return {turn.cos * w_B[0] + turn.sin * w_B[1], turn.cos * w_B[1] - turn.sin * w_B[0], w_B[2] + beside_rate(t)};
  }

 private:
  const ReleaseSpec release_;
  const RotorSpec spec_;
  Body<T> rigid_;
  Rotor<T> rotor_;
  T slowing_;  ///< rate at which the bearing slows the rotor (1/s)
  T share_;    ///< -C / I3
};
extern template class CagedTop<double>;
extern template class CagedTop<float80>;
extern template class CagedTop<float128>;

}  // namespace earthtop
