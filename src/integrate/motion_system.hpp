// SPDX-License-Identifier: GPL-3.0-or-later
/// The right-hand sides of a single motion on the rotating Earth: in seven variables for any body, and in nine (or six) for a
/// symmetric top without its spin. Both systems give samples of the attitude and the rate in the laboratory.
#pragma once

#include <array>
#include <type_traits>

#include "earthtop/model/applied_motion.hpp"
#include "earthtop/model/equations.hpp"
#include "integrate/drive_problem.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/reduced_motion_flows.hpp"
#include "integrate/taylor/expand_series.hpp"
#include "integrate/taylor/record_motion.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {

/// A system's sample at an output time, in the SI units of the trajectory.
template <class T, class System>
MotionSample<T> sample_at(const System& system, const MotionProblem<T>& problem, const typename System::State& x, T t,
                          double t_s) {
  MotionSample<T> sample = system.sample(x, t);
  sample.t_s = T(t_s);
  for (int i = 0; i < 3; ++i) sample.w_LB_B[i] = problem.units.rate_to_rad_s(sample.w_LB_B[i]);
  return sample;
}

/// The base classes that tell whether a system has a Taylor series.
template <class Made>
struct WithSeries {
  using Series = Made;
};
struct WithoutSeries {};

/// The shape of a state: attitude and rate, and with a rotor its momentum about its axis.
template <SceneKind K>
struct GeneralMotionShape {
  static constexpr std::size_t kSize = K == SceneKind::gyrostat ? 8 : 7;
  static constexpr auto groups() {
    constexpr std::array<ComponentGroup, 3> all{{{0, 4, 1.0}, {4, 3, 1e-3}, {7, 1, 1e-3}}};
    if constexpr (K == SceneKind::gyrostat)
      return all;
    else
      return std::array<ComponentGroup, 2>{all[0], all[1]};
  }
};

