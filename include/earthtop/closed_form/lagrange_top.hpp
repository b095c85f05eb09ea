// SPDX-License-Identifier: GPL-3.0-or-later
/// The heavy symmetric top about a fixed pivot without Earth rotation (Lagrange's case), in closed form.
#pragma once

#include <array>
#include <type_traits>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

/// The kind of motion of the axis, for reports only; no number depends on it. Two values count as equal if they differ by no
/// more than a rounding of the input can cause.
enum class LagrangeRegime {
  at_rest,         ///< the axis is at rest and no torque acts on it: mgl = 0 and no rate across the axis, or hanging
  free,            ///< no torque: the axis turns steadily about the angular momentum
  sleeping,        ///< upright, and stays so
  homoclinic,      ///< tends to the upright position for t -> +-inf
  steady,          ///< precesses at constant tilt
  wavy,            ///< nutates; the azimuth never turns back
  cusped,          ///< comes to rest at its highest points
  looping,         ///< nutates; the azimuth turns back at the highest points
  plane_swinging,  ///< no angular momentum along the vertical or the axis: swings as a pendulum
  plane_turning    ///< the same, but turns over the top
};

/// How far from the start a closed form is evaluated. Within a few periods its rates need no more digits than its values do,
/// and their derivation takes a third of the time.
enum class ClosedFormSpan { any, few_periods };

/// A rate (rad/s) with twice the digits, as an unevaluated sum: a phase over many turns keeps all digits of T.
template <class T>
struct PhaseRate {
  T high = T(0), low = T(0);
};
/// The rates at which the phases of a symmetric top's motion go on in the mean. A and B are the two halves of its quaternion,
/// A = w + i z and B = x + i y: A exp(-i A_rate t) and B exp(-i B_rate t) have the period of the nutation, but may change their
/// sign from one to the next. B_rate + A_rate is then the mean precession, up to a multiple of the nutation's rate.
template <class T>
struct SecularPhases {
  PhaseRate<T> nutation, of_A, of_B;
};

/// Attitude and rate of the heavy symmetric top at any time, by theta functions.
///
/// Write the quaternion as two complex numbers A = w + i z, B = x + i y, and the rate across the axis as Omega = w1 + i w2.
/// Seen from axes that turn about the axis of symmetry at w3 (1 - I3/I1), the motion is that of a top with I3 = I1:
///
///   dA/dt = (i beta A - B conj(Omega)) / 2,  dB/dt = (-i beta B + A Omega) / 2,  dOmega/dt = 2 mu conj(A) B
///
/// with beta = I3 w3/I1, mu = m g l/I1. |A|^2, |B|^2, |Omega|^2 are linear in u = cos(tilt), which is an elliptic function of
/// t. So each of A, B, Omega is a constant x exp(i rate t) x theta(v - i eta)/theta_4(v) with v linear in t (F. Klein and A.
/// Sommerfeld, Theory of the Top, vol. II; E. T. Whittaker, Analytical Dynamics, chapter VI). These expressions contain no
/// Euler angles and are regular everywhere, also at the vertical and in every limit of the parameters. For k^2 > 1/2 the theta
/// functions are transformed by Jacobi's imaginary transformation, for which the separatrix is a simple limit.
///
/// Rates and periods are computed in the next wider scalar type and stored as a sum of two numbers, so that the phase at time t
/// has no larger error than the rounding of the input causes.
template <class T>
class LagrangeTop {
 public:
  /// @param q0_NB  attitude at t = 0, not zero; normalised here   @param w0_NB_B  rate at t = 0 (rad/s), finite
  LagrangeTop(const SymmetricTop<T>& top, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B,
              ClosedFormSpan span = ClosedFormSpan::any);

  /// The state at time t (s); its quaternion may have either sign. In double it takes about 0.1 us; a construction takes about
  /// 2 us.
  ///
  /// The stated error holds for the start exactly as given. It adds up: some 20 eps of rounding in the functions; the rounding
  /// of the phases in the wider scalar; and the shift in time due to the rounding of the roots, which an unstable motion
  /// amplifies. It is typically 10 to 100 times the true error, up to 3e4 times close to the separatrix. It does not include
  /// the effect of an error of the start.
  ClosedFormState<T> at(T t_s) const;

  LagrangeRegime regime() const { return regime_; }
  /// The period of the tilt (s); infinite if there is none (homoclinic, or nothing moves).
  T nutation_period_s() const;
  /// Less these phases, A, B and |Omega| repeat themselves with the nutation, up to a sign (see `secular_phases`).
  SecularPhases<T> secular_phases() const;
  /// Squared modulus k^2 of the elliptic functions and its complement 1 - k^2, each to full relative accuracy.
  T parameter() const { return parameter_; }
  T complementary_parameter() const { return complementary_parameter_; }

 private:
  /// A number with twice the digits, as an unevaluated sum.
  struct Split {
    T high = T(0), low = T(0);
  };
  /// Theta quotient of A, B or Omega: size * (sum re_n S_n + i sum im_n C_n) / denominator.
  static constexpr int kTerms = std::is_same_v<T, float128> ? 6 : std::is_same_v<T, float80> ? 5 : 4;
  struct Quotient {
    std::array<T, kTerms> re{}, im{};
    T size = T(0);
    T cos = T(1), sin = T(0);  ///< cosine and sine of its constant phase
  };
  struct Basis;
  template <class W>
  struct Derivation;

  void evaluate_basis(T v, T v_low, Basis& basis) const;
  template <class W>
  void set_phases(const Derivation<W>& start);
  T gap_loss(const Basis& basis) const;

  bool hyperbolic_ = false;
  bool flipped_ = false;  ///< whether mgl < 0: up and down are exchanged
  int winding_ = 1;       ///< Omega carries exp(i winding v) on the circular branch
  std::array<T, kTerms> square_{}, pronic_{};
  Quotient low_, high_, rate_;  ///< the quotients with the zero at u = -1 and at u = 1 (A and B), and Omega's
  Split v_rate_, v_start_, v_period_;
  Split sum_rate_, difference_rate_;  ///< phase rates of (arg A + arg B)/2 and (arg A - arg B)/2 (rad/s)
  Split sum_turn_, difference_turn_;  ///< the same phases per period of v (rad)
  SecularPhases<T> secular_;
  T w3_ = T(0);
  T parameter_ = T(0), complementary_parameter_ = T(1);
  T gravity_ = T(0);  ///< |mgl|/I1
  // Terms of the stated error, see `at`.
  T attitude_floor_ = T(0), rate_floor_ = T(0);         ///< rad, rad/s
  T rate_turn_ = T(0);                                  ///< error of Omega's phase (rad)
  T phase_loss_ = T(0);                                 ///< rad/s
  T nutation_loss_ = T(0);                              ///< error of v per unit of v
  T period_loss_ = T(0);                                ///< error of v per period
  T nome_loss_ = T(0);                                  ///< error of the nome, on the separatrix
  T start_loss_ = T(0);                                 ///< error of v at the start
  T near_top_time_ = T(0);                              ///< s; 0 unless it starts next to the vertical near a steady rate
  T near_top_rate_ = T(0);                              ///< beta (rad/s)
  T near_top_loss_ = T(0), near_top_rate_loss_ = T(0);  ///< rad, rad/s
  LagrangeRegime regime_ = LagrangeRegime::at_rest;
};

extern template class LagrangeTop<double>;
extern template class LagrangeTop<float80>;
extern template class LagrangeTop<float128>;

}  // namespace earthtop
