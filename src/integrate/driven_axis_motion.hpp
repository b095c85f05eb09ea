// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion of a symmetric top's axis with applied torques, a tide or a moving pivot, for body axis 3 in double precision.
#pragma once

#include <algorithm>

#include "integrate/driven_axis_equations.hpp"
#include "integrate/motion_system.hpp"

namespace earthtop {

class DrivenAxisMotion : public WithSeries<RecordedSeries<double, DrivenAxisShape::kSize>> {
 public:
  using Shape = DrivenAxisShape;
  static constexpr std::size_t kSize = Shape::kSize;
  static constexpr bool kSeriesOnly = true;
  using State = std::array<double, kSize>;
  explicit DrivenAxisMotion(const MotionProblem<double>& problem)
      : R_LB_(rotation_matrix(problem.release.q_LB)), w_IB_B_(problem.natural_release().w_XB_B) {
    const Model<double>& model = problem.model;
    const Vec3<double> W_B = problem.release.X == RatesRelativeTo::inertial
                                 ? Vec3<double>(Vec3<double>::Zero())
                                 : Vec3<double>(transposed_times(R_LB_, model.W_IL_L));
    const ReducedTop<double> top = reduced_top(model);
    const NutationRate<double> b(top, w_IB_B_[2], W_B[2]);
    w_IB_B_ += W_B;
    if (model.journey.has_still_reference())
      w_IB_B_ += model.epsilon * rate_change_at_release(model, problem.natural_release());
    equations_ = {model, top, w_IB_B_[2], b.value, b.rest};
  }

  void operator()(const State& x, State& dxdt, double t) const { equations_(x, dxdt, t); }
  RecordedSeries<double, kSize> series() const {
    return RecordedSeries<double, kSize>([this](const State& x, double t) { return record_axis_motion(equations_, x, t); });
  }

  State initial_state() const {
    State x{};
    store_vector(R_LB_.col(2), x, 0);
    store_vector(times(R_LB_, Vec3<double>(w_IB_B_[0], w_IB_B_[1], 0)), x, 3);
    return x;
  }
  /// A state with the sizes that errors are measured against from the start: u against the nutation rate, the change of the
  /// spin against the spin.
  State typical_state() const {
    State x = initial_state();
    x[3] = std::max(norm(load_vector(x, 3)), std::abs(equations_.b));
    x[6] = std::abs(equations_.w3);
    return x;
  }

  void follow(const State&) {}
  MotionSample<double> sample(const State& x, double t) const {
    const Vec3<double> n = load_vector(x, 0);
    MotionSample<double> s;
    s.q_LB = turn_of_axis_3(n);
    s.w_LB_B = transposed_times(rotation_matrix(s.q_LB), Vec3<double>(load_vector(x, 3) - equations_.model.W_IL_L));
    s.w_LB_B[2] += equations_.w3 + x[6];
    if (!equations_.model.journey.empty()) see_rotating_from_journey(equations_.model, s, t);
    return s;
  }

 private:
  /// A turn that takes Up to n: about a horizontal axis; where n points down, about North.
  static Quaternion<double> turn_of_axis_3(const Vec3<double>& n) {
    const double horizontal = n[0] * n[0] + n[1] * n[1];
    const double w = n[2] < 0 ? horizontal / (1 - n[2]) : 1 + n[2];  // 1 + n_z without cancellation
    return w > 0 ? Quaternion<double>{w, {-n[1], n[0], 0}}.normalized() : Quaternion<double>{0, {0, 1, 0}};
  }

  Mat3<double> R_LB_;
  Vec3<double> w_IB_B_;  ///< at release
  DrivenAxisEquations<double> equations_;
};

}  // namespace earthtop
