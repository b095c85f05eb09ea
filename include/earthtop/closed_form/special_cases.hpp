// SPDX-License-Identifier: GPL-3.0-or-later
/// Motions given by elementary functions: steady precession, the two separatrices, the exact transformation to the laboratory
/// that rotates with the Earth, and their consequences for gyroscopes, sleeping tops and pendulums.
#pragma once

#include <optional>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

// --- Steady precession -------------------------------------------------------------------------------------------------

/// The two rates (rad/s, counterclockwise about Up) at which a symmetric top precesses at a constant tilt.
template <class T>
struct PrecessionRates {
  T slow;
  T fast;  ///< infinite at a tilt of exactly 90 deg
};
/// The roots of I1 cos(tilt) x^2 - I3 w3 x + mgl = 0 [Landau and Lifshitz, Mechanics, section 35], both computed without
/// cancellation. Nothing if the spin is too slow for this tilt. Relative error: 4 eps, plus eps times the condition number of
/// the root.
/// @param w3  component of the rate along the axis (rad/s)
template <class T>
std::optional<PrecessionRates<T>> steady_precession_rates(const SymmetricTop<T>& top, T w3, T cos_tilt);

/// Steady precession from any attitude, at any tilt: exp(z Omega t) q0 exp(e3 sigma t), sigma = w3 - Omega cos(tilt). It is the
/// motion of a top if `precession_rate` is one of its rates at this tilt, and of a free symmetric body if L points along z.
/// Error: 16 eps, plus 8 eps of Wider<T> (the next wider scalar type) for each radian swept.
template <class T>
ClosedFormState<T> steady_precession(const Quaternion<T>& q0_NB, T precession_rate, T w3, T t_s);

// --- Separatrices ------------------------------------------------------------------------------------------------------

/// The spin (rad/s) above which the upright top is stable ("sleeps"): 2 sqrt(I1 mgl) / I3; requires mgl >= 0. [Kibble and
/// Berkshire, Classical Mechanics, eq. 12.26]
template <class T>
T critical_spin(const SymmetricTop<T>& top) {
  return T(2) * real::sqrt(top.I1) * real::sqrt(top.mgl) / top.I3;
}
/// Growth rate (1/s) of a small tilt of the upright top: sqrt(mgl/I1) sqrt(1 - f^2), f = w3 / critical spin; 0 for f >= 1.
template <class T>
T upright_growth_rate(const SymmetricTop<T>& top, T w3);

/// The motion that leaves the upright position in the infinite past and returns to it in the infinite future; it exists for
/// |w3| below the critical spin and mgl > 0. For w3 = 0 it is the separatrix of the plane pendulum. With f = w3 / critical
/// spin, k = sqrt(1 - f^2),
/// omega = sqrt(mgl / I1) and g = omega k, q_NB = (w, x, y, z) is
///   w + i z = exp(i (f omega t - delta)) (f + i k tanh(g t)),  x + i y = k sech(g t) exp(i delta),
///   delta = (I3 / I1 - 1) w3 t / 2:
/// cos(tilt) = 1 - 2 k^2 sech^2(g t) [E. T. Whittaker, Analytical Dynamics, section 71, for the cubic with a double root]. The
/// lowest point is passed at t = 0; for f > 0 the axis then points South.
template <class T>
ClosedFormState<T> homoclinic_top(const SymmetricTop<T>& top, T w3, T t_s);

/// The separatrix of the free body: moments in ascending order along axes 1, 2, 3 (kg m^2), L along axis z of N. The rate goes
/// from -w2 e2 to w2 e2. With p = w2 sqrt((I3 - I2)(I2 - I1) / (I1 I3)) and x = p t
///   w = w2 (sqrt(I2 (I3-I2) / (I1 (I3-I1))) sech x, tanh x, sqrt(I2 (I2-I1) / (I3 (I3-I1))) sech x),
/// and since axis 2 precesses about L at the constant rate w2 while the body does not turn about axis 2,
///   R_NB = Rz(w2 t) R_0 exp(-gd(x) [k]x),  gd(x) = 2 atan(tanh(x/2)),  k = m x e2,
/// m the direction of L in the body at t = 0 and R_0 the smallest rotation that takes it to z.
/// @param w2  (rad/s), positive
template <class T>
ClosedFormState<T> separatrix_free_body(const Vec3<T>& moments, T w2, T t_s);