/// Any body's motion. The state is the attitude q (4), then the observer's rate variable (3): an angular momentum or, in body
/// axes, the inertial rate. With a rotor (rotor.hpp) its momentum h about its axis follows.
template <class T, Observer O, SceneKind K>
class GeneralMotionSystem
    : public std::conditional_t<O != Observer::body, WithoutSeries,
                                std::conditional_t<K == SceneKind::plain, WithSeries<GeneralMotionSeries<T>>,
                                                   WithSeries<RecordedSeries<T, GeneralMotionShape<K>::kSize>>>> {
 public:
  static constexpr bool kGyrostat = K == SceneKind::gyrostat;
  static_assert(!kGyrostat || O == Observer::body, "a gyrostat's single motion has body axes only");
  using Shape = GeneralMotionShape<K>;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<T, kSize>;
  explicit GeneralMotionSystem(const MotionProblem<T>& problem)
      : problem_(problem), model_(problem.model), in_time_(problem.model) {}

  EARTHTOP_INLINE_ALL void operator()(const State& x, State& dxdt, T t) const {
    const Model<T>& model = in_time_.at(t);
    const Motion<T> motion = load(x);
    const Vec3<T> field_L = pivot_field<K>(model, t).rotating_L;
    Motion<T> rate;
    if constexpr (O == Observer::laboratory)
      rate = laboratory_equation(model, motion, field_L, non_inertial_torque<K>(model, motion));
    else if constexpr (O == Observer::body)
      rate = body_equation<true, K>(model, motion, field_L, inside(x, t));
    else
      rate = inertial_equation<true, K>(model, motion, field_L, rotation_matrix(turn(t)));
    if constexpr (K != SceneKind::plain)
      if (model.applied.any) rate.m += applied_share(motion, t);
    store(rate, dxdt);
    if constexpr (kGyrostat) dxdt[7] = inside(x, t).torque;
  }

  auto series() const {
    if constexpr (K == SceneKind::plain)
      return GeneralMotionSeries<T>(model_);
    else
      return RecordedSeries<T, kSize>([this](const State& x, T t) { return record_motion<T>(model_, x, t); });
  }

  State initial_state() const {
    auto [q_LB, w_XB_B, X] = problem_.natural_release();
    const Mat3<T> R_LB = rotation_matrix(q_LB);
    const Vec3<T> W_B = R_LB.transpose() * model_.W_IL_L;
    if (model_.journey.has_still_reference())
      w_XB_B += model_.epsilon * rate_change_at_release(model_, problem_.natural_release());
    const bool inertial = X == RatesRelativeTo::inertial;
    const Vec3<T> w_LB_B = inertial ? Vec3<T>(w_XB_B - W_B) : w_XB_B;
    const Vec3<T> w_IB_B = inertial ? w_XB_B : Vec3<T>(w_XB_B + W_B);
    State x;
    if constexpr (O == Observer::laboratory)
      store({q_LB, R_LB * (model_.I_BP_B * w_LB_B)}, x);
    else if constexpr (O == Observer::body)
      store({q_LB, w_IB_B}, x);
    else
      store({q_LB, R_LB * (model_.I_BP_B * w_IB_B)}, x);
    // The rate of a rotor relative to the body is given.
    if constexpr (kGyrostat) x[7] = model_.rotor.axial * (model_.rotor.axis_B.dot(w_IB_B) + model_.rotor.spin);
    return x;
  }

  /// The round-off of the initial state, in which the Earth's rate is added to the rates given. That of a spin would grow with
  /// the duration to an error of the attitude.
  State initial_rest() const {
    State rest{};
    const auto [q_LB, w_XB_B, X] = problem_.natural_release();
    if (O != Observer::body || X == RatesRelativeTo::inertial) return rest;
    const Vec3<T> W_B = rotation_matrix(q_LB).transpose() * model_.W_IL_L;
    for (int i = 0; i < 3; ++i) {
      const T sum = w_XB_B[i] + W_B[i], of_earth = sum - w_XB_B[i];
      rest[4 + static_cast<std::size_t>(i)] = (w_XB_B[i] - (sum - of_earth)) + (W_B[i] - of_earth);
    }
    return rest;
  }

  void follow(const State&) {}
  MotionSample<T> sample(const State& x, T t) const {
    MotionSample<T> s = seen_in_laboratory(load(x), t);
    if (!model_.journey.empty()) see_rotating_from_journey(model_, s, t);
    return s;
  }

 private:
  MotionSample<T> seen_in_laboratory(const Motion<T>& motion, T t) const {
    MotionSample<T> s;
    s.q_LB = motion.q;
    if constexpr (O == Observer::inertial) s.q_LB = turn(t).conjugate() * motion.q;
    const Mat3<T> R_LB = rotation_matrix(s.q_LB);
    if constexpr (O == Observer::body)
      s.w_LB_B = motion.m;
    else
      s.w_LB_B = times(model_.I_BP_B_inverse, transposed_times(rotation_matrix(motion.q), motion.m));
    if constexpr (O != Observer::laboratory) s.w_LB_B -= transposed_times(R_LB, model_.W_IL_L);
    return s;
  }
  auto inside([[maybe_unused]] const State& x, [[maybe_unused]] T t) const {
    if constexpr (kGyrostat)
      return rotor_inside(model_.rotor, x[7], t, in_time_.masses_at(t), [&](const Vec3<T>&) { return load(x).m; });
    else
      return NothingInside{};
  }
  /// The contribution of the applied torques to the time derivative of the observer's rate variable.
  [[gnu::noinline]] Vec3<T> applied_share(const Motion<T>& motion, T t) const {
    const MotionSample<T> seen = seen_in_laboratory(motion, t);
    const Model<T>& model = in_time_.at(t);
    const Vec3<T> torque_B = applied_torque_B(model, t, seen.q_LB, seen.w_LB_B, true);
    if constexpr (O == Observer::body)
      return times(model.I_BP_B_inverse, torque_B);
    else
      return times(rotation_matrix(motion.q), torque_B);
  }
  static Motion<T> load(const State& x) { return {{x[0], {x[1], x[2], x[3]}}, {x[4], x[5], x[6]}}; }
  static void store(const Motion<T>& m, State& x) {
    x[0] = m.q.w;
    store_vector(m.q.v, x, 1);
    store_vector(m.m, x, 4);
  }
  Quaternion<T> turn(T t) const { return laboratory_turn(model_, t).quaternion(model_.epsilon); }

  const MotionProblem<T>& problem_;
  const Model<T>& model_;
  ModelOfKind<K, T> in_time_;
};

/// The shape of a state: axis and transverse rate, and the frame vector where the attitude is sought.
template <MotionSought S>
struct ReducedMotionShape {
  static constexpr std::size_t kSize = S == MotionSought::attitude ? 9 : 6;
  static constexpr auto groups() {
    constexpr std::array<ComponentGroup, 3> all{{{0, 3, 1.0}, {3, 3, 1e-3}, {6, 3, 1.0}}};
    if constexpr (S == MotionSought::attitude)
      return all;
    else
      return std::array<ComponentGroup, 2>{all[0], all[1]};
  }
};

