// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/closed_form_drift.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "drift/deviation_state.hpp"
#include "drift/drift_at_any_time.hpp"
#include "drift/rate_change.hpp"
#include "integrate/closed_form_motion.hpp"
#include "integrate/natural_times.hpp"

namespace earthtop {
namespace {

/// The two motions and their deviation at any time from the release onward, in natural units.
template <class T>
class ExactPair {
 public:
  using W = RateChange::W;

  ExactPair(const DriftProblem<T>& problem, const std::vector<T>& times)
      : problem_(problem),
        body_(exact_body(problem.model)),
        w0_ref_B_(problem.natural_release().w_XB_B),
        w0_rot_B_(problem.natural_release().inertial_rate_B(problem.model.W_IL_L)),
        reference_(body_, problem.release.q_LB, w0_ref_B_),
        followed_reference_(follow(w0_ref_B_)) {
    const bool one_motion = problem.release.X == RatesRelativeTo::inertial || problem.model.W_IL_L == Vec3<T>::Zero();
    if (one_motion) return;
    rotating_.emplace(body_, problem.release.q_LB, w0_rot_B_);
    followed_rotating_.emplace(follow(w0_rot_B_));
    if (times.size() < 2) return;
    const Vec3<W> W_scaled = converted<W>(problem.model.W_IL_L_scaled);
    const Quaternion<W> q0 = converted<W>(problem.release.q_LB);
    const W size = norm(W_scaled);
    rate_scaled_ = size;
    wide_model_.epsilon = W(problem.model.epsilon);
    wide_model_.W_IL_L_scaled = W_scaled;
    change_.emplace(body_.template as<W>(), q0, converted<W>(w0_ref_B_),
                    Vec3<W>(transposed_times(rotation_matrix(q0), W_scaled) / size), W(problem.model.epsilon) * size,
                    W(times[1]));
  }

  /// Follows both motions to t, at most `longest_step` after the time followed to before.
  void advance(double t) {
    followed_reference_.advance(t);
    if (followed_rotating_) followed_rotating_->advance(t);
  }
  /// The time in which both motions and the laboratory together turn by about a radian.
  double radian_time() const {
    const double of_rotating = followed_rotating_ ? followed_rotating_->turn_rate() : 0;
    return 1 / (followed_reference_.turn_rate() + of_rotating + static_cast<double>(norm(problem_.model.W_IL_L)));
  }

  double longest_step() const { return radian_time(); }
  double watch_step() const { return radian_time(); }

  /// The deviation at the time followed to, only roughly: from attitudes in double.
  DriftState<double> followed_state(double t) const {
    // The deviation is not divided by epsilon here (it is 1): the rounding of attitudes over a tiny epsilon would overflow.
    Model<double> model;
    model.W_IL_L_scaled = converted<double>(problem_.model.W_IL_L);
    Deviation<double> deviation;
    if (followed_rotating_) {
      const Quaternion<double> d = followed_rotating_->attitude() * followed_reference_.attitude().conjugate();
      deviation.w = d.w;
      deviation.y = d.v;
    }
    return seen_from_laboratory<Observer::inertial>(model, followed_reference_.attitude(), deviation, t);
  }

