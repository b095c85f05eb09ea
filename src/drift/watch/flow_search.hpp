// SPDX-License-Identifier: GPL-3.0-or-later
/// Watches the axis drift of an integration until it first passes a threshold.
///
/// To look at a time between two states of the integration, the search integrates the same equations once more from the first
/// of the two states: by extrapolation and down to round-off, whatever the method of the steps. So every method has a dense
/// output that is no worse than its steps, and the steps are the same as without a threshold.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "drift/watch/threshold_watch.hpp"
#include "integrate/extrapolation.hpp"
#include "integrate/right_hand_side.hpp"

namespace earthtop {

/// Integrates by extrapolation. Whatever the system, it is compiled once for each shape of states.
/// @param x  the state at `begin`; afterwards that at `end`   @returns whether the end was reached
template <class T, class Shape>
bool extrapolate(const RightHandSide<T, Shape::kSize>& equations, const GroupScales<T, Shape>& scales, T tolerance, T begin,
                 T end, std::array<T, Shape::kSize>& x) {
  Extrapolation<T, Shape> stepper(tolerance, scales);
  constexpr int kMostSteps = 1000;
  T left = end - begin, proposed = left, gone = T(0);
  for (int i = 0; i < kMostSteps && left > T(0); ++i) {
    T dt = std::min(proposed, left), at = begin + gone;
    const T step = dt;
    std::array<T, Shape::kSize> next = x;
    if (stepper.try_step(equations, next, at, dt) == boost::numeric::odeint::success && all_finite(next)) {
      x = next;
      gone += step, left -= step;
    }
    proposed = dt;
  }
  return !(left > T(0));
}

/// @tparam System  called with (x, dxdt, t); has the `Shape` of its states and deviation_state(x, t)
template <class T, class System>
class FlowSearch {
 public:
  using State = std::array<T, System::kSize>;

  FlowSearch(const System& system, T threshold, T motion_rate)
      : equations_(std::in_place, system),
        watch_(threshold, motion_rate),
        apart_(T(real::cbrt(static_cast<double>(real::epsilon<T>()))) / motion_rate) {}

  /// Goes on to the next state of the integration.
  /// @param system  its equations may have changed since the last state, if a motion has come to rest
  void follow(const System& system, T t, const State& x) {
    if (watch_.done()) return;
    const AxisDriftSample<T> next = watch_.has_passed() ? axis_look(t, equations_->deviation_state(x, t)) : look(t, x);
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
  /// Tolerance of the search's own integration, some ten times the least that makes sense.
  static T tolerance() { return T(512) * real::epsilon<T>(); }

  /// The drift at t and its rate. The rate needs only a few digits: it is taken from the two states to which the slope at t
  /// leads shortly before and after t (by a phase of the motion that is the cube root of epsilon).
  AxisDriftSample<T> look(T t, const State& x) const {
    State dxdt, before, after;
    (*equations_)(x, dxdt, t);
    for (std::size_t i = 0; i < x.size(); ++i) {
      before[i] = x[i] - apart_ * dxdt[i];
      after[i] = x[i] + apart_ * dxdt[i];
    }
    return axis_look(t, equations_->deviation_state(x, t), equations_->deviation_state(before, t - apart_),
                     equations_->deviation_state(after, t + apart_), T(T(2) * apart_));
  }

  /// Integrates from `begin_` to t. If the equations allow no step, which is unlikely as the integration has just taken one,
  /// the look has failed, and the watch is told so.
  void advance(T t) {
    GroupScales<T, typename System::Shape> scales;
    scales.include(begin_), scales.include(x_);
    std::int64_t evaluations = 0;  // not counted anywhere
    if (!extrapolate(RightHandSide<T, System::kSize>(*equations_, evaluations), scales, tolerance(), begin_t_, t, begin_))
      watch_.look_failed();
    begin_t_ = t;
  }

  std::optional<System> equations_;  ///< a copy of the system, as it was during the step that is looked into
  ThresholdWatch<T> watch_;
  T apart_;
  T t_ = T(0), begin_t_ = T(0);  ///< times of the last state seen, and of the state that further looks start from
  State x_{}, begin_{};          ///< these two states
};

}  // namespace earthtop