/// A symmetric top's motion without its spin (reduced_top.hpp). The state is the axis n (3), the transverse rate u (3) and,
/// where the attitude is sought, the frame vector a (3); in laboratory or in inertial axes.
template <class T, Observer O, MotionSought S>
class ReducedMotionSystem
    : public std::conditional_t<O == Observer::laboratory, WithSeries<ReducedMotionSeries<T, S>>, WithoutSeries> {
 public:
  static_assert(O != Observer::body);
  static constexpr bool kAttitude = S == MotionSought::attitude;
  static constexpr bool kWatched = kAttitude;
  using Shape = ReducedMotionShape<S>;
  static constexpr std::size_t kSize = Shape::kSize;
  using State = std::array<T, kSize>;
  explicit ReducedMotionSystem(const MotionProblem<T>& problem)
      : model_(problem.model),
        top_(reduced_top(problem.model)),
        R_LB_(rotation_matrix(problem.release.q_LB)),
        w_XB_B_(problem.natural_release().w_XB_B),
        W_B_(problem.release.X == RatesRelativeTo::inertial ? Vec3<T>(Vec3<T>::Zero())
                                                            : Vec3<T>(R_LB_.transpose() * model_.W_IL_L)),
        W_L_(model_.W_IL_L),
        gravity_L_(model_.apparent_gravity_L),
        b_(top_, w_XB_B_[top_.axis], W_B_[top_.axis]),
        frame_(top_.axis, problem.release.q_LB, w_XB_B_[top_.axis], W_B_[top_.axis]) {}

  EARTHTOP_INLINE_ALL void operator()(const State& x, State& dxdt, T t) const {
    Vec3<T> W_A = W_L_, gravity_A = gravity_L_;
    if constexpr (O == Observer::inertial) {
      W_A = Vec3<T>::Zero();
      gravity_A = times(rotation_matrix(turn(t)), gravity_L_);
    }
    const AxisMotion<T> motion{load(x, 0), load(x, 3)};
    const Vec3<T> s_A = motion.u.cross(motion.n);
    const AxisMotion<T> rate = axis_equation(top_, motion, s_A, b_.value, W_A, gravity_A);
    store(rate.n, dxdt, 0), store(rate.u, dxdt, 3);
    if constexpr (kAttitude) store(spinless_frame_equation(motion.n, s_A, load(x, 6), W_A), dxdt, 6);
  }

  ReducedMotionSeries<T, S> series() const { return {top_, b_, W_L_, gravity_L_}; }
  const ReducedTop<T>& top() const { return top_; }
  const NutationRate<T>& nutation_rate() const { return b_; }

  State initial_state() const {
    State x;
    store(R_LB_.col(top_.axis), x, 0);
    Vec3<T> transverse_rate_B = w_XB_B_ + W_B_;
    transverse_rate_B[top_.axis] = T(0);
    store(times(R_LB_, transverse_rate_B), x, 3);
    if constexpr (kAttitude) store(R_LB_.col((top_.axis + 1) % 3), x, 6);
    return x;
  }

  /// A state with the sizes that errors are measured against from the start. That of u is at least the nutation rate b: an
  /// error of u tilts the axis only by its ratio to b.
  State typical_state() const {
    State x = initial_state();
    x[3] = std::max(norm(load(x, 3)), real::abs(b_.value));
    return x;
  }
  /// The two exact flows of the motion, for `splitting`; in double only.
  auto flows() const requires std::is_same_v<T, double> { return ReducedMotionFlows<O, S>(model_, top_, b_.value); }

  void follow(const State& x) {
    if constexpr (kAttitude) frame_.follow(load(x, 0), load(x, 6));
  }
  MotionSample<T> sample(const State& x, T t) const {
    MotionSample<T> s;
    const Vec3<T> n = load(x, 0);
    Vec3<T> a;
    if constexpr (kAttitude)
      a = load(x, 6);
    else
      a = real::abs(n[2]) < T(0.7) ? Vec3<T>(-n[1], n[0], T(0)) : Vec3<T>(T(0), -n[2], n[1]);  // any that is across n
    const Quaternion<T> q_AB = frame_.attitude(n, a, t);
    s.q_LB = q_AB;
    if constexpr (O == Observer::inertial) s.q_LB = turn(t).conjugate() * q_AB;
    s.w_LB_B = transposed_times(rotation_matrix(q_AB), load(x, 3));
    s.w_LB_B[top_.axis] = w_XB_B_[top_.axis] + W_B_[top_.axis];
    s.w_LB_B -= transposed_times(rotation_matrix(s.q_LB), model_.W_IL_L);
    return s;
  }

 private:
  static Vec3<T> load(const State& x, std::size_t at) { return load_vector(x, at); }
  static void store(const Vec3<T>& v, State& x, std::size_t at) { store_vector(v, x, at); }
  Quaternion<T> turn(T t) const { return laboratory_turn(model_, t).quaternion(model_.epsilon); }

  const Model<T>& model_;
  ReducedTop<T> top_;
  Mat3<T> R_LB_;
  Vec3<T> w_XB_B_;           ///< rate as given at release
  Vec3<T> W_B_;              ///< what is to be added to make it the inertial rate
  Vec3<T> W_L_, gravity_L_;  ///< copies of the model's
  NutationRate<T> b_;
  SpinlessFrame<T> frame_;
};

}  // namespace earthtop
