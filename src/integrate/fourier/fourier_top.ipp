// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of FourierTop, for each scalar.
#pragma once

#include <algorithm>
#include <cmath>

#include "integrate/fourier/fourier_top.hpp"

namespace earthtop {

template <class T>
SpinlessTop<T> FourierTop<T>::spinless(const Model<T>& model, const NaturalRelease<T>& release) {
  const T mgl = -model.mass_moment_B[2] * model.apparent_gravity_L[2];
  return {SymmetricTop<T>{model.I_BP_B(0, 0), model.I_BP_B(2, 2), mgl}, release.w_XB_B[2], release.q_LB.normalized(),
          Complex<T>{release.w_XB_B[0], release.w_XB_B[1]}};
}

template <class T>
FourierTop<T>::FourierTop(const Model<T>& model, const NaturalRelease<T>& release, TorusAxes axes, std::size_t fineness)
    : epsilon_(model.epsilon), W_L_(model.W_IL_L), plain_(spinless(model, release)) {
  constexpr std::size_t kAlong = 16, kAcross = 8;
  if (plain_.top().gravity() == T(0)) {
    refusal_ = "without a torque of gravity there is no precession; a closed form has that motion";
    return;
  }
  if (!plain_.is_periodic()) {
    refusal_ = "the non-rotating motion has no period: it rests, or tends to the vertical for ever";
    return;
  }
  const TorusChange<T> change = this->change(model, release, axes);
  torus_.emplace(plain_, change, fineness * kAlong, fineness * kAcross);
  if (torus_->status() != TorusStatus::found) {
    constexpr double kSlow = 0.1;
    constexpr std::size_t kMany = 128;  // points of a nutation that all but a few motions do with
    const auto& q = plain_.coefficients();
    const T level = norm2(q.A[0]) * norm2(q.B[0]);  // of the mean axis, to the fourth power
    const LagrangeRegime regime = plain_.closed_form().regime();
    if (!(level > T(0)) || regime == LagrangeRegime::plane_swinging || regime == LagrangeRegime::plane_turning)
      refusal_ = "the non-rotating axis does not precess: it stays vertical, or swings in a plane";
    else if (epsilon_ * norm(change.W_G) > T(kSlow) * real::abs(plain_.precession()))
      refusal_ = "the precession is not much faster than the Earth's rotation";
    else if (torus_->status() == TorusStatus::too_many_harmonics || torus_->nutation_points() >= kMany)
      refusal_ = "the nutation has too many harmonics: the motion is next to one that tends to the vertical";
    else
      refusal_ = "a multiple of the precession is next to one of the nutation";
    return;
  }
  constexpr double kUnseen = 0.5;
  const int most = static_cast<int>(torus_->nutation_points() / 2) - 1;
  while (highest_ < most && plain_.harmonics_beyond(highest_) > T(kUnseen) * real::epsilon<T>()) ++highest_;
}

template <class T>
TorusChange<T> FourierTop<T>::change(const Model<T>& model, const NaturalRelease<T>& release, TorusAxes axes) {
  const SpinlessTop<T>& top = plain_.top();
  const Vec3<T>& W = model.W_IL_L_scaled;
  const Mat3<T> R_LB = rotation_matrix(top.q_LF);
  TorusChange<T> change;
  change.epsilon = epsilon_;
  if (release.X == RatesRelativeTo::laboratory) {
    const Vec3<T> W_B = transposed_times(R_LB, W);
    spin_change_ = W_B[2];
    change.across = {W_B[0], W_B[1]};
  }
  change.b = top.body.I3 / top.body.I1 * spin_change_;
  change.W_G = W;
  const T level = real::hypot(W[0], W[1]);
  if (axes == TorusAxes::laboratory || level == T(0)) return change;

  // The effective vertical g z - b W leans against the level part of the Earth's rate, or toward it.
  const T g = top.gravity(), b = top.b() + epsilon_ * change.b, side = g < T(0) ? T(-1) : T(1);
  const T upward = side * (g - b * epsilon_ * W[2]), size = real::hypot(upward, T(b * epsilon_ * level));
  if (!(upward > T(0))) return change;
  const Vec3<T> lean(-side * b * W[0] / size, -side * b * W[1] / size, T(0));  // sine of the angle over epsilon
  const T half_cosine = real::sqrt(T((T(1) + upward / size) / T(2)));
  const Vec3<T> half(-lean[1] / (T(2) * half_cosine), lean[0] / (T(2) * half_cosine), T(0));
  vertical_ = {half_cosine, half};
  change.W_G = W + epsilon_ * turn_back_minus_one_scaled(half_cosine, half, epsilon_, W);
  change.gravity_G = g * turn_back_minus_one_scaled(half_cosine, half, epsilon_, Vec3<T>(Vec3<T>::UnitZ()));
  change.y = -transposed_times(R_LB, half);
  return change;
}

/// The sums over the harmonics of the plain motion.   @param turn  exp(i theta1) of the plain motion   @param shift  what takes it to that of
/// the rotating one   @param shift_scaled  (shift - 1) / epsilon
template <class T>
typename FourierTop<T>::Nutated FourierTop<T>::nutated(const Complex<T>& turn, const Complex<T>& shift,
                                                       const Complex<T>& shift_scaled) const {
  const auto& c = plain_.coefficients();
  Nutated sum{c.A[0], c.B[0], {}, {}, c.across[0], c.across[0]};
  const Complex<T> rotating_turn = turn * shift;
  Complex<T> power = turn, rotating_power = rotating_turn, changed = shift_scaled;  // of the harmonic k
  for (int k = 1; k <= highest_; ++k) {
    const auto up = static_cast<std::size_t>(k), down = c.A.size() - up;
    const Complex<T> back = conj(power), changed_back = conj(changed);
    const Complex<T> A_up = c.A[up] * power, A_down = c.A[down] * back, B_up = c.B[up] * power, B_down = c.B[down] * back;
    sum.A = sum.A + A_up + A_down;
    sum.B = sum.B + B_up + B_down;
    sum.A_change = sum.A_change + A_up * changed + A_down * changed_back;
    sum.B_change = sum.B_change + B_up * changed + B_down * changed_back;
    sum.ref_across = sum.ref_across + c.across[up] * power + c.across[down] * back;
    sum.across = sum.across + c.across[up] * rotating_power + c.across[down] * conj(rotating_power);
    power = power * turn;
    rotating_power = rotating_power * rotating_turn;
    changed = changed * shift + shift_scaled;
  }
  return sum;
}

template <class T>
SpinlessPair<T> FourierTop<T>::at(T t) const {
  const typename PlainTorus<T>::Phases phases = plain_.phases(t);
  const Complex<T> turn_A = turned(phases.of_A), turn_B = turned(phases.of_B), turn1 = turned(phases.nutation);
  const Complex<T> turn2 = turn_A * turn_B, turn3 = turn_A * conj(turn_B);
  const typename RotatingTorus<T>::Rates rates = torus_->rates();

  const T half1 = rates.nutation * t / T(2);
  const Complex<T> half_turn = turned(T(epsilon_ * half1)), shift = half_turn * half_turn;
  const Nutated sum = nutated(turn1, shift, T(T(2) * scaled_sine(half1)) * times_i(half_turn));
  const Quaternion<T> q{sum.A.re, Vec3<T>(sum.B.re, sum.B.im, sum.A.im)},
      q_change{sum.A_change.re, Vec3<T>(sum.B_change.re, sum.B_change.im, sum.A_change.im)};
  const Quaternion<T> turned_on = q.conjugate() * q_change;
  const SmallTurn of_nutation{T(1) + epsilon_ * turned_on.w, turned_on.v};

  // The turn about the vertical, and that from Up to it, seen in F'.
  const T half2 = rates.precession * t / T(2);
  SmallTurn outer = product(vertical_, {real::cos(T(epsilon_ * half2)), Vec3<T>(T(0), T(0), scaled_sine(half2))});
  const Complex<T> level = conj(turn2) * Complex<T>{outer.v[0], outer.v[1]};
  outer.v = transposed_times(rotation_matrix(q), Vec3<T>(level.re, level.im, outer.v[2]));

  const TorusVector<T> x = torus_->at(turn1 * shift, turn2 * turned(T(T(2) * epsilon_ * half2)));
  const Vec3<T> y = x.template head<3>();
  const SmallTurn deformed{real::sqrt(T(T(1) - epsilon_ * epsilon_ * y.dot(y))), y};
  SmallTurn e = product(product(outer, of_nutation), deformed);

  // From F' to F, and the turn of the two about the axis.
  const Complex<T> into = conj(turn3) * Complex<T>{e.v[0], e.v[1]};
  e.v = Vec3<T>(into.re, into.im, e.v[2]);
  const T half3 = (rates.axis_turn + spin_change_) * t / T(2);
  e = product(e, {real::cos(T(epsilon_ * half3)), Vec3<T>(T(0), T(0), scaled_sine(half3))});
  SpinlessPair<T> pair;
  pair.e_w = e.w, pair.y = e.v;

  const Complex<T> A_F = turn_A * sum.A, B_F = turn_B * sum.B;
  pair.ref_q_LF = Quaternion<T>{A_F.re, Vec3<T>(B_F.re, B_F.im, A_F.im)}.normalized();
  pair.ref_across = conj(turn3) * sum.ref_across;

  const Mat3<T> R_LF = rotation_matrix(pair.ref_q_LF * Quaternion<T>{e.w, epsilon_ * e.v});
  const Vec3<T> W_F = transposed_times(R_LF, W_L_);
  const T nu = plain_.nutation();
  const Complex<T> inertial = sum.across + epsilon_ * Complex<T>{nu * x[3], nu * x[4]};
  pair.across = conj(turn3) * conj(turned(T(T(2) * epsilon_ * half3))) * inertial + T(-1) * Complex<T>{W_F[0], W_F[1]};
  pair.spin_excess = epsilon_ * spin_change_ - W_F[2];
  return pair;
}

template <class T>
T FourierTop<T>::deviation_error(T t) const {
  constexpr double kPasses = 4, kRounding = 64;
  const T rounding = T(kRounding) * real::epsilon<T>();
  return epsilon_ *
         (T(kPasses) * (torus_->error() + torus_->rate_error() * t) + rounding * (torus_->size() + torus_->speed() * t));
}

/// The azimuth turns at p, and once more in each nutation for each time that the halves of the quaternion go round 0 then.
template <class T>
std::optional<T> FourierTop<T>::turning_change() const {
  const std::vector<typename PlainTorus<T>::Point>& points = plain_.points();
  T angle = T(0), least = T(1);
  const auto level = [&](std::size_t i) {
    const Quaternion<T>& q = points[i % points.size()].q;
    return Complex<T>{q.w, q.v[2]} * Complex<T>{q.v[0], q.v[1]};
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Complex<T> turn = level(i + 1) * conj(level(i));
    angle += real::atan2(turn.im, turn.re);
    least = std::min(least, T(T(2) * real::sqrt(norm2(level(i)))));
  }
  // The vertical about which the rotating axis turns, and how far its motion is moved, must lie within the cone.
  const T moved = epsilon_ * (T(2) * norm(vertical_.v) + T(4) * torus_->size());
  if (!(least > moved)) return std::nullopt;
  const T turns = real::rint(T(angle / (T(2) * real::pi<T>())));
  return torus_->rates().precession + turns * torus_->rates().nutation;
}
template <class T>
T FourierTop<T>::turning_error() const {
  constexpr double kPasses = 16, kRounding = 1024;
  const typename RotatingTorus<T>::Rates rates = torus_->rates();
  return T(kPasses) * torus_->rate_error() +
         T(kRounding) * real::epsilon<T>() * (real::abs(rates.precession) + real::abs(rates.nutation));
}

template <class T>
T FourierTop<T>::longest_step() const {
  const typename RotatingTorus<T>::Rates rates = torus_->rates();
  const T fastest =
      real::abs(rates.nutation) + real::abs(rates.precession) + real::abs(rates.axis_turn) + real::abs(spin_change_);
  const T of_deviation = T(0.5) / (epsilon_ * fastest);
  // Where the axis passes near the vertical within a nutation, its azimuth goes round.
  const auto& c = plain_.coefficients();
  const T A_0 = real::sqrt(norm2(c.A[0])), B_0 = real::sqrt(norm2(c.B[0]));
  T A_others = T(0), B_others = T(0);
  for (std::size_t i = 1; i < c.A.size(); ++i) A_others += real::sqrt(norm2(c.A[i])), B_others += real::sqrt(norm2(c.B[i]));
  constexpr double kSmall = 0.1;
  const bool is_small = A_others < T(kSmall) * A_0 && B_others < T(kSmall) * B_0;
  return is_small ? of_deviation : std::min(of_deviation, T(plain_.period() / T(12)));
}

}  // namespace earthtop