// --- On the turning Earth ----------------------------------------------------------------------------------------------

/// A motion as seen from the laboratory L, which rotates with the Earth.
template <class T>
struct LaboratoryState {
  Quaternion<T> q_LB;
  Vec3<T> w_LB_B = Vec3<T>::Zero();  ///< relative to the laboratory (rad/s)
  T attitude_error = T(0);           ///< rad
  T rate_error = T(0);               ///< rad/s
};

/// q_LB = exp(-[W]x t) q_NB, w_LB_B = w_NB_B - R_NB^T W, where N are the axes that L has at t = 0. The result is the motion on
/// the rotating Earth that starts with the same attitude and the same *inertial* rate,
///   - at either pole, where W is along gravity, for any body, and
///   - at any latitude for a body without torque.
/// Elsewhere the torque of gravity turns with the Earth, and the result is not a solution.
/// @param W_IL_L  the Earth's rate in laboratory axes (rad/s)   @param t_s  the time of `state` (s)
template <class T>
LaboratoryState<T> seen_from_laboratory(const ClosedFormState<T>& state, const Vec3<T>& W_IL_L, T t_s);

/// The axis of a balanced gyroscope whose spin axis is fixed in inertial space: exp(-[W]x t) axis_L. [L. Foucault, C. R. Acad.
/// Sci. Paris 35 (1852) 421]
template <class T>
Vec3<T> balanced_gyroscope_axis_L(const Vec3<T>& axis_L, const Vec3<T>& W_IL_L, T t_s);

/// The angle (rad) between that axis at time t_s and at the start.   @param axis_sine  sine of the angle between the axis and
/// the celestial axis
template <class T>
T balanced_gyroscope_drift(T axis_sine, T earth_rate, T t_s);

/// A first-order value with a bound on the neglected terms.
template <class T>
struct FirstOrder {
  T value;
  T left_out;  ///< bound on the sum of the neglected higher-order terms
};

/// Where a sleeping top comes to rest on the Earth, to first order in Omega: its lean (rad) towards the South, I3 w3
/// Omega_north / mgl. Terms of order Omega^2 are neglected.
/// @param W_IL_L  the Earth's rate: East (not used), North, Up (rad/s)
template <class T>
FirstOrder<T> sleeping_top_lean_south(const SymmetricTop<T>& top, T w3, const Vec3<T>& W_IL_L);

/// The axis that is exactly at rest in the laboratory: n parallel to mgl z - (I3 w3 - I1 W.n) W, the solution near +z (unit
/// vector).
template <class T>
Vec3<T> resting_axis_L(const SymmetricTop<T>& top, T w3, const Vec3<T>& W_IL_L);

/// Rate (rad/s, counterclockwise about Up) at which the plane of swing turns, for a hanging top that is released at rest in the
/// laboratory: -Omega_up (1 - I3 / (2 I1)), which is Foucault's rate only for a point bob. It is exact for the linear pendulum
/// on a rotating floor. Neglected: terms that grow with the amplitude a, which are Omega_up a^2 (an ellipse as narrow as the
/// Earth makes it turns at Airy's rate) and Omega_north a (I3 / (2 I1) + a^2); and, of order Omega^2, the shift of the
/// equilibrium relative to the amplitude.
/// @param amplitude  (rad), at most 0.5   @param top  mgl < 0
template <class T>
FirstOrder<T> foucault_rate(const SymmetricTop<T>& top, T amplitude, const Vec3<T>& W_IL_L);

}  // namespace earthtop