  /// The state at t, with rates in natural units; `t_s` is left to the caller. At times other than the one followed to,
  /// quaternions may have the wrong sign; angles between axes are right at any time.
  DriftState<T> state(T t) {
    const Model<T>& model = problem_.model;
    change_seen_ = {};
    const ClosedFormState<T> ref = reference_.at(t);
    attitude_error_ = ref.attitude_error;
    const Quaternion<T> ref_q_NB = with_sign_of(followed_reference_.attitude(), ref.q_NB);
    DriftState<T> s = seen_from_laboratory<Observer::inertial>(model, ref_q_NB, Deviation<T>{}, t);
    deviation_error_ = turn_error<T>(t);
    Vec3<T> w_IB_B = ref.w_NB_B;
    if (rotating_) {
      const ClosedFormState<T> rot = rotating_->at(t);
      w_IB_B = rot.w_NB_B;
      attitude_error_ = std::max(attitude_error_, rot.attitude_error);
      if (change_ && t > T(0)) {
        const RateChange::Value change = change_->at(W(t), followed_reference_.attitude(), followed_rotating_->attitude());
        change_seen_ = change;
        // Soon after the release the laboratory's turn nearly cancels the deviation. So the difference is taken in 113 bits,
        // before it is rounded to T.
        const Vec3<W> y = rate_scaled_ * change.v_over_lambda;
        const DriftState<W> seen = seen_from_laboratory<Observer::inertial>(wide_model_, Quaternion<W>{}, {change.w, y}, W(t));
        s.e_w = static_cast<T>(seen.e_w);
        s.e_v_scaled = transposed_times(rotation_matrix(ref_q_NB), converted<T>(seen.e_v_scaled));
        const W error = W(2) * change.relative_error * wide_model_.epsilon * norm(y) + turn_error<W>(W(t));
        deviation_error_ = static_cast<T>(error);
      }
    }
    if (body_.rotor.axis >= 0) s.watched_axis_B = model.rotor.axis_B;
    s.ref_w_LB_B = ref.w_NB_B;
    s.q_LB = s.ref_q_LB * Quaternion<T>{s.e_w, s.epsilon * s.e_v_scaled}.normalized();
    s.w_LB_B = w_IB_B - transposed_times(rotation_matrix(s.q_LB), model.W_IL_L);
    return s;
  }
  /// The rotor at the time of the last state, with rates in rad/s; null for a body without one.
  /// @param both  the last state, with rates in natural units
  std::shared_ptr<const RotorState<T>> rotor(T t, const DriftState<T>& both) const {
    const ExactRotor<T>& rotor = body_.rotor;
    if (rotor.axis < 0) return nullptr;
    const NaturalUnits& units = problem_.units;
    const T start = w0_ref_B_[rotor.axis], turn = reference_.axial_turn(t).angle;
    // Both start at the same rate relative to the body, and their bodies at rates that differ by that of the change.
    RotorState<T> made;
    if (change_ && t > T(0)) {
      const W at_start = change_->direction_B()[rotor.axis], rate = change_seen_.rate_over_lambda - at_start;
      const W angle = change_seen_.turn_over_lambda - at_start * W(t);
      made.rate_difference_scaled = units.rate_to_rad_s(rotor.minus_body(static_cast<T>(rate_scaled_ * rate)));
      made.angle_difference_scaled = rotor.minus_body(static_cast<T>(rate_scaled_ * angle));
    }
    made.ref_rate = units.rate_to_rad_s(T(rotor.spin + rotor.minus_body(both.ref_w_LB_B[rotor.axis] - start)));
    made.rate = made.ref_rate + problem_.model.epsilon * made.rate_difference_scaled;
    made.ref_angle = rotor.spin * t + rotor.minus_body(turn - start * t);
    made.angle = made.ref_angle + problem_.model.epsilon * made.angle_difference_scaled;
    made.axis_B = problem_.model.rotor.axis_B;
    made.axis = drift_of_axis(both, made.axis_B);
    return std::make_shared<const RotorState<T>>(made);
  }
  /// Bound on the error of both attitudes in the last state.
  T attitude_error(T t) const { return attitude_error_ + turn_error<T>(t); }
  /// Bound on the error of the drift in the last state: from the error of the reference's attitude, which turns the deviation,
  /// and from that of the deviation itself.
  T drift_error(T attitude_drift) const { return T(2) * attitude_error_ * attitude_drift + deviation_error_; }

 private:
  FollowedMotion follow(const Vec3<T>& w0_B) const {
    return {body_.template as<double>(), converted<double>(problem_.release.q_LB), converted<double>(w0_B)};
  }
  /// The rounding error of the laboratory's turn.
  template <class U>
  U turn_error(U t) const {
    return U(4) * real::epsilon<U>() * static_cast<U>(norm(problem_.model.W_IL_L)) * t;
  }

  const DriftProblem<T>& problem_;
  ExactBody<T> body_;
  Vec3<T> w0_ref_B_, w0_rot_B_;
  ExactMotion<T> reference_;
  std::optional<ExactMotion<T>> rotating_;  ///< none where both are one motion in inertial space
  FollowedMotion followed_reference_;
  std::optional<FollowedMotion> followed_rotating_;
  std::optional<RateChange> change_;
  Model<W> wide_model_;            ///< has only the Earth's rate and epsilon
  W rate_scaled_ = W(0);           ///< the Earth's rate over epsilon
  RateChange::Value change_seen_;  ///< in the last state
  T attitude_error_ = T(0), deviation_error_ = T(0);
};

}  // namespace

template <class T>
DriftTrajectory<T> closed_form_drift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  const std::vector<T> times = natural_times(problem);
  ExactPair<T> pair(problem, times);
  return drift_at_any_time(pair, problem, times, options, watch);
}
template DriftTrajectory<double> closed_form_drift(const DriftProblem<double>&, const IntegrationOptions&, const Watch&);
template DriftTrajectory<float80> closed_form_drift(const DriftProblem<float80>&, const IntegrationOptions&, const Watch&);
template DriftTrajectory<float128> closed_form_drift(const DriftProblem<float128>&, const IntegrationOptions&, const Watch&);

}  // namespace earthtop
