// SPDX-License-Identifier: GPL-3.0-or-later
/// The non-rotating motion of a symmetric top as a function of three phases, of which two only turn it.
///
/// Let F be a frame that moves with the axis and does not turn about it. Its attitude is
///
///   q_LF = turn(Up, theta2) q(theta1) turn(axis, theta3) ,
///
/// where q(theta1), the attitude of a frame F', has the period 2 pi in theta1, the phase of the nutation. The three phases grow
/// steadily, at the rates nu of the nutation, p of the mean precession, and c. In F' the rate across the axis has that period,
/// too. With the quaternion's halves A = w + i z and B = x + i y the two turns are factors: exp(i (theta2 + theta3) / 2) of A
/// and exp(i (theta2 - theta3) / 2) of B.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "closed_form/split_number.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"
#include "integrate/fourier/fourier_transform.hpp"

namespace earthtop {

/// What the motion of F depends on.
template <class T>
struct SpinlessTop {
  SymmetricTop<T> body;  ///< with the torque of gravity, of either sign
  T w3 = T(0);           ///< inertial rate along the axis
  Quaternion<T> q_LF;    ///< at the release
  Complex<T> across;     ///< inertial rate w1 + i w2 across the axis at the release, in F

  template <class W>
  SpinlessTop<W> as() const {
    return {{W(body.I1), W(body.I3), W(body.mgl)}, W(w3), converted<W>(q_LF), {W(across.re), W(across.im)}};
  }
  T gravity() const { return body.mgl / body.I1; }
  T b() const { return body.I3 * w3 / body.I1; }  ///< the nutation rate of the free top
};

template <class T>
LagrangeTop<T> closed_form_of(const SpinlessTop<T>& top, ClosedFormSpan span = ClosedFormSpan::any) {
  // The moment of inertia along the axis is so large that the angular momentum takes practically no spin: F does not turn about the axis.
  constexpr int kNoSpinExponent = 200;
  const SymmetricTop<T> body{top.body.I1, real::scale(top.body.I3, kNoSpinExponent), top.body.mgl};
  return {body, top.q_LF, Vec3<T>(top.across.re, top.across.im, real::scale(top.w3, -kNoSpinExponent)), span};
}

template <class T>
class PlainTorus {
 public:
  explicit PlainTorus(const SpinlessTop<T>& top) : top_(top), closed_form_(closed_form_of(top)) {
    // The phases of a long run need all digits of their rates, which a closed form in the next wider scalar has.
    const SecularPhases<Wider<T>> phases = closed_form_of(top.template as<Wider<T>>()).secular_phases();
    const auto narrowed = [](const PhaseRate<Wider<T>>& rate) {
      const T high = static_cast<T>(rate.high);
      return Rate{high, static_cast<T>((rate.high - Wider<T>(high)) + rate.low)};
    };
    nutation_ = narrowed(phases.nutation), A_rate_ = narrowed(phases.of_A), B_rate_ = narrowed(phases.of_B);
  }

  const SpinlessTop<T>& top() const { return top_; }
  const LagrangeTop<T>& closed_form() const { return closed_form_; }
  /// Whether there is a period of the nutation, as there is not on a separatrix, nor where nothing moves.
  bool is_periodic() const { return nutation_.high > T(0) && real::isfinite(closed_form_.nutation_period_s()); }
  T period() const { return T(2) * real::pi<T>() / nutation_.high; }
  T nutation() const { return nutation_.high; }     ///< nu
  T precession() const { return precession_; }      ///< p, right once sampled
  T turn_about_axis() const { return axis_turn_; }  ///< c, right once sampled

  /// Fills the points and coefficients for `size` equal steps of theta1.
  void sample(std::size_t size);

  /// One point of the motion: F' without the turn theta2, and the rate across the axis in F'.
  struct Point {
    Quaternion<T> q;
    Complex<T> across;
  };
  const std::vector<Point>& points() const { return points_; }
  /// The coefficients of A, B and the rate across the axis, in the places of a FourierTransform.
  struct Coefficients {
    std::vector<Complex<T>> A, B, across;
  };
  const Coefficients& coefficients() const { return coefficients_; }
  /// The largest coefficient of A, B or the rate beyond a harmonic, each over the largest of its own.
  T harmonics_beyond(int harmonic) const;

  /// A bound on the error of the points' attitudes (rad).
  T error() const { return error_; }

  /// The phases at a time, each reduced by whole turns.
  struct Phases {
    T nutation, of_A, of_B;
  };
  Phases phases(T t) const { return {reduced(nutation_, t), reduced(A_rate_, t), reduced(B_rate_, t)}; }

 private:
  using Rate = PhaseRate<T>;
  using Half = Complex<T> (*)(const Quaternion<T>&);

