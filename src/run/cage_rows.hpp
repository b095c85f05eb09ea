// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes rows of a symmetric cage with its rotor from those of the rigid top that moves as its axis does (scene/caged_top.hpp).
#pragma once

#include "earthtop/drift/drift.hpp"
#include "run/row_vectors.hpp"
#include "scene/caged_top.hpp"

namespace earthtop {

template <class T>
class CageRows {
 public:
  explicit CageRows(const Scenario& scenario) : top_(scenario) {}

  /// Turns both attitudes and rates to those of the cage, and adds the rotor. Its axis is that of the top; its rate and its angle are the
  /// same in both predictions.
  void complete(BasicDriftRow<T>& row) const {
    turn(row.t_s, row.q_LB, row.w_LB_B);
    turn(row.t_s, row.ref_q_LB, row.ref_w_LB_B);
    BasicRotorRow<T>& rotor = row.rotor.emplace();
    rotor.rate_rad_s = rotor.ref_rate_rad_s = top_.rotor_rate(row.t_s);
    rotor.angle_rad = rotor.ref_angle_rad = top_.rotor_angle(row.t_s);
    rotor.axis_L = row.axis_L, rotor.ref_axis_L = row.ref_axis_L;
    rotor.drift_axis_rad = row.drift_axis_rad, rotor.drift_axis_bound_rad = row.drift_axis_bound_rad;
  }

 private:
  void turn(const T& t_s, std::array<T, 4>& q_LB, std::array<T, 3>& w_LB_B) const {
    const SinCos<T> half = real::sin_cos(T(top_.beside_angle(t_s) / T(2)));
    q_LB = to_array(quaternion_of(q_LB) * Quaternion<T>{half.cos, Vec3<T>(T(0), T(0), half.sin)});
    w_LB_B = to_array(top_.rate_of_cage(Vec3<T>(w_LB_B[0], w_LB_B[1], w_LB_B[2]), t_s));
  }
  CagedTop<T> top_;
};

}  // namespace earthtop
