// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates by Taylor series with adaptive order and step, on odeint's dense-output-stepper concept. The series of a step is
/// its dense output, which is as accurate within the step as at its ends.
///
/// After A. Jorba and M. Zou, Experimental Mathematics 14 (2005) 99: the step is the one for which the last terms of the series
/// meet the tolerance; the order, adapted from step to step, is the one of least work per unit of time. As the series is known
/// before the step is chosen, no step is ever rejected.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/stepper_categories.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "earthtop/elementary.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/taylor/most_order.hpp"
#include "integrate/taylor/rough_logarithm.hpp"

namespace earthtop::taylor {

/// @tparam System  has the `Shape` of its states, and a `Series` that finds the coefficients:
///   start(x), or start(x, t)    is given the state at the beginning of a step, and its time if it asks for it
///   extend(k, x_k, x_next)      finds the coefficients of order k + 1 from those of order k; called for k = 0, 1, 2, ...
///   expand(x, order)            takes the place of `extend` where there is one: finds the coefficients 1 to `order` in x
template <class T, class System>
class TaylorStepper {
 public:
  using Series = typename System::Series;
  using State = std::array<T, System::kSize>;
  using state_type = State;
  using deriv_type = State;
  using value_type = T;
  using time_type = T;
  using stepper_category = boost::numeric::odeint::dense_output_stepper_tag;

  TaylorStepper(T relative_tolerance, const GroupScales<T, typename System::Shape>& scales)
      : log_tolerance_(real::log(kLastTerm * static_cast<double>(relative_tolerance))),
        scales_(&scales),
        order_(std::clamp(static_cast<int>(1 - 0.6 * log_tolerance_), kLeastOrder, kMostOrder<T>)) {}

  /// @param longest  limit to all steps; 0 or less: no limit
  void initialize(const State& x, T t, T longest = T(0)) {
    x_ = x;
    rest_.fill(T(0));
    time_ = t, time_rest_ = T(0);
    limit_step(longest);
  }
  /// Adds digits of the initial state for which its numbers have no room.
  void add_rest(const State& rest) { rest_ = rest; }
  void limit_step(T longest) { longest_ = longest; }

  /// Takes one step from the current state. @returns the times of its beginning and end
  std::pair<T, T> do_step(Series& series) {
    coefficients_[0] = x_;
    if constexpr (requires { series.start(x_, time_); })
      series.start(x_, time_);
    else
      series.start(x_);
    if constexpr (requires { series.expand(coefficients_.data(), order_); })
      series.expand(coefficients_.data(), order_);
    else
      for (int k = 0; k < order_; ++k) series.extend(k, at(k), at(k + 1));
    degree_ = order_;
    step_ = choose_step();
    if constexpr (requires { series.reaches(x_, time_); }) keep_branch(series);
    // The sum is compensated: what rounding leaves out of it goes into the next step's. In a slow motion under a fast one only
    // this round-off would build up.
    rest_before_ = rest_;
    const State change = change_after(step_, rest_before_);
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const T sum = x_[i] + change[i];
      rest_[i] = change[i] - (sum - x_[i]);
      x_[i] = sum;
    }
    const T before = time_;
    const T advance = step_ + time_rest_;
    time_ = before + advance;
    time_rest_ = advance - (time_ - before);
    return {before, time_};
  }

  /// The interface of steppers that may reject a step; this one never does.
  bool try_step(Series& series) {
    do_step(series);
    return true;
  }

  const State& current_state() const { return x_; }
  T next_step() const { return step_; }
  T current_time() const { return time_; }
  T current_time_step() const { return step_; }
  T previous_time() const { return time_ - step_; }
  const State& previous_state() const { return coefficients_[0]; }
  /// The state at a time t within the last step.
  void calc_state(T t, State& x) const { state_after(t - previous_time(), x); }
  /// The state, or its first components alone, at the time dt after the beginning of the last step. Late in a run, dt has more digits
  /// than t.
  template <std::size_t kCount>
  void state_after(T dt, std::array<T, kCount>& x) const {
    x = change_after<kCount>(dt, rest_before_);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += at(0)[i];
  }
  /// Evaluations of the last step: one for each order.
  int evaluations() const { return degree_; }
  /// Roughly the angle by which the state's unit vectors and quaternions have turned in the last step (rad).
  T turned() const { return scales_->turned(at(1), step_) + scales_->turned(at(2), step_ * step_); }

