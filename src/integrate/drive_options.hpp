// SPDX-License-Identifier: GPL-3.0-or-later
/// The options of the driver, its clock, and its adapter for multistep methods.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/integrate/pace.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// All that the driver needs besides the system; times are in the system's own unit.
template <class T>
struct DriveOptions {
  Method method = Method::rkf78;
  T relative_tolerance = T(1e-12);
  T first_step = T(0.01);
  T largest_step = T(0);         ///< longest time between two states that on_step sees, to count turns; 0: no limit
  T rate = T(1);                 ///< rough upper bound on the rates of the motion
  T fixed_step = T(0);           ///< longest step of a fixed-step method; the step taken divides each output interval
  bool fixed_step_given = true;  ///< whether `fixed_step` was asked for; if not, a method may find one by the tolerance
  Composition composition = Composition::automatic;
  std::int64_t step_limit = 0;
  WorkLimit limit = {};  ///< limit that follows from the estimated work
  Watch watch = {};
  std::vector<T> joints = {};  ///< ascending; times at which the equations have no higher derivatives: steps end there
};

/// The times at which steps end: the output times, and the joints between them. A joint that is too near an output time for a
/// step between them is merged with it.
template <class T>
struct Stops {
  static constexpr std::size_t kNoRow = static_cast<std::size_t>(-1);
  std::vector<T> times;
  std::vector<std::size_t> rows;  ///< for each time: the number of the output time, or kNoRow
  std::vector<bool> at_joint;     ///< for each time: whether it is a joint

  Stops(std::span<const T> output_times, const std::vector<T>& joints, T nearest) {
    std::size_t next = 0;
    for (std::size_t row = 0; row < output_times.size(); ++row) {
      for (; next < joints.size() && joints[next] < output_times[row] - nearest; ++next)
        if (row > 0 && joints[next] > output_times[row - 1] + nearest) add(joints[next], kNoRow, true);
      add(output_times[row], row, next < joints.size() && joints[next] <= output_times[row] + nearest);
    }
  }

 private:
  void add(T time, std::size_t row, bool joint) {
    times.push_back(time);
    rows.push_back(row);
    at_joint.push_back(joint);
  }
};

/// Keeps the time as start + offset, with a compensated offset: n steps together have one rounding error instead of n.
template <class T>
class IntervalClock {
 public:
  IntervalClock(T start, T end) : start_(start), length_(end - start) {}
  T now() const { return start_ + offset_; }
  T remaining() const { return (length_ - offset_) - carry_; }
  /// The time from now to t.
  T until(T t) const { return ((t - start_) - offset_) - carry_; }
  void advance(T dt) {
    const T y = dt + carry_;
    const T sum = offset_ + y;
    carry_ = y - (sum - offset_);
    offset_ = sum;
  }

 private:
  T start_;
  T length_;
  T offset_ = T(0);
  T carry_ = T(0);
};

/// The shortest step allowed, in natural units, where the motion's own time scale is about 1. If a method asks for a shorter
/// one, no step is short enough.
template <class T>
constexpr T least_step() {
  return T(1e-13);
}

/// Whether a system has to see its state between the output times, in order to follow angles.
template <class System>
constexpr bool is_watched() {
  if constexpr (requires { System::kWatched; })
    return System::kWatched;
  else
    return true;
}

/// Whether a system is integrated only by extrapolation, rkf78 and its Taylor series. The other steppers are left out to save
/// compilation time.
template <class System>
constexpr bool is_bound_only() {
  if constexpr (requires { System::kBoundOnly; })
    return System::kBoundOnly;
  else
    return false;
}

/// Whether a system is integrated by rkf78 as well.
template <class System>
constexpr bool has_runge_kutta() {
  if constexpr (requires { System::kRungeKutta; })
    return System::kRungeKutta;
  else
    return true;
}

/// Whether a system is integrated only by its Taylor series.
template <class System>
constexpr bool is_series_only() {
  if constexpr (requires { System::kSeriesOnly; })
    return System::kSeriesOnly;
  else
    return false;
}

/// Whether another step may be taken: RunStatus::completed, or else the reason to stop. It stops at the limits, which count
/// rejected steps as well; and after any million steps, if at their pace the end would not be reached within the step limit.
template <class T>
RunStatus may_go_on(const DriveOptions<T>& options, const StepCounters& counters, T now, T begin, T end) {
  constexpr std::int64_t kReview = 1'000'000, kTell = 64;
  const std::int64_t steps = counters.accepted + counters.rejected;
  if (steps >= std::min(options.step_limit, options.limit.steps) || counters.evaluations >= options.limit.evaluations)
    return RunStatus::step_limit;
  if (steps % kReview == 0 && steps > 0) {
    const auto part = static_cast<double>((now - begin) / (end - begin));
    if (static_cast<double>(steps) > part * static_cast<double>(options.step_limit)) return RunStatus::step_limit;
  }
  if (steps % kTell == 0) options.watch.reach(static_cast<double>((now - begin) / (end - begin)));
  if (options.watch.asks_to_stop()) return RunStatus::interrupted;
  return RunStatus::completed;
}

/// The number of pieces in which the watcher has to see a step. @param turned  roughly how far the step turns the motion (rad)
template <class T>
T pieces_of_step(const DriveOptions<T>& options, T step, T turned) {
  constexpr int kMostByTurn = 15;  // enough for a rough angle
  const T by_turn = T(1) + std::min(turned, T(kMostByTurn));
  return options.largest_step > T(0) ? std::max(by_turn, T(1) + step / options.largest_step) : by_turn;
}

/// Gives a multistep method of odeint the interface that the driver's fixed steps use.
template <class Stepper>
struct MultistepStepper {
  std::optional<Stepper> stepper{std::in_place};
  template <class RightHandSide, class State, class T>
  bool do_step(const RightHandSide& system, State& x, T t, T dt) {
    stepper->do_step(system, x, t, dt);
    return true;
  }
  void reset() { stepper.emplace(); }
};

}  // namespace earthtop
