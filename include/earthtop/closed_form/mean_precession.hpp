// SPDX-License-Identifier: GPL-3.0-or-later
/// The mean rates of a heavy symmetric top without Earth rotation, as functions of what it conserves.
#pragma once

#include <optional>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

/// The constants that the motion of the axis depends on, over I1 (the moment about the pivot across the axis).
template <class T>
struct BasicTopConstants {
  /// Energy and angular momentum beside those of an axis at rest on a pole: next to it they are far smaller than what they are
  /// differences of.
  struct Pole {
    T energy = T(0);    ///< energy without that of the spin, less that on the pole, times 2/I1 (1/s^2)
    T vertical = T(0);  ///< component of the angular momentum along Up, less that on the pole (rad/s)
  };

  T axial = T(0);    ///< component of the angular momentum along the axis (rad/s)
  T gravity = T(0);  ///< 2 m g l / I1 (1/s^2)
  Pole up, down;

  T energy() const { return up.energy + gravity; }    ///< |dn/dt|^2 + gravity cos(tilt)
  T vertical() const { return up.vertical + axial; }  ///< component of the angular momentum along Up
};
using TopConstants = BasicTopConstants<double>;

/// A change of the constants, but for gravity; its members are the changes of energy(), vertical() and axial.
struct TopConstantsChange {
  double energy = 0, vertical = 0, axial = 0;
};
inline TopConstants moved(TopConstants c, const TopConstantsChange& change, double times = 1) {
  c.axial += times * change.axial;
  c.up.energy += times * change.energy, c.down.energy += times * change.energy;
  c.up.vertical += times * (change.vertical - change.axial), c.down.vertical += times * (change.vertical + change.axial);
  return c;
}

/// @param w_B  rate in body axes (rad/s)
template <class T>
BasicTopConstants<T> top_constants(const SymmetricTop<T>& top, const Quaternion<T>& q_LB, const Vec3<T>& w_B) {
  const T axial = top.I3 / top.I1 * w_B[2], gravity = T(2) * top.mgl / top.I1;
  const Mat3<T> R_LB = rotation_matrix(q_LB);
  const T square = w_B[0] * w_B[0] + w_B[1] * w_B[1], across = R_LB(2, 0) * w_B[0] + R_LB(2, 1) * w_B[1];
  // 1 - cos(tilt) and 1 + cos(tilt)
  const T leaning = q_LB.v[0] * q_LB.v[0] + q_LB.v[1] * q_LB.v[1], upright = q_LB.w * q_LB.w + q_LB.v[2] * q_LB.v[2];
  const T from_up = T(2) * leaning / (leaning + upright), from_down = T(2) * upright / (leaning + upright);
  return {axial,
          gravity,
          {square - gravity * from_up, across - axial * from_up},
          {square + gravity * from_down, across + axial * from_down}};
}

struct MeanRates {
  double precession_rad_s = 0;        ///< mean rate of the axis's azimuth, counterclockwise about Up
  double precession_bound_rad_s = 0;  ///< on its error, for exactly these constants
  double nutation_rad_s = 0;          ///< 2 pi over the period of the tilt
  /// How many parts of half a period resolve the azimuth: the more, the less the motion is like a sine. It is infinite on the vertical.
  double parts = 0;
  /// Whether the axis passes so near the vertical that its azimuth turns as good as in a jump.
  bool jumps() const { return parts > 1 << 14; }
};

/// With u = cos(tilt), (du/dt)^2 = (1 - u^2)(energy - gravity u) - (vertical - axial u)^2 and the azimuth's rate is
/// (vertical - axial u) / (1 - u^2) [L. D. Landau and E. M. Lifshitz, Mechanics, section 35]. The means over a period are
/// integrals of periodic functions, which sums of equal steps give with an error that falls exponentially. Of the azimuth half a
/// turn for each pole is taken out, so that what is summed has no peak where the axis passes a pole. The means are analytic in the
/// constants also where the tilt does not change, so that they can be differentiated there.
/// @returns nothing where the period is infinite, the axis goes through the vertical, or there is no torque of gravity
std::optional<MeanRates> mean_rates(const BasicTopConstants<float128>& constants);
std::optional<MeanRates> mean_rates(const TopConstants& constants);

}  // namespace earthtop