 private:
  static constexpr int kLeastOrder = 6;
  /// The size of the last term relative to the tolerance. At the least tolerance the order or two that this costs bring the
  /// error down to round-off.
  static constexpr double kLastTerm = 1e-4;

  State& at(int k) { return coefficients_[static_cast<std::size_t>(k)]; }
  const State& at(int k) const { return coefficients_[static_cast<std::size_t>(k)]; }

  /// The change of the first components from the beginning of the step to the time dt after it, including the rest of the sums before.
  template <std::size_t kCount = System::kSize>
  std::array<T, kCount> change_after(T dt, const State& rest) const {
    std::array<T, kCount> x;
    std::copy_n(at(degree_).begin(), kCount, x.begin());
    for (int k = degree_ - 1; k > 0; --k)
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] * dt + at(k)[i];
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] * dt + rest[i];
    return x;
  }

  /// Shortens the step until it ends where the series still holds; a step that is tiny by then may pass the end of the branch.
  void keep_branch(Series& series) {
    constexpr int kMostHalvings = 40;
    State end;
    for (int i = 0; i < kMostHalvings; ++i, step_ /= T(2)) {
      end = change_after(step_, rest_);
      for (std::size_t j = 0; j < end.size(); ++j) end[j] += x_[j];
      if (series.reaches(end, time_ + step_)) return;
    }
  }

  /// Logarithm of the step at whose end the term of order k meets the tolerance.
  double log_step(int k) const {
    const double square = static_cast<double>(scales_->largest_squared_ratio(at(k)));
    if (square > std::numeric_limits<double>::max()) return kShortest;
    return square > 0 ? (log_tolerance_ - rough_logarithm(square) / 2) / k : kUnlimited;
  }
  /// The step for which the last two terms meet the tolerance; the last one alone may vanish by symmetry.
  T choose_step() {
    const double last = log_step(order_), before = log_step(order_ - 1);
    const double log_h = std::min(last, before);
    adapt_order(log_h, std::min(before, log_step(order_ - 2)));
    const T h = log_h < kUnlimited / 2 ? T(rough_exponential(std::max(log_h, kShortest))) : longest_;
    return longest_ > T(0) && !(h < longest_) ? longest_ : h;
  }
  /// Changes the order by one, up or down, towards less work per unit of time. A step that is cut short needs no higher order.
  void adapt_order(double log_h, double log_h_below) {
    const double log_longest = longest_ > T(0) ? rough_logarithm(static_cast<double>(longest_)) : kUnlimited;
    const auto log_work = [&](int order, double log_step) {
      return 2 * rough_logarithm(order + kOrderOffset) - std::min(log_step, log_longest);
    };
    if (log_work(order_ - 1, log_h_below) < log_work(order_, log_h))
      order_ = std::max(order_ - 1, kLeastOrder);
    else if (log_h < log_longest)
      order_ = std::min(order_ + 1, kMostOrder<T>);
  }
  /// The work of a step is taken to be proportional to (order + kOrderOffset)^2. As an order takes some time besides the
  /// products, whose number is its square, 12 would take an eighth fewer orders (54,515 instead of 62,401 for a toy top), by
  /// steps half as long again; but their largest terms, and with them the rounding, would be several times as large.
  static constexpr double kOrderOffset = [] {
    if constexpr (requires { System::Shape::kOrderOffset; })
      return System::Shape::kOrderOffset;
    else
      return 3.0;
  }();

  static constexpr double kUnlimited = 1e4, kShortest = -700;
  double log_tolerance_;
  const GroupScales<T, typename System::Shape>* scales_;
  int order_, degree_ = 0;
  T longest_ = T(0), time_ = T(0), time_rest_ = T(0), step_ = T(0);
  State x_{}, rest_{}, rest_before_{};  ///< the state, and what its sums left out: at the end and the beginning of the step
  std::array<State, kMostOrder<T> + 1> coefficients_{};
};

}  // namespace earthtop::taylor
