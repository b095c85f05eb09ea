// SPDX-License-Identifier: GPL-3.0-or-later
/// Taylor series of adaptive order and step, on odeint's dense-output-stepper concept: the series of the step is its dense
/// output, as accurate between the ends as at them.
///
/// A. Jorba and M. Zou, Experimental Mathematics 14 (2005) 99: the step is where the last terms of the series meet the
/// tolerance; the order is the one of least work for the way made, found from step to step. As the series is known before the
/// step is chosen, no step is ever rejected.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/stepper_categories.hpp>
#include <cmath>
#include <utility>

#include "earthtop/elementary.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/taylor/products.hpp"

namespace earthtop::taylor {

/// @tparam System  with the `Shape` of its states, and `Series`, which finds the coefficients:
///   start(x)                    takes the state at the beginning of a step
///   extend(k, x_k, x_next)      from the coefficients of order k, after all lower ones, those of order k + 1
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

  /// @param longest  no step is longer; a negative or no number: none is
  void initialize(const State& x, T t, T longest = T(0)) {
    x_ = x;
    rest_.fill(T(0));
    time_ = t;
    limit_step(longest);
  }
  /// Digits that the state has no room for.
  void add_rest(const State& rest) { rest_ = rest; }
  void limit_step(T longest) { longest_ = longest; }

  /// From the current state over one step. @returns its beginning and end
  std::pair<T, T> do_step(Series& series) {
    coefficients_[0] = x_;
    series.start(x_);
    for (int k = 0; k < order_; ++k) series.extend(k, at(k), at(k + 1));
    degree_ = order_;
    step_ = choose_step();
    // Compensated: what the sum leaves out of the state goes into the next one. Of a slow motion under a fast one only that
    // part of the round-off builds up, and it is the one that a step keeps.
    rest_before_ = rest_;
    const State change = change_after(step_, rest_before_);
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const T sum = x_[i] + change[i];
      rest_[i] = change[i] - (sum - x_[i]);
      x_[i] = sum;
    }
    const T before = time_;
    time_ += step_;
    return {before, time_};
  }

  /// The same as a stepper that may reject a step has it: this one never does.
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
  /// The state at a time within the last step.
  void calc_state(T t, State& x) const { state_after(t - previous_time(), x); }
  /// The same at a time after the beginning of the last step: no digit of it is lost to a late hour.
  void state_after(T dt, State& x) const {
    x = change_after(dt, rest_before_);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += at(0)[i];
  }
  /// Evaluations of the last step: each order costs one.
  int evaluations() const { return degree_; }
  /// About how far the unit vectors and quaternions of the state have turned in the last step.
  T turned() const { return scales_->turned(at(1), step_) + scales_->turned(at(2), step_ * step_); }

 private:
  static constexpr int kLeastOrder = 6;
  /// The last term against the tolerance: an order or two more buy an error of round-off at the least tolerance.
  static constexpr double kLastTerm = 1e-4;

  State& at(int k) { return coefficients_[static_cast<std::size_t>(k)]; }
  const State& at(int k) const { return coefficients_[static_cast<std::size_t>(k)]; }

  /// What the step adds to the state at its beginning until dt, the rest of the sums before it included.
  State change_after(T dt, const State& rest) const {
    State x = at(degree_);
    for (int k = degree_ - 1; k > 0; --k)
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] * dt + at(k)[i];
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] * dt + rest[i];
    return x;
  }

  /// Logarithm of the step at whose end the term of order k meets the tolerance.
  double log_step(int k) const {
    const double size = static_cast<double>(scales_->largest_ratio(at(k)));
    return size > 0 ? (log_tolerance_ - real::log(size)) / k : kUnlimited;
  }
  /// The last two terms count, as one of them may vanish by symmetry.
  T choose_step() {
    const double last = log_step(order_), before = log_step(order_ - 1);
    const double log_h = std::min(last, before);
    adapt_order(log_h, std::min(before, log_step(order_ - 2)));
    const T h = log_h < kUnlimited / 2 ? T(real::exp(log_h)) : longest_;
    return longest_ > T(0) && !(h < longest_) ? longest_ : h;
  }
  /// One order up or down, whichever way less work for each unit of time lies; a step that is cut short needs no higher one.
  void adapt_order(double log_h, double log_h_below) {
    const double log_longest = longest_ > T(0) ? real::log(static_cast<double>(longest_)) : kUnlimited;
    const auto log_work = [&](int order, double log_step) {
      return 2 * real::log(order + 3.0) - std::min(log_step, log_longest);
    };
    if (log_work(order_ - 1, log_h_below) < log_work(order_, log_h))
      order_ = std::max(order_ - 1, kLeastOrder);
    else if (log_h < log_longest)
      order_ = std::min(order_ + 1, kMostOrder<T>);
  }

  static constexpr double kUnlimited = 1e4;
  double log_tolerance_;
  const GroupScales<T, typename System::Shape>* scales_;
  int order_, degree_ = 0;
  T longest_ = T(0), time_ = T(0), step_ = T(0);
  State x_{}, rest_{}, rest_before_{};  ///< the state now, and what its sums left out: now, and at the beginning of the step
  std::array<State, kMostOrder<T> + 1> coefficients_{};
};

}  // namespace earthtop::taylor
