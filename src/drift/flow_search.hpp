// SPDX-License-Identifier: GPL-3.0-or-later
/// Watches the axis drift of an integration for the first time it passes a threshold.
///
/// Between two states of the integration the motion is integrated once more, from the first of them and to round-off, to each
/// time that the search wants to look at: by extrapolation of the same equations, whatever the method of the steps. So every
/// method has a dense output that is no worse than its steps, and the steps are what they are without a threshold.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "drift/threshold_watch.hpp"
#include "integrate/extrapolation.hpp"
#include "integrate/right_hand_side.hpp"

namespace earthtop {

/// @tparam System  x, dxdt, t -> void, with the `Shape` of its states and deviation_state(x, t)
template <class T, class System>
class FlowSearch {
 public:
  using State = std::array<T, System::kSize>;

  FlowSearch(const System& system, T threshold, T motion_rate)
      : equations_(std::in_place, system),
        watch_(threshold, motion_rate),
        apart_(T(real::cbrt(static_cast<double>(real::epsilon<T>()))) / motion_rate) {}

  /// @param system  whose equations may have changed since: a motion that has come to rest
  void follow(const System& system, T t, const State& x) {
    if (watch_.done()) return;
    const AxisLook<T> next = watch_.has_passed() ? axis_look(t, equations_->deviation_state(x, t)) : look(t, x);
    begin_t_ = t_, begin_ = x_;
    watch_.follow(next, [&](T between) {
      if (between < begin_t_) begin_t_ = t_, begin_ = x_;
      advance(between);
      return look(begin_t_, begin_);
    });
    t_ = t, x_ = x;
    if constexpr (requires { system.stops(); })
      if (system.stops().size() != equations_->stops().size()) equations_.emplace(system);
  }
  const ThresholdRecord<T>& record() const { return watch_.record(); }

 private:
  /// Of the equations' own least tolerance.
  static T tolerance() { return T(512) * real::epsilon<T>(); }

  /// A rate of the drift needs a few digits: from where the equations lead in a cube root of the digits of a turn, both ways.
  AxisLook<T> look(T t, const State& x) const {
    State dxdt, before, after;
    (*equations_)(x, dxdt, t);
    for (std::size_t i = 0; i < x.size(); ++i) {
      before[i] = x[i] - apart_ * dxdt[i];
      after[i] = x[i] + apart_ * dxdt[i];
    }
    return axis_look(t, equations_->deviation_state(x, t), equations_->deviation_state(before, t - apart_),
                     equations_->deviation_state(after, t + apart_), T(T(2) * apart_));
  }

  /// From `begin_` to t. Where the equations allow no step, which the integration's own has just shown to be unlikely, the
  /// search is told.
  void advance(T t) {
    GroupScales<T, typename System::Shape> scales;
    scales.include(begin_), scales.include(x_);
    Extrapolation<T, typename System::Shape> stepper(tolerance(), scales);
    std::int64_t evaluations = 0;  // nobody counts these
    const RightHandSide<T, System::kSize> equations(*equations_, evaluations);
    constexpr int kMostSteps = 1000;
    T left = t - begin_t_, proposed = left, gone = T(0);
    for (int i = 0; i < kMostSteps && left > T(0); ++i) {
      T dt = std::min(proposed, left), at = begin_t_ + gone;
      const T step = dt;
      State next = begin_;
      if (stepper.try_step(equations, next, at, dt) == boost::numeric::odeint::success && all_finite(next)) {
        begin_ = next;
        gone += step, left -= step;
      }
      proposed = dt;
    }
    if (left > T(0)) watch_.look_failed();
    begin_t_ = t;
  }

  std::optional<System> equations_;  ///< of the step looked into
  ThresholdWatch<T> watch_;
  T apart_;
  T t_ = T(0), begin_t_ = T(0);  ///< of the last state seen; of the one that further looks start from
  State x_{}, begin_{};
};

}  // namespace earthtop
