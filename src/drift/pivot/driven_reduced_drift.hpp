// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift integration of a symmetric top without its spin, with applied torques, a tide or a moving pivot.
#pragma once

#include "drift/pivot/driven_reduced_equations.hpp"
#include "drift/pivot/record_drift.hpp"
#include "integrate/motion_system.hpp"
#include "integrate/taylor/recorded_series.hpp"

namespace earthtop {

/// @tparam O  laboratory, or inertial, in whose axes the laboratory's vectors turn
template <class T, Observer O>
class DrivenReducedDrift : public WithSeries<RecordedSeries<T, DrivenReducedShape::kSize>> {
 public:
  using Shape = DrivenReducedShape;
  static constexpr std::size_t kSize = Shape::kSize;
  static constexpr bool kSeriesOnly = true;
  using State = std::array<T, kSize>;

  DrivenReducedDrift(const Model<T>& model, const NaturalRelease<T>& release)
      : release_(release),
        top_(reduced_top(model)),
        b_(top_, release.w_XB_B[top_.axis]),
        equations_{model, top_, release.w_XB_B[top_.axis], initial_rate_deviation_B(model)[top_.axis], b_.value, b_.rest},
        frame_(top_.axis, release.q_LB, release.w_XB_B[top_.axis]) {}

  const DrivenReducedEquations<T, O>& equations() const { return equations_; }
  void operator()(const State& x, State& dxdt, T t) const { equations_(x, dxdt, t); }
  RecordedSeries<T, kSize> series() const {
    return RecordedSeries<T, kSize>([this](const State& x, T t) { return record_spinless<T>(equations_, x, t); });
  }

  /// The state at release, where both motions have the same attitude and the same rates of the kind that the release names.
  State initial_state() const {
    const Mat3<T> R_LB = rotation_matrix(release_.q_LB);
    const Vec3<T> difference_B = initial_rate_deviation_B(equations_.model);
    State x{};
    store_vector(R_LB.col(top_.axis), x, 0);
    store_vector(times(R_LB, transverse(release_.w_XB_B)), x, 3);
    store_vector(R_LB.col((top_.axis + 1) % 3), x, 6);
    x[11] = T(1);
    store_vector(times(R_LB, transverse(difference_B)), x, 15);
    x[18] = difference_B[top_.axis];
    return x;
  }
  /// A state with the sizes that errors are measured against from the start: u against the nutation rate, the change of the
  /// spin against the spin.
  State typical_state() const {
    State x = initial_state();
    x[3] = std::max(norm(load_vector(x, 3)), real::abs(b_.value));
    x[9] = real::abs(equations_.w3);
    return x;
  }

  void follow(const State& x) { frame_.follow(load_vector(x, 0), load_vector(x, 6)); }
  /// The frame last followed, which gives attitudes their signs; for another integration that goes on from here.
  const SpinlessFrame<T>& followed() const { return frame_; }
  void go_on_from(const SpinlessFrame<T>& followed) { frame_ = followed; }
  T largest_step() const {
    const T spin = real::abs(equations_.w3);
    return top_.axis == 2 || spin == T(0) ? T(0) : T(1) / spin;
  }

  DriftState<T> shared_state(const State& x, T t) const { return seen_from_journey(equations_.model, state_in_A(x, t), t); }
  /// The part of the shared state that the drift is measured from; a common turn about axis 3 is left out.
  DriftState<T> deviation_state(const State& x, T t) const {
    const Quaternion<T> ref_q_LF = top_.axis == 2 ? frame_.frame(load_vector(x, 0), load_vector(x, 6)) : attitude(x, t);
    const DriftState<T> in_A = seen_from_laboratory<O>(equations_.model, ref_q_LF, deviation(x), t);
    return deviation_from_journey(equations_.model, in_A, t);
  }

 private:
  DriftState<T> state_in_A(const State& x, T t) const {
    const T epsilon = equations_.model.epsilon;
    DriftState<T> s = seen_from_laboratory<O>(equations_.model, attitude(x, t), deviation(x), t);
    const Mat3<T> R_ref = rotation_matrix(s.ref_q_LB);
    s.ref_w_LB_B = transposed_times(R_ref, load_vector(x, 3));
    s.ref_w_LB_B[top_.axis] = equations_.w3 + x[9];
    const Vec3<T> v = load_vector(x, 15) + x[18] * load_vector(x, 0);
    s.q_LB = s.ref_q_LB * Quaternion<T>{s.e_w, epsilon * s.e_v_scaled}.normalized();
    const Vec3<T> w_IB_B = s.ref_w_LB_B + epsilon * transposed_times(R_ref, v);
    s.w_LB_B = w_IB_B - transposed_times(rotation_matrix(s.q_LB), equations_.model.W_IL_L);
    return s;
  }
  static Deviation<T> deviation(const State& x) { return {x[11], load_vector(x, 12), load_vector(x, 15)}; }
  Quaternion<T> attitude(const State& x, T t) const {
    return frame_.attitude(load_vector(x, 0), load_vector(x, 6), t) * steady_turn(top_.axis, x[10], T(1));
  }
  /// (w_IB_rot - w_IB_ref) / epsilon at release.
  Vec3<T> initial_rate_deviation_B(const Model<T>& model) const {
    if (release_.X == RatesRelativeTo::inertial) return Vec3<T>::Zero();
    if (model.journey.has_still_reference()) return rate_change_at_release(model, release_);
    return transposed_times(rotation_matrix(release_.q_LB), model.W_IL_L_scaled);
  }
  Vec3<T> transverse(Vec3<T> v_B) const {
    v_B[top_.axis] = T(0);
    return v_B;
  }

  NaturalRelease<T> release_;
  ReducedTop<T> top_;
  NutationRate<T> b_;
  DrivenReducedEquations<T, O> equations_;
  SpinlessFrame<T> frame_;  ///< the reference's frame, without the change of the spin
};

}  // namespace earthtop
