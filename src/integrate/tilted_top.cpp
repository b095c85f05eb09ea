// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/tilted_top.hpp"

#include <algorithm>
#include <limits>

namespace earthtop {
namespace {

/// Exponent of the moment of inertia along the axis of the effective top. It is so large that kappa corresponds to practically
/// no spin: F must not turn about n during any run.
constexpr int kNoSpinExponent = 200;

/// A rotation that takes Up to the unit vector u.
template <class T>
Quaternion<T> from_up(const Vec3<T>& u) {
  if (u[2] >= T(0)) return Quaternion<T>{T(1) + u[2], Vec3<T>(-u[1], u[0], T(0))}.normalized();
  const Quaternion<T> about_down = Quaternion<T>{T(1) - u[2], Vec3<T>(u[1], -u[0], T(0))}.normalized();
  return about_down * Quaternion<T>{T(0), Vec3<T>(T(1), T(0), T(0))};
}

}  // namespace

template <class T>
TiltedTop<T>::TiltedTop(const Model<T>& model, const ReducedTop<T>& top, const NaturalRelease<T>& release, const Vec3<T>& W_L)
    : I1_(top.I1) {
  const Quaternion<T> q = release.q_LB.normalized();
  const Vec3<T>& w_XB_B = release.w_XB_B;
  const Mat3<T> R_LB = rotation_matrix(q);
  const Vec3<T> W_B = transposed_times(R_LB, W_L), n = R_LB.col(2);
  const bool inertial = release.X == RatesRelativeTo::inertial;
  const Vec3<T> w_LB_B = inertial ? Vec3<T>(w_XB_B - W_B) : w_XB_B;
  spin_start_ = inertial ? T(0) : W_B[2];
  const T kappa = top.I3 * (w_XB_B[2] + spin_start_);
  const Vec3<T> weight = -model.mass_moment_B[2] * model.apparent_gravity_L;

  // w is the mean of W.n over a precession about G. As G depends on w, both are found by iteration.
  Vec3<T> G, up;
  for (int i = 0; i < 3; ++i) {
    G = weight - (kappa - I1_ * mean_) * W_L;
    G_ = norm(G);
    up = G_ > T(0) ? Vec3<T>(G / G_) : Vec3<T>(Vec3<T>::UnitZ());
    if (i < 2) mean_ = W_L.dot(up) * n.dot(up);
  }
  kappa_ = kappa - T(2) * I1_ * mean_;
  q_LG_ = from_up(up);
  W_G_ = transposed_times(rotation_matrix(q_LG_), W_L);
  // Where weight and gyroscopic torque nearly cancel, the change of M says little about n.
  exact_turn_ = G_ > T(1e-4) * (norm(weight) + real::abs(kappa) * norm(W_L));

  effective_ = {T(1), real::scale(T(1), kNoSpinExponent), G_ / I1_};
  effective_spin_ = real::scale(T(kappa_ / I1_), -kNoSpinExponent);
  start_.q_GF = q_LG_.conjugate() * q;
  start_.across = {w_LB_B[0], w_LB_B[1]};
  start_.M_G = momentum_along_G(rotation_matrix(start_.q_GF), start_.across);
  nutation_period_ =
      LagrangeTop<T>(effective_, start_.q_GF, Vec3<T>(start_.across.re, start_.across.im, effective_spin_)).nutation_period_s();

  // The largest rate of the axis follows from |across|^2 / 2 - G.n / I1, which only the perturbation changes.
  const T start_rate = real::hypot(start_.across.re, start_.across.im), mu = G_ / I1_;
  const T from_energy = real::sqrt(start_rate * start_rate + T(2) * mu * (T(1) + n.dot(up)));
  const T beta = real::abs(kappa_) / I1_;
  // The nutation of a fast top is small: its axis is never faster than it starts by more than a few times the precession.
  const T from_spin = beta > T(0) ? start_rate + T(4) * mu / beta : std::numeric_limits<T>::infinity();
  frame_rate_ = std::min(from_energy, from_spin);
  const T W = norm(W_L), torque = T(2) * W * I1_ * (frame_rate_ + W);
  kick_rate_ = torque / std::max({real::abs(kappa_), I1_ * frame_rate_, real::sqrt(I1_ * G_), std::numeric_limits<T>::min()});
}

template <class T>
T TiltedTop<T>::fast_rate() const {
  const T nutation = T(2) * real::pi<T>() / nutation_period_;
  return std::max({nutation, real::abs(kappa_) / I1_, T(2) * real::sqrt(G_ / I1_), frame_rate_});
}

template <class T>
T TiltedTop<T>::precession_rate() const {
  return kappa_ != T(0) ? G_ / real::abs(kappa_) : std::numeric_limits<T>::infinity();
}

template <class T>
TiltedTop<T>::Flow::Flow(const TiltedTop& top, const TiltedTopState<T>& from, ClosedFormSpan span)
    : top_(top),
      from_(from),
      closed_form_(top.effective_, from.q_GF, Vec3<T>(from.across.re, from.across.im, top.effective_spin_), span),
      momentum_(top.momentum(from)) {}

template <class T>
TiltedTopState<T> TiltedTop<T>::Flow::at(T t) const {
  const ClosedFormState<T> there = closed_form_.at(t);
  TiltedTopState<T> x = from_;
  const bool opposite = there.q_NB.w * from_.q_GF.w + there.q_NB.v.dot(from_.q_GF.v) < T(0);
  x.q_GF = opposite ? Quaternion<T>{-there.q_NB.w, -there.q_NB.v} : there.q_NB;
  x.across = {there.w_NB_B[0], there.w_NB_B[1]};
  top_.keep_momentum_along_G(x);
  if (top_.exact_turn_) {
    const Vec3<T> change = top_.momentum(x) - momentum_;
    add((top_.W_G_[1] * change[0] - top_.W_G_[0] * change[1]) / (top_.G_ > T(0) ? top_.G_ : T(1)), x.turn, x.turn_rest);
  }
  return x;
}

template <class T>
T TiltedTop<T>::momentum_along_G(const Mat3<T>& R_GF, const Complex<T>& across) const {
  return kappa_ * R_GF(2, 2) + I1_ * (across.re * R_GF(2, 0) + across.im * R_GF(2, 1));
}

template <class T>
Vec3<T> TiltedTop<T>::momentum(const TiltedTopState<T>& x) const {
  const Mat3<T> R_GF = rotation_matrix(x.q_GF);
  return kappa_ * R_GF.col(2) + I1_ * (x.across.re * R_GF.col(0) + x.across.im * R_GF.col(1));
}

/// Adds to a number that is the sum of two.
template <class T>
void TiltedTop<T>::add(T change, T& sum, T& rest) {
  const T y = change + rest, both = sum + y;
  rest = y - (both - sum);
  sum = both;
}

/// Turns n within its vertical plane, by some eps, so that M along G is what the state's number says. Next to the vertical that
/// component does not tell the tilt.
template <class T>
void TiltedTop<T>::keep_momentum_along_G(TiltedTopState<T>& x) const {
  const Mat3<T> R_GF = rotation_matrix(x.q_GF);
  const T square = R_GF(2, 0) * R_GF(2, 0) + R_GF(2, 1) * R_GF(2, 1);
  constexpr double kLeastSine2 = 1e-4, kLargest = 1e-13;
  if (kappa_ == T(0) || !(square > T(kLeastSine2))) return;
  const T excess = (momentum_along_G(R_GF, x.across) - x.M_G) - x.M_G_rest;
  const T by = -excess / (kappa_ * square);
  if (!(real::abs(by) < T(kLargest))) return;  // not round-off: the weight is not a large part of a slow top's momentum
  x.q_GF = x.q_GF * Quaternion<T>{T(1), Vec3<T>(-by / T(2) * R_GF(2, 1), by / T(2) * R_GF(2, 0), T(0))};
}

template <class T>
void TiltedTop<T>::kick(T b, TiltedTopState<T>& x) const {
  const Mat3<T> R_GF = rotation_matrix(x.q_GF);
  const Vec3<T> W_F = transposed_times(R_GF, W_G_);
  // d(across)/dt = -2 i delta (across + W/2): `across` turns about -W/2.
  const Complex<T> half{W_F[0] / T(2), W_F[1] / T(2)};
  const Complex<T> turned_sum = turned(T(T(-2) * (W_F[2] - mean_) * b)) * (x.across + half), before = x.across;
  x.across = turned_sum + T(-1) * half;
  const Complex<T> change = x.across + T(-1) * before;
  add(I1_ * (change.re * R_GF(2, 0) + change.im * R_GF(2, 1)), x.M_G, x.M_G_rest);
  add(-b * (exact_turn_ ? W_G_[2] * R_GF(2, 2) : W_F[2]), x.turn, x.turn_rest);
}

template <class T>
void TiltedTop<T>::push(T b, const Vec3<T>& f_F, TiltedTopState<T>& x) const {
  const Complex<T> change{-b * f_F[1] / I1_, b * f_F[0] / I1_};
  x.across = x.across + change;
  const Mat3<T> R_GF = rotation_matrix(x.q_GF);
  add(I1_ * (change.re * R_GF(2, 0) + change.im * R_GF(2, 1)), x.M_G, x.M_G_rest);
}

template <class T>
typename TiltedTop<T>::Seen TiltedTop<T>::seen(const TiltedTopState<T>& x, T t) const {
  const T angle = spin_start_ * t + x.turn + x.turn_rest;
  const SinCos<T> half = real::sin_cos(T(angle / T(2)));
  const Quaternion<T> about_n{half.cos, Vec3<T>(T(0), T(0), half.sin)};
  const T W_along = transposed_times(rotation_matrix(x.q_GF), W_G_)[2];
  return {q_LG_ * x.q_GF * about_n, turned(T(-angle)) * x.across, spin_start_ - W_along};
}

template class TiltedTop<double>;
template class TiltedTop<float80>;

}  // namespace earthtop
