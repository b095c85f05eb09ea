// SPDX-License-Identifier: GPL-3.0-or-later
/// The swing of a gyrocompass: a balanced wheel whose axis a gimbal holds level, let go at rest on the turning Earth.
#pragma once

#include "closed_form/elliptic.hpp"

namespace earthtop {

/// With the angle a of the axis from North, the Earth's level rate W, and the spin w3 in space, which is kept,
///   I1 a'' = -sin(a) (I3 w3 W - I1 W^2 cos(a)).
/// The tangent of a/2 is that of half the amplitude times Jacobi's cn, whose quarter period is the complete elliptic integral.
/// At small amplitudes and rates the period is 2 pi sqrt(I1 / (I3 w3 W)).
class LevelCompass {
 public:
  /// @param directing  I3 w3 W / I1, more than level_rate^2 (1/s^2)   @param level_rate  W (rad/s)
  /// @param amplitude  angle from North at the release (rad), less than half a turn
  LevelCompass(double directing, double level_rate, double amplitude) : half_tangent_(tangent(amplitude / 2)) {
    const double cosine = real::cos(amplitude), square = half_tangent_ * half_tangent_, own = level_rate * level_rate;
    const double low = 2 * directing - own * (cosine + 1), high = (2 * directing - own * (cosine - 1)) * square;
    rate_ = real::sqrt((low + high) / (2 * (1 + square)));
    lattice_ = elliptic::lattice<double>(high / (low + high), low / (low + high));
  }
  double period_s() const { return 4 * lattice_.K / rate_; }
  double angle(double t_s) const {
    return 2 * real::atan2(half_tangent_ * elliptic::jacobi<double>(rate_ * t_s, lattice_).cn, 1.0);
  }

 private:
  static double tangent(double angle) { return real::sin(angle) / real::cos(angle); }

  double half_tangent_, rate_;
  elliptic::Lattice<double> lattice_;
};

}  // namespace earthtop
