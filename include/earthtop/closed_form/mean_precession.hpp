// SPDX-License-Identifier: GPL-3.0-or-later
/// The mean rates of a heavy symmetric top without Earth rotation, as functions of what it conserves.
#pragma once

#include <optional>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

/// The constants that the motion of the axis depends on, over I1 (the moment about the pivot across the axis).
struct TopConstants {
  double energy = 0;    ///< energy without that of the spin about the axis, times 2/I1: |u|^2 + gravity cos(tilt) (1/s^2)
  double vertical = 0;  ///< component of the angular momentum along Up, over I1 (rad/s)
  double axial = 0;     ///< the same along the axis (rad/s)
  double gravity = 0;   ///< 2 m g l / I1 (1/s^2)
};

/// @param w_B  rate in body axes (rad/s)
inline TopConstants top_constants(const SymmetricTop<double>& top, const Quaternion<double>& q_LB, const Vec3<double>& w_B) {
  const double axial = top.I3 / top.I1 * w_B[2], gravity = 2 * top.mgl / top.I1;
  const Mat3<double> R_LB = rotation_matrix(q_LB);
  return {w_B[0] * w_B[0] + w_B[1] * w_B[1] + gravity * R_LB(2, 2),
          R_LB(2, 0) * w_B[0] + R_LB(2, 1) * w_B[1] + R_LB(2, 2) * axial, axial, gravity};
}

struct MeanRates {
  double precession_rad_s = 0;  ///< mean rate of the axis's azimuth, counterclockwise about Up
  double nutation_rad_s = 0;    ///< 2 pi over the period of the tilt
  int terms = 0;  ///< steps within half a period that the means took: the more, the less the motion is like a sine
};

/// With u = cos(tilt), (du/dt)^2 = (1 - u^2)(energy - gravity u) - (vertical - axial u)^2 and the azimuth's rate is
/// (vertical - axial u) / (1 - u^2) [L. D. Landau and E. M. Lifshitz, Mechanics, section 35]. The means over a period are
/// integrals of periodic functions, which sums of equal steps give with an error that falls exponentially. They are analytic in
/// the constants also where the tilt does not change, so that they can be differentiated there.
/// @returns nothing where the period is infinite or an axis goes through the vertical, so that the sums do not converge
std::optional<MeanRates> mean_rates(const TopConstants& constants);

}  // namespace earthtop