  static Complex<T> half_A(const Quaternion<T>& q) { return {q.w, q.v[2]}; }
  static Complex<T> half_B(const Quaternion<T>& q) { return {q.v[0], q.v[1]}; }
  static T reduced(const Rate& rate, T t) {
    const Rate none, turn{T(2) * real::pi<T>(), T(2) * real::pi_rest<T>()};
    return phase_rest(rate, t, none, turn).rest;
  }
  /// a + times b
  static Rate sum(const Rate& a, T times, const Rate& b) {
    const T product = times * b.high, product_rest = real::fma(times, b.high, T(-product)) + times * b.low;
    const T high = a.high + product, part = high - a.high;
    const T lost = (a.high - (high - part)) + (product - part);
    const T low = lost + a.low + product_rest, whole = high + low;
    return {whole, low - (whole - high)};
  }
  std::vector<Quaternion<T>> continuous_attitudes(std::size_t size, std::vector<Complex<T>>& across);
  std::vector<Complex<T>> settle(const std::vector<Quaternion<T>>& two_nutations, Half half,
                                 const FourierTransform<T>& transform, Rate& rate) const;

  SpinlessTop<T> top_;
  LagrangeTop<T> closed_form_;
  Rate nutation_, A_rate_, B_rate_;
  T precession_ = T(0), axis_turn_ = T(0), error_ = T(0);
  std::vector<Point> points_;
  Coefficients coefficients_;
};

template <class T>
void PlainTorus<T>::sample(std::size_t size) {
  const FourierTransform<T> transform(size);
  std::vector<Complex<T>> across(size);
  const std::vector<Quaternion<T>> attitudes = continuous_attitudes(size, across);
  coefficients_.A = settle(attitudes, half_A, transform, A_rate_);
  coefficients_.B = settle(attitudes, half_B, transform, B_rate_);
  precession_ = sum(A_rate_, T(1), B_rate_).high;
  axis_turn_ = sum(A_rate_, T(-1), B_rate_).high;
  std::vector<Complex<T>> A = coefficients_.A, B = coefficients_.B;
  transform.to_values(A.data());
  transform.to_values(B.data());
  points_.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    across[i] = turned(T(axis_turn_ * (period() * T(i) / T(size)))) * across[i];
    points_[i] = {Quaternion<T>{A[i].re, Vec3<T>(B[i].re, B[i].im, A[i].im)}, across[i]};
  }
  transform.to_coefficients(across.data());
  coefficients_.across = std::move(across);
}

template <class T>
T PlainTorus<T>::harmonics_beyond(int harmonic) const {
  T most = T(0);
  const FourierTransform<T> transform(points_.size());
  for (const std::vector<Complex<T>>* x : {&coefficients_.A, &coefficients_.B, &coefficients_.across}) {
    T largest = T(0), beyond = T(0);
    for (std::size_t i = 0; i < x->size(); ++i) {
      const T square = norm2((*x)[i]);
      largest = std::max(largest, square);
      if (std::abs(transform.harmonic(i)) > harmonic) beyond = std::max(beyond, square);
    }
    if (largest > T(0)) most = std::max(most, T(beyond / largest));
  }
  return real::sqrt(most);
}

/// The attitudes of F through two nutations, of the two quaternions of each the one that continues the last.
/// @param across  is filled for the first of the two
template <class T>
std::vector<Quaternion<T>> PlainTorus<T>::continuous_attitudes(std::size_t size, std::vector<Complex<T>>& across) {
  std::vector<Quaternion<T>> attitudes(2 * size);
  error_ = T(0);
  for (std::size_t i = 0; i < attitudes.size(); ++i) {
    const ClosedFormState<T> state = closed_form_.at(period() * T(i) / T(size));
    Quaternion<T>& q = attitudes[i] = state.q_NB;
    const Quaternion<T> last = i > 0 ? attitudes[i - 1] : top_.q_LF;
    if (last.w * q.w + last.v.dot(q.v) < T(0)) q = {-q.w, -q.v};
    error_ = std::max(error_, state.attitude_error);
    if (i < size) across[i] = {state.w_NB_B[0], state.w_NB_B[1]};
  }
  return attitudes;
}

/// Chooses the phase rate of one half of the quaternion among those that differ by the nutation's or half of it: the half then
/// repeats itself with the nutation, and the constant is its largest harmonic. @returns its coefficients
template <class T>
std::vector<Complex<T>> PlainTorus<T>::settle(const std::vector<Quaternion<T>>& two_nutations, Half half,
                                              const FourierTransform<T>& transform, Rate& rate) const {
  const std::size_t n = transform.size();
  const auto size_at = [&](std::size_t i) { return norm2(half(two_nutations[i])); };
  std::size_t clearest = 0;
  for (std::size_t i = 1; i < n; ++i)
    if (size_at(i) > size_at(clearest)) clearest = i;
  const Complex<T> before = half(two_nutations[clearest]), after = half(two_nutations[clearest + n]);
  if ((turned(T(-rate.high * period())) * after * conj(before)).re < T(0)) rate = sum(rate, T(0.5), nutation_);
  std::vector<Complex<T>> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = turned(T(-rate.high * (period() * T(i) / T(n)))) * half(two_nutations[i]);
  transform.to_coefficients(x.data());
  std::size_t largest = 0;
  for (std::size_t i = 1; i < n; ++i)
    if (norm2(x[i]) > norm2(x[largest])) largest = i;
  rate = sum(rate, T(transform.harmonic(largest)), nutation_);
  std::rotate(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(largest), x.end());
  return x;
}

}  // namespace earthtop
