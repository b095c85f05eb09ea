// SPDX-License-Identifier: GPL-3.0-or-later
/// A run's report on the motions themselves: the spin at the end, when spin and tilt come to given values, the swing of a pendulum.
#pragma once

#include <algorithm>

#include "earthtop/run.hpp"
#include "earthtop/vectors.hpp"
#include "run/largest_drift.hpp"

namespace earthtop {

/// Bounds on the errors of both motions, largest of all looks: a multiple of the distance to the second integration, and rounding.
struct MotionBounds {
  double attitude_rad = 0;
  double rate_rad_s = 0;  ///< of the whole rate
  double spin_rad_s = 0;  ///< of its component along axis 3

  /// Takes the distance of a rate to that of the second integration, which may have none: points side by side follow angles alone there.
  template <class T>
  void include(const Vec3<T>& w_B, const Vec3<T>& other_B) {
    if (norm(other_B) == T(0) && norm(w_B) > T(0)) has_rates_ = false;
    rate_rad_s = std::max(rate_rad_s, static_cast<double>(norm(Vec3<T>(w_B - other_B))));
    spin_rad_s = std::max(spin_rad_s, static_cast<double>(real::abs(w_B[2] - other_B[2])));
    fastest_rad_s_ = std::max(fastest_rad_s_, static_cast<double>(norm(w_B)));
  }
  /// @param safety  multiplies the distances   @param turning_rad_s  what rounding may have added to rates
  /// @param natural_rad_s  the fastest rate of the scene: where there are no other rates, angles that are off turn with it
  void complete(int safety, double attitude_bound_rad, double turning_rad_s, double natural_rad_s) {
    constexpr double kRounding = 64 * 0x1p-53;
    attitude_rad = attitude_bound_rad;
    for (double* bound : {&rate_rad_s, &spin_rad_s})
      *bound = (has_rates_ ? safety * *bound : attitude_rad * std::max(natural_rad_s, fastest_rad_s_)) + turning_rad_s +
               kRounding * fastest_rad_s_;
  }

 private:
  double fastest_rad_s_ = 0;
  bool has_rates_ = true;
};

/// @param result  has rows, looks and its reached time
MotionReport motion_report(const LookSource& source, const MotionBounds& bounds, const RunResult& result);

}  // namespace earthtop
