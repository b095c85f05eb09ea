// SPDX-License-Identifier: GPL-3.0-or-later
/// The swing of a pendulum at one instant: the semi-axes and the azimuth of its ellipse.
#pragma once

#include <optional>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

/// The ellipse of a swing. A symmetric body whose centre of mass hangs below the pivot goes to and fro between an outer and an inner
/// inclination, and the azimuth of its outermost places advances from swing to swing. Inclinations are those of the line from the pivot to
/// the centre of mass, from Down.
template <class T>
struct Swing {
  T major_rad = T(0);  ///< outer inclination
  T minor_rad =
      T(0);  ///< inner inclination, positive where the swing goes round clockwise, seen from above, and negative otherwise
  /// Compass azimuth of the outermost place, from 0 to pi: the swing has it on both sides. Between two outermost places it goes evenly
  /// from one to the other. None where the pendulum goes round in a circle.
  std::optional<T> azimuth_rad;
  T apsidal_rate_rad_s = T(0);  ///< mean rate of that azimuth, clockwise, as long as nothing disturbs the motion
};

/// The swing that a body without disturbances would go on with from a state: a function of the state alone, of which an undisturbed motion
/// has the same semi-axes at all times.
///   With x = 1 - cos(inclination), (dx/dt)^2 = (2 x - x^2)(e - G x) - (v + b x)^2 = G (x - x1)(x2 - x)(x3 - x), and the azimuth's rate is
/// (v + b x)/(2 x - x^2), counterclockwise [L. D. Landau and E. M. Lifshitz, Mechanics, section 35]. Of its integral the part with 1/x is an
/// arc tangent; what is left has no peak where the pendulum passes close to the vertical.
/// @param n_L, n_rate_L  body axis 3 in the laboratory, and its rate there (1/s)   @param spin_rad_s  component of the body's rate along it
/// @param up_rad_s  rate at which the laboratory itself turns about Up. The swing is that relative to axes that do not turn about the
/// vertical, as they are now: so both semi-axes are the inclinations where the pendulum turns back and where it passes the middle, and
/// the Earth changes them by parts of the order of its northward rate alone.
/// @returns nothing without gravity's torque, where the body never comes below the pivot's height, and where it goes over the top, or nearly so
template <class T>
std::optional<Swing<T>> swing_of(const SymmetricTop<T>& top, const Vec3<T>& n_L, const Vec3<T>& n_rate_L, T spin_rad_s,
                                 T up_rad_s);

extern template std::optional<Swing<double>> swing_of(const SymmetricTop<double>&, const Vec3<double>&, const Vec3<double>&,
                                                      double, double);
extern template std::optional<Swing<float128>> swing_of(const SymmetricTop<float128>&, const Vec3<float128>&,
                                                        const Vec3<float128>&, float128, float128);

}  // namespace earthtop
