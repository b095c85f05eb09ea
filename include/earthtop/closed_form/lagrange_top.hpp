// SPDX-License-Identifier: GPL-3.0-or-later
/// The heavy symmetric top about a fixed pivot without Earth rotation (Lagrange's case), in closed form.
#pragma once

#include <array>
#include <type_traits>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

/// What the axis does, for reports; no number depends on it. Two values count as equal within the reach of a rounding of the
/// input.
enum class LagrangeRegime {
  at_rest,         ///< the axis stands still and no torque acts on it: mgl = 0 without rate across the axis, or hanging
  free,            ///< no torque: the axis turns steadily about the angular momentum
  sleeping,        ///< upright, and stays
  homoclinic,      ///< tends to the upright position for t -> +-inf
  steady,          ///< precesses at constant tilt
  wavy,            ///< nutates, the azimuth never turning back
  cusped,          ///< comes to rest at its highest points
  looping,         ///< nutates, the azimuth turning back at the highest points
  plane_swinging,  ///< no angular momentum along the vertical nor along the axis: a pendulum that comes back
  plane_turning    ///< the same, over the top
};

/// Attitude and rate of the top at any time, by theta functions.
///
/// With the quaternion as two complex numbers A = w + i z, B = x + i y and the rate across the axis Omega = w1 + i w2, all seen
/// from axes that turn about the axis of symmetry at w3 (1 - I3/I1), the motion is that of a top with I3 = I1:
///
///   dA/dt = (i beta A - B conj(Omega)) / 2,  dB/dt = (-i beta B + A Omega) / 2,  dOmega/dt = 2 mu conj(A) B
///
/// (beta = I3 w3/I1, mu = m g l/I1), and |A|^2, |B|^2, |Omega|^2 are linear in u = cos(tilt), an elliptic function of t. So
/// each of the three is a constant x exp(i rate t) x theta(v - i eta)/theta_4(v) with v linear in t (F. Klein and A.
/// Sommerfeld, Theory of the Top, vol. II; E. T. Whittaker, Analytical Dynamics, chapter VI): regular everywhere, at the
/// vertical and in every limit of the parameters, with no Euler angle. For k^2 > 1/2 the theta functions are taken through
/// Jacobi's imaginary transformation, which makes the separatrix the easy end of that branch.
///
/// Rates and periods are set up in the next wider scalar and kept as a sum of two numbers, so that the phase at time t has
/// the error of the input's rounding, not more.
template <class T>
class LagrangeTop {
 public:
  /// @param q0_NB  attitude at t = 0, not zero; normalised here   @param w0_NB_B  rate at t = 0 (rad/s), finite
  LagrangeTop(const SymmetricTop<T>& top, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B);

  /// The state at time t (s), of either sign. About 0.1 us in double; a construction costs about 2 us.
  ///
  /// The error statement counts, for the start as given: some 20 eps of the functions' own rounding; the phases' rounding in
  /// the wider scalar; and the shift in time that the roots' rounding makes, which an unstable motion lets grow. Typically 10
  /// to 100 times the error, up to 3e4 times close to the separatrix. It says nothing of what a change of the start would do.
  ClosedFormState<T> at(T t_s) const;

  LagrangeRegime regime() const { return regime_; }
  /// The period of the tilt (s); infinite where there is none: homoclinic, or nothing moves.
  T nutation_period_s() const;
  /// Squared modulus k^2 of the elliptic functions and its complement, each to full relative accuracy.
  T parameter() const { return parameter_; }
  T complementary_parameter() const { return complementary_parameter_; }

 private:
  /// An unevaluated sum: a rate or period to twice the digits.
  struct Split {
    T high = T(0), low = T(0);
  };
  /// Theta quotient of one of A, B, Omega: size * (sum re_n S_n + i sum im_n C_n) / denominator.
  static constexpr int kTerms = std::is_same_v<T, float128> ? 6 : std::is_same_v<T, long double> ? 5 : 4;
  struct Quotient {
    std::array<T, kTerms> re{}, im{};
    T size = T(0);
    T cos = T(1), sin = T(0);  ///< its constant phase
  };
  struct Basis;
  struct Setup;

  void evaluate_basis(T v, T v_low, Basis& basis) const;
  void set_phases(const Setup& setup);
  T gap_loss(const Basis& basis) const;

  bool hyperbolic_ = false;
  bool flipped_ = false;  ///< mgl < 0: the roles of up and down are exchanged
  int winding_ = 1;       ///< Omega carries exp(i winding v) on the circular branch
  std::array<T, kTerms> square_{}, pronic_{};
  Quotient low_, high_, rate_;  ///< the one whose zero lies at u = -1, at u = 1, and Omega
  Split v_rate_, v_start_, v_period_;
  Split sum_rate_, difference_rate_;  ///< of (arg A + arg B)/2, (arg A - arg B)/2 per second
  Split sum_turn_, difference_turn_;  ///< the same per period of v
  T w3_ = T(0);
  T parameter_ = T(0), complementary_parameter_ = T(1);
  T gravity_ = T(0);  ///< |mgl|/I1
  // Error statement, see `at`.
  T attitude_floor_ = T(0), rate_floor_ = T(0);         ///< rad, rad/s
  T rate_turn_ = T(0);                                  ///< error of Omega's phase (rad)
  T phase_loss_ = T(0);                                 ///< rad/s
  T nutation_loss_ = T(0);                              ///< of v, per unit of v
  T period_loss_ = T(0);                                ///< of v, per period
  T nome_loss_ = T(0);                                  ///< of the nome, on the separatrix
  T start_loss_ = T(0);                                 ///< of v at the start
  T near_top_time_ = T(0);                              ///< s; 0 unless it starts next to the vertical near a steady rate
  T near_top_rate_ = T(0);                              ///< beta (rad/s)
  T near_top_loss_ = T(0), near_top_rate_loss_ = T(0);  ///< rad, rad/s
  LagrangeRegime regime_ = LagrangeRegime::at_rest;
};

extern template class LagrangeTop<double>;
extern template class LagrangeTop<long double>;
extern template class LagrangeTop<float128>;

}  // namespace earthtop
