// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds how a small change of the rate at release changes an exact motion, without cancellation however small the change is.
#pragma once

#include <memory>

#include "closed_form/followed_motion.hpp"
#include "closed_form/wider.hpp"

namespace earthtop {

/// The difference d = q_rot q_ref^* of two motions of one body that start at the same attitude: the reference with the rate w0,
/// the rotating motion with w0 + lambda u, where u is a unit vector.
///
/// Closed forms in 113 bits leave room for one subtraction: where the motions differ by 1e-11 rad, twenty digits of the
/// difference are left. Where they differ by less, d/lambda is taken from motions with larger changes +a and -a of the rate
/// instead. As d is analytic in lambda,
///   d(lambda) = lambda/a [ (d(a) - d(-a))/2 + lambda/a (d(a) + d(-a))/2 ]    to second order.
/// The change a is so small that |d(+-a)| <= 1e-11 and the second order is at most 1e-10 of the first; then the third order is
/// at most 1e-20 of the first, and mostly 1e-22. As d grows with time, a has to shrink and never grows again, so that times
/// must not decrease by more than a step.
class RateChange {
 public:
  using W = float128;
  struct Value {
    W w = W(1);
    Vec3<W> v_over_lambda = Vec3<W>::Zero();
    W relative_error = W(0);  ///< of v_over_lambda: that stated by the closed forms, and the orders left out
    /// With a rotor, of the turn about its body axis and of the rate about it.
    W turn_over_lambda = W(0), rate_over_lambda = W(0);
  };

  /// @param lambda  not 0   @param first_time  the first one asked for, above 0
  RateChange(const ExactBody<W>& body, const Quaternion<W>& q0_NB, const Vec3<W>& w0_B, const Vec3<W>& u_B, W lambda,
             W first_time)
      : body_(body), q0_NB_(q0_NB), w0_B_(w0_B), u_B_(u_B), lambda_(lambda), reference_(body, q0_NB, w0_B) {
    reach_to(W(kLargest) / first_time);
  }

  /// The difference at t. @param near_ref, near_rot  the two attitudes roughly, with the signs that the result shall have
  Value at(W t, const Quaternion<double>& near_ref, const Quaternion<double>& near_rot) {
    const ClosedFormState<W> ref = reference_.at(t);
    while (!is_direct()) {
      const ClosedFormState<W> plus = plus_->at(t), minus = minus_->at(t);
      const Vec3<W> d_plus = difference(plus, ref).v, d_minus = difference(minus, ref).v;
      const Vec3<W> odd = (d_plus - d_minus) / W(2), even = (d_plus + d_minus) / W(2);
      const W stated = std::max(plus.attitude_error, minus.attitude_error) + ref.attitude_error;
      const W size = std::max(norm(d_plus), norm(d_minus)), slope = std::max(steepest_, norm(odd) / a_);
      const W second_order = ratio(norm(even), slope * a_);
      const bool straight = second_order <= W(kLargestSecond) || norm(even) <= stated;
      if (size <= W(kLargest) && straight) {
        steepest_ = slope;
        Value value;
        value.v_over_lambda = (odd + (lambda_ / a_) * even) / a_;
        const W v = lambda_ * norm(value.v_over_lambda);
        value.w = real::sqrt((W(1) - v) * (W(1) + v));
        if (has_rotor()) {
          const Axial ref_axial = axial(reference_, ref, t);
          const Axial p = axial(*plus_, plus, t).minus(ref_axial), m = axial(*minus_, minus, t).minus(ref_axial);
          const auto change = [&](const W& of_plus, const W& of_minus) {
            return W(((of_plus - of_minus) / W(2) + (lambda_ / a_) * ((of_plus + of_minus) / W(2))) / a_);
          };
          value.turn_over_lambda = change(p.turn, m.turn), value.rate_over_lambda = change(p.rate, m.rate);
        }
        value.relative_error = ratio(stated, norm(odd)) + size * size + second_order * second_order + start_rounding(a_);
        return value;
      }
      reach_to(a_ / W(kShrink));
    }
    const ClosedFormState<W> rot = plus_->at(t);
    Quaternion<W> d = with_sign_of(near_rot, rot.q_NB) * with_sign_of(near_ref, ref.q_NB).conjugate();
    const W size = real::hypot(d.w, norm(d.v));
    Value value{d.w / size, d.v / (size * lambda_),
                ratio(rot.attitude_error + ref.attitude_error, norm(d.v)) + start_rounding(lambda_)};
    if (has_rotor()) {
      const Axial change = axial(*plus_, rot, t).minus(axial(reference_, ref, t));
      value.turn_over_lambda = change.turn / lambda_, value.rate_over_lambda = change.rate / lambda_;
    }
    return value;
  }

  const Vec3<W>& direction_B() const { return u_B_; }  ///< u

 private:
  static constexpr double kLargest = 1e-11;
  static constexpr double kLargestSecond = 1e-10;  ///< largest ratio of the even part of d to the odd one
  static constexpr double kShrink = 32;

  bool has_rotor() const { return body_.rotor.axis >= 0; }
  /// The turn and the rate about the body axis of a rotor.
  struct Axial {
    W turn, rate;
    Axial minus(const Axial& other) const { return {turn - other.turn, rate - other.rate}; }
  };
  Axial axial(const ExactMotion<W>& motion, const ClosedFormState<W>& state, W t) const {
    return {motion.axial_turn(t).angle, state.w_NB_B[body_.rotor.axis]};
  }

  /// Whether the change lambda itself is large enough for a plain difference, and `a` is not used.
  bool is_direct() const { return a_ <= W(4) * real::abs(lambda_); }
  void reach_to(W a) {
    a_ = a;
    if (is_direct()) {
      plus_ = std::make_unique<ExactMotion<W>>(body_, q0_NB_, Vec3<W>(w0_B_ + lambda_ * u_B_));
      minus_.reset();
    } else {
      plus_ = std::make_unique<ExactMotion<W>>(body_, q0_NB_, Vec3<W>(w0_B_ + a_ * u_B_));
      minus_ = std::make_unique<ExactMotion<W>>(body_, q0_NB_, Vec3<W>(w0_B_ - a_ * u_B_));
    }
  }
  /// q q_ref^*, with the sign for which w > 0.
  static Quaternion<W> difference(const ClosedFormState<W>& x, const ClosedFormState<W>& ref) {
    const Quaternion<W> d = x.q_NB * ref.q_NB.conjugate();
    return d.w < W(0) ? Quaternion<W>{-d.w, -d.v} : d;
  }
  /// The relative error of the change that comes from rounding the changed rate, and with it a rotor's momentum.
  W start_rounding(W change) const {
    return real::epsilon<W>() * (norm(w0_B_) + real::abs(body_.rotor.spin)) / real::abs(change);
  }
  static W ratio(W error, W size) { return size > W(0) ? error / size : error > W(0) ? W(1) : W(0); }

  ExactBody<W> body_;
  Quaternion<W> q0_NB_;
  Vec3<W> w0_B_, u_B_;
  W lambda_, a_ = W(0);
  W steepest_ = W(0);  ///< the largest |d| / a so far
  ExactMotion<W> reference_;
  std::unique_ptr<ExactMotion<W>> plus_, minus_;
};

}  // namespace earthtop
