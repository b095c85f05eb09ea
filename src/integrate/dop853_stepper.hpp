// SPDX-License-Identifier: GPL-3.0-or-later
/// Dormand and Prince's method of order 8(5,3) with dense output of order 7, on odeint's dense-output-stepper concept, with
/// steps that may be rejected. The error is controlled by component groups (group_norms.hpp), the state summed with
/// compensation.
///
/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., sections II.5 (the method and its error
/// estimate, eq. (10.17)), II.4 (step control), II.6 (the interpolant).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "earthtop/elementary.hpp"
#include "integrate/dop853_coefficients.hpp"
#include "integrate/group_norms.hpp"

namespace earthtop {

/// @tparam Shape  the shape of the state, see GroupScales
template <class Shape>
class Dop853Stepper {
 public:
  static constexpr std::size_t N = Shape::kSize;
  using State = std::array<double, N>;

  Dop853Stepper(double relative_tolerance, const GroupScales<double, Shape>& scales)
      : tolerance_(relative_tolerance), scales_(&scales) {}

  void initialize(const State& x, double t, double dt) {
    x_ = before_ = x;
    carry_ = {};
    t_ = t_before_ = t;
    t_carry_ = 0;
    dt_ = dt;
    first_ = true, rejected_ = interpolates_ = false;
  }

  /// Attempts a step. @returns whether its error allows it; if not, the next attempt will be shorter
  template <class RightHandSide>
  bool try_step(const RightHandSide& system) {
    if (first_)
      system(x_, k_[0], t_);
    else if (!rejected_)
      k_[0] = k_[12];  // the slope at the end of the last step; the interpolant of that step needed both
    first_ = false;
    State stage;
    sum_stages(system, stage, std::make_index_sequence<11>());
    State increment, after, carry;
    add_up<12, 12>(increment);
    for (std::size_t i = 0; i < N; ++i) {
      const double y = increment[i] * dt_ + carry_[i];
      after[i] = x_[i] + y;
      carry[i] = y - (after[i] - x_[i]);
    }
    const double error = step_error();
    const double factor = std::clamp(0.9 * real::pow(std::max(error, 1e-20), -1.0 / 8), 0.2, 6.0);
    if (!(error <= 1) || !all_finite(after)) {
      dt_ *= std::min(factor, 0.9);
      rejected_ = true;
      return false;
    }
    system(after, k_[12], t_ + dt_);
    before_ = x_, x_ = after, carry_ = carry;
    t_before_ = t_;
    taken_ = dt_;
    const double y = dt_ + t_carry_;
    t_ = t_before_ + y;
    t_carry_ = y - (t_ - t_before_);
    dt_ *= rejected_ ? std::min(factor, 1.0) : factor;
    rejected_ = false;
    interpolates_ = false;
    return true;
  }

  /// Prepares the interpolant of the step last taken. Has to be called before calc_state and state_after.
  template <class RightHandSide>
  void prepare_interpolant(const RightHandSide& system) {
    if (interpolates_) return;
    interpolates_ = true;
    State stage;
    add_stage<13>(system, before_, stage, taken_, t_before_);
    add_stage<14>(system, before_, stage, taken_, t_before_);
    add_stage<15>(system, before_, stage, taken_, t_before_);
    for (std::size_t i = 0; i < N; ++i) {
      const double rise = x_[i] - before_[i], left = taken_ * k_[0][i] - rise;
      coefficient_[0][i] = rise, coefficient_[1][i] = left, coefficient_[2][i] = rise - taken_ * k_[12][i] - left;
    }
    interpolant_rows(std::make_index_sequence<4>());
  }
  /// The state at a time t within the step last taken.
  void calc_state(double t, State& x) const { state_after(t - t_before_, x); }
  /// The state at the time dt after the beginning of that step.
  void state_after(double dt, State& x) const {
    const double s = dt / taken_, r = 1 - s;
    const auto& c = coefficient_;
    for (std::size_t i = 0; i < N; ++i)
      x[i] = before_[i] +
             s * (c[0][i] + r * (c[1][i] + s * (c[2][i] + r * (c[3][i] + s * (c[4][i] + r * (c[5][i] + s * c[6][i]))))));
  }

  const State& current_state() const { return x_; }
  double current_time() const { return t_; }
  double current_time_step() const { return taken_; }
  /// The step to try next, and a way to limit it.
  double next_step() const { return dt_; }
  void limit_step(double most) { dt_ = std::min(dt_, most); }
  const State& previous_state() const { return before_; }
  double previous_time() const { return t_before_; }

 private:
  /// Sets `increment` to the sum of the weights of row `Stage` times the slopes 0 ... Last - 1. Weights of zero are left out.
  template <std::size_t Stage, std::size_t Last>
  void add_up(State& increment) const {
    weigh<Last>([](auto j) { return dop853::a[Stage][j]; }, increment, std::make_index_sequence<Last>());
  }
  template <std::size_t Last, class Weight, std::size_t... J>
  void weigh(Weight weight, State& sum, std::index_sequence<J...>) const {
    for (std::size_t i = 0; i < N; ++i) {
      double total = 0;
      ((weight(std::integral_constant<std::size_t, J>()) != 0
            ? void(total += weight(std::integral_constant<std::size_t, J>()) * k_[J][i])
            : void()),
       ...);
      sum[i] = total;
    }
  }
  template <std::size_t Stage, class RightHandSide>
  void add_stage(const RightHandSide& system, const State& x, State& stage, double dt, double t) {
    add_up<Stage, Stage>(stage);
    for (std::size_t i = 0; i < N; ++i) stage[i] = x[i] + dt * stage[i];
    system(stage, k_[Stage], t + dop853::c[Stage] * dt);
  }
  template <class RightHandSide, std::size_t... S>
  void sum_stages(const RightHandSide& system, State& stage, std::index_sequence<S...>) {
    (add_stage<S + 1>(system, x_, stage, dt_, t_), ...);
  }
  template <std::size_t... Row>
  void interpolant_rows(std::index_sequence<Row...>) {
    (weigh<16>([](auto j) { return taken_weight<Row>(j); }, coefficient_[3 + Row], std::make_index_sequence<16>()), ...);
    for (std::size_t row = 3; row < 7; ++row)
      for (double& value : coefficient_[row]) value *= taken_;
  }
  template <std::size_t Row, class J>
  static constexpr double taken_weight(J j) {
    return dop853::d[Row][j];
  }

  /// The error over the tolerance: the estimate of order 5 combined with that of order 3, eq. (10.17).
  double step_error() const {
    State e5, e3;
    weigh<12>([](auto j) { return dop853::error5[j]; }, e5, std::make_index_sequence<12>());
    weigh<12>([](auto j) { return dop853::error3[j]; }, e3, std::make_index_sequence<12>());
    for (std::size_t i = 0; i < N; ++i) e5[i] *= dt_, e3[i] *= dt_;
    const double five = scales_->largest_error(tolerance_, k_[0], e5, dt_);
    const double three = scales_->largest_error(tolerance_, k_[0], e3, dt_);
    const double size = std::sqrt(five * five + 0.01 * three * three);
    return size > 0 ? five * five / size : 0;
  }

  double tolerance_;
  const GroupScales<double, Shape>* scales_;
  State x_, before_, carry_;
  double t_ = 0, t_before_ = 0, t_carry_ = 0;
  double dt_ = 0, taken_ = 0;
  bool first_ = true, rejected_ = false, interpolates_ = false;
  std::array<State, dop853::kStages> k_;
  std::array<State, 7> coefficient_;
};

}  // namespace earthtop
