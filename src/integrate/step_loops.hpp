// SPDX-License-Identifier: GPL-3.0-or-later
/// The loops over the steps of an integration, one for each kind of stepper. They land exactly on the output times, check that
/// every state is finite, keep the time without rounding, count in 64 bits and return a named outcome.
///
/// The integrate functions of odeint are not used: they accept NaN, count steps in an int and may stop short of the end.
#pragma once

#include <array>
#include <atomic>
#include <boost/numeric/odeint/stepper/adams_bashforth_moulton.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cstdint>
#include <optional>
#include <span>

#include "earthtop/error.hpp"
#include "earthtop/integrate/options.hpp"
#include "integrate/dop853_stepper.hpp"
#include "integrate/drive_options.hpp"
#include "integrate/extrapolation.hpp"
#include "integrate/gauss_stepper.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/right_hand_side.hpp"
#include "integrate/taylor/taylor_stepper.hpp"

namespace earthtop {

/// All that a Taylor stepper has to know of a system, so that it is compiled once for all systems with the same kind of series.
template <class TheShape, class TheSeries>
struct SeriesOver {
  using Shape = TheShape;
  using Series = TheSeries;
  static constexpr std::size_t kSize = Shape::kSize;
};

/// The loops know a system only by the shape of its states, and call it by address: steppers and loops are compiled once for all
/// systems of a shape, not once for each, which takes half the time. A step takes far longer than such a call.
template <class T, class TheShape>
class StepLoops {
 public:
  using Shape = TheShape;
  static constexpr std::size_t N = Shape::kSize;
  using State = std::array<T, N>;

  const StepCounters& counters() const { return counters_; }
  /// The step that a fixed-step method has taken in the first interval.
  T first_step_taken() const { return first_step_taken_; }

 protected:
  /// @param is_watched  whether the system has to see its state between the output times, in order to follow angles
  template <class System>
  StepLoops(const System& system, const DriveOptions<T>& options, bool is_watched)
      : options_(options), equations_(system, counters_.evaluations), is_watched_(is_watched) {}
  ~StepLoops() = default;

  /// Is called with the state at the start and after every step.
  virtual void see_step(T t, const State& x) = 0;
  /// Is called with the state at every output time.
  virtual void see_row(std::size_t row, const State& x) = 0;
  /// Lets the system change its state after an event, such as a motion coming to rest.
  virtual void settle(State& x, T t) = 0;
  /// The proposed step, or a shorter one if the system sets a limit to it.
  virtual T limited(T proposed, const State& x, T t) = 0;

  template <class ErrorStepper>
  RunStatus run_embedded(State& x, std::span<const T> times) {
    using Algebra = typename ErrorStepper::algebra_type;
    using Checker = GroupErrorChecker<T, Shape, Algebra>;
    boost::numeric::odeint::controlled_runge_kutta<ErrorStepper, Checker, StepAdjuster<T>> stepper(
        Checker(options_.relative_tolerance, scales_));
    return run_controlled(stepper, x, times);
  }

  /// Integrates by a stepper without dense output. Output times do not cut its steps, so that the motion does not depend on them: the
  /// state at an output time comes from steps of its own, aside from the motion, that begin where the step began. Joints cut steps.
  template <class ControlledStepper>
  RunStatus run_controlled(ControlledStepper& stepper, State& x, std::span<const T> times) {
    using boost::numeric::odeint::success;
    ControlledStepper aside = stepper;
    IntervalClock<T> clock(times.front(), times.back());
    T proposed = options_.first_step;
    State next;
    for (std::size_t row = 1; row < times.size();) {
      if (const RunStatus status = may_go_on(clock.now(), times); status != RunStatus::completed) return status;
      const T remaining = clock.remaining(), room = std::min(remaining, until_joint(clock));
      // Land on the end, or on a joint, by two equal steps rather than by a long one and a sliver.
      if (options_.largest_step > T(0)) proposed = std::min(proposed, options_.largest_step);
      proposed = limited(proposed, x, clock.now());
      const T step = proposed >= room ? room : (T(2) * proposed > room ? room / T(2) : proposed);
      const bool lands = step >= remaining;
      T dt = step, t = clock.now();
      next = x;
      if (stepper.try_step(equations_, next, t, dt) != success || !all_finite(next)) {
        ++counters_.rejected;
        proposed = dt < step ? dt : step / T(4);
        if (proposed < least_step<T>()) return failure_at(x, clock.now(), RunStatus::step_underflow);
        continue;
      }
      ++counters_.accepted;
      for (; row < times.size() && clock.until(times[row]) < step && !(lands && row + 1 == times.size()); ++row) {
        State seen = x;
        if (!go_aside(aside, seen, clock.now(), clock.until(times[row])))
          return failure_at(x, clock.now(), RunStatus::step_underflow);
        see_step(times[row], seen);
        show_row(row, seen);
      }
      x = next;
      clock.advance(lands ? remaining : step);
      const T now = lands ? times.back() : clock.now();
      settle(x, now);
      // A step that was cut short is not a reason to try a shorter one than was proposed before.
      proposed = step < proposed ? std::max(dt, proposed) : dt;
      scales_.include(x);
      see_step(now, x);
      for (; row < times.size() && (lands || clock.until(times[row]) <= T(0)); ++row) show_row(row, x);
    }
    return RunStatus::completed;
  }

  /// Takes a state on by a given time, in steps of its own. @returns whether the equations allow steps
  template <class ControlledStepper>
  bool go_aside(ControlledStepper& stepper, State& x, T begin, T duration) {
    if constexpr (requires { stepper.reset(); }) stepper.reset();
    IntervalClock<T> clock(begin, begin + duration);
    T left = duration, proposed = duration;
    State next;
    while (left > T(0)) {
      const T step = std::min(proposed, left);
      T dt = step, t = clock.now();
      next = x;
      if (stepper.try_step(equations_, next, t, dt) == boost::numeric::odeint::success && all_finite(next)) {
        x = next;
        clock.advance(step);
        left -= step;
        proposed = dt;
      } else {
        proposed = dt < step ? dt : step / T(4);
        if (proposed < least_step<T>()) return false;
      }
    }
    return true;
  }

  /// Integrates by a stepper with dense output, from which the rows come. Output times do not cut the steps; joints do.
  /// @param stepper  of odeint's dense-output concept, with try_step(equations) that returns whether the step was accepted
  template <class DenseStepper, class Equations>
  RunStatus run_dense(DenseStepper& stepper, Equations& equations, State& x, std::span<const T> times,
                      [[maybe_unused]] const State& rest = {}) {
    IntervalClock<T> clock(times.front(), times.back());
    stepper.initialize(x, times.front(), std::min(options_.first_step, clock.remaining()));
    if constexpr (requires { stepper.add_rest(rest); }) stepper.add_rest(rest);
    for (std::size_t row = 1; row < times.size();) {
      if (const RunStatus status = may_go_on(clock.now(), times); status != RunStatus::completed) return status;
      const T remaining = clock.remaining();
      stepper.limit_step(std::min(remaining, until_joint(clock)));
      if (!stepper.try_step(equations)) {
        ++counters_.rejected;
        if (stepper.next_step() < least_step<T>()) return failure_at(x, clock.now(), RunStatus::step_underflow);
        continue;
      }
      ++counters_.accepted;
      if constexpr (requires { stepper.evaluations(); }) counters_.evaluations += stepper.evaluations();
      x = stepper.current_state();
      if (!all_finite(x)) return RunStatus::not_finite;
      const T step = stepper.current_time_step();
      const bool lands = step >= remaining;
      if (!lands && step < least_step<T>()) return RunStatus::step_underflow;
      show_step(stepper, equations, clock, step, lands, times, row);
      scales_.include(x);
      clock.advance(step);
    }
    return RunStatus::completed;
  }

  /// Shows the state if steps end here at an output time. @param stop  number of the time: an output time, or a joint
  void show_row(std::size_t stop, const State& x) {
    const std::size_t row = stops_ ? stops_->rows[stop] : stop;
    if (row != Stops<T>::kNoRow) see_row(row, x);
  }

  /// The time from now to the next joint; if there is none, a time that leads past the end.
  T until_joint(const IntervalClock<T>& clock) {
    const auto& joints = options_.joints;
    while (next_joint_ < joints.size() && clock.until(joints[next_joint_]) <= least_step<T>()) ++next_joint_;
    return next_joint_ < joints.size() ? clock.until(joints[next_joint_]) : T(2) * clock.remaining();
  }

  /// Shows the rows within the step just taken, and as many states between them as the watcher needs to see every turn.
  template <class DenseStepper, class Equations>
  void show_step(DenseStepper& stepper, Equations& equations, const IntervalClock<T>& clock, T step, bool lands,
                 std::span<const T> times, std::size_t& row) {
    State seen;
    const auto see = [&](T after, T t) {
      if constexpr (requires { stepper.prepare_interpolant(equations); })
        if (after < step) stepper.prepare_interpolant(equations);
      if (after < step)
        stepper.state_after(after, seen);
      else
        seen = stepper.current_state();
      see_step(t, seen);
    };
    const int pieces = pieces_of(stepper, step);
    for (int piece = 1; piece <= pieces; ++piece) {
      const bool ends = piece == pieces;
      const T end = ends ? step : step * T(piece) / T(pieces);
      for (; row < times.size() && (clock.until(times[row]) <= end || (ends && lands)); ++row) {
        see(clock.until(times[row]), times[row]);
        show_row(row, seen);
      }
      if (row == times.size()) return;
      if (is_watched_) see(end, clock.now() + end);
    }
  }
  /// The number of pieces in which the watcher has to see a step.
  template <class DenseStepper>
  int pieces_of(const DenseStepper& stepper, T step) const {
    T pieces = T(1);
    if (is_watched_) {
      T turned = T(0);
      if constexpr (requires { stepper.turned(); }) turned = stepper.turned();
      pieces = pieces_of_step(options_, step, turned);
    }
    return static_cast<int>(pieces);
  }

  /// Integrates by collocation at Gauss nodes, with the step asked for or one that meets the tolerance.
  /// @param rate  rate of the motion that the steps have to resolve (rad per unit of time)
  RunStatus run_gauss(State& x, std::span<const T> times, T rate) {
    GaussStepper<Shape> stepper(scales_);
    const T step = options_.fixed_step_given ? options_.fixed_step : fixed_step_for(stepper, x, times, rate);
    return run_fixed(stepper, x, times, step);
  }

  /// Integrates by Dormand's and Prince's method of order 8 with its dense output.
  RunStatus run_dop853(State& x, std::span<const T> times) {
    Dop853Stepper<Shape> stepper(options_.relative_tolerance, scales_);
    return run_dense(stepper, equations_, x, times);
  }

  /// Integrates by Taylor series.
  /// @param rest  digits of the initial state for which its numbers have no room
  template <class Series>
  RunStatus run_series(Series& series, const State& rest, State& x, std::span<const T> times) {
    taylor::TaylorStepper<T, SeriesOver<Shape, Series>> stepper(options_.relative_tolerance, scales_);
    return run_dense(stepper, series, x, times, rest);
  }

  RunStatus run_extrapolation(State& x, std::span<const T> times) {
    Extrapolation<T, Shape> stepper(options_.relative_tolerance, scales_);
    return run_controlled(stepper, x, times);
  }

  RunStatus run_bulirsch_stoer(State& x, std::span<const T> times) {
    // The error checker of odeint takes each component by itself: relative to its size, with a floor above round-off.
    const T absolute = std::max(T(1e-4) * options_.relative_tolerance, T(4) * real::epsilon<T>());
    boost::numeric::odeint::bulirsch_stoer<State, T> stepper(absolute, options_.relative_tolerance);
    return run_controlled(stepper, x, times);
  }

  /// Integrates by Adams-Bashforth-Moulton of order 8, started, and restarted where the step changes, by Fehlberg's method of
  /// order 8.
  RunStatus run_multistep(State& x, std::span<const T> times) {
    using namespace boost::numeric::odeint;
    using Starter = runge_kutta_fehlberg78<State, T>;
    using Algebra = typename Starter::algebra_type;
    using Operations = typename Starter::operations_type;
    using Stepper = adams_bashforth_moulton<8, State, T, State, T, Algebra, Operations, initially_resizer, Starter>;
    MultistepStepper<Stepper> stepper;
    return run_fixed(stepper, x, times, options_.fixed_step);
  }

  /// Integrates with a fixed step.
  /// @param stepper  has do_step(equations_, x, t, dt), which returns whether it succeeded, and reset(), to be called before a step
  /// of another length
  /// @param largest  the step taken is at most this long and divides the output interval
  template <class Stepper>
  RunStatus run_fixed(Stepper& stepper, State& x, std::span<const T> times, T largest) {
    if (options_.largest_step > T(0)) largest = std::min(largest, options_.largest_step);
    T step_before = T(0);
    for (std::size_t row = 1; row < times.size(); ++row) {
      const T interval = times[row] - times[row - 1];
      const auto steps = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(interval / largest * (1 - 1e-12))));
      T h = interval / static_cast<T>(steps);
      // Intervals between output times may differ by a rounding; the step is then kept. A step after a joint starts afresh: a
      // multistep method must not use values from before it.
      const bool goes_on = !stops_ || !stops_->at_joint[row - 1];
      if (goes_on && real::abs(h - step_before) <= T(1e-9) * h)
        h = step_before;
      else
        stepper.reset();
      step_before = h;
      if (first_step_taken_ == T(0)) first_step_taken_ = h;
      for (std::int64_t k = 0; k < steps; ++k) {
        const T now = times[row - 1] + static_cast<T>(k) * h;
        if (const RunStatus status = may_go_on(now, times); status != RunStatus::completed) return status;
        const bool converged = stepper.do_step(equations_, x, now, h);
        if (!all_finite(x)) return RunStatus::not_finite;
        if (!converged) return failure_at(x, now, RunStatus::not_converged);
        ++counters_.accepted;
        scales_.include(x);
        see_step(times[row - 1] + static_cast<T>(k + 1) * h, x);
      }
      show_row(row, x);
    }
    return RunStatus::completed;
  }

  /// A fixed step h that meets the tolerance: over the first turn of the motion, integrations with steps of h and of h / 2
  /// differ nowhere by more.
  /// @param rate  rate of the motion that the steps have to resolve (rad per unit of time)
  template <class Stepper>
  T fixed_step_for(Stepper& stepper, const State& start, std::span<const T> times, T rate) {
    const T turn = std::min(times.back() - times.front(), T(2) * real::pi<T>() / rate);
    GroupScales<T, Shape> scales = scales_;
    std::int64_t count = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(turn * rate / kLongestFixedAngle)));
    for (int attempt = 0; attempt < 40; ++attempt) {
      const T h = turn / static_cast<T>(count);
      State coarse = start, fine = start, difference;
      T error = T(0);
      Stepper half = stepper;
      stepper.reset(), half.reset();
      for (std::int64_t k = 0; k < count && all_finite(coarse) && all_finite(fine); ++k) {
        if (options_.watch.asks_to_stop()) return h;
        const T t = times.front() + static_cast<T>(k) * h;
        const bool converged = stepper.do_step(equations_, coarse, t, h) && half.do_step(equations_, fine, t, h / T(2)) &&
                               half.do_step(equations_, fine, t + h / T(2), h / T(2));
        if (!converged) error = T(1e30);
        if (error >= T(1e30)) break;
        scales.include(fine);
        for (std::size_t i = 0; i < N; ++i) difference[i] = coarse[i] - fine[i];
        error = std::max(error, scales.largest_error(options_.relative_tolerance, fine, difference, T(0)));
      }
      stepper.reset();
      if (error <= T(1) || count > kMostStepsATurn) return h;
      const double growth = real::pow(static_cast<double>(error), 1.0 / 8);
      count = static_cast<std::int64_t>(std::ceil(static_cast<double>(count) * std::clamp(growth, 1.05, 2.0)));
    }
    return turn / static_cast<T>(count);
  }
  /// The largest angle by which a step found by fixed_step_for turns the motion (rad). It is well below the first resonance of
  /// step and nutation, at 2 pi.
  static constexpr double kLongestFixedAngle = 2.0;
  static constexpr std::int64_t kMostStepsATurn = 400;

  /// The reason why no step can be taken from here: the equations give no finite number, or else `otherwise`.
  RunStatus failure_at(const State& x, T t, RunStatus otherwise) {
    State dxdt;
    equations_(x, dxdt, t);
    return all_finite(dxdt) ? otherwise : RunStatus::not_finite;
  }

  RunStatus may_go_on(T now, std::span<const T> times) const {
    return earthtop::may_go_on(options_, counters_, now, times.front(), times.back());
  }

  const DriveOptions<T>& options_;
  GroupScales<T, Shape> scales_;
  StepCounters counters_;
  std::optional<Stops<T>> stops_;  ///< the times at which steps end; none if there are no joints

 private:
  RightHandSide<T, N> equations_;
  bool is_watched_;
  std::size_t next_joint_ = 0;
  T first_step_taken_ = T(0);
};

}  // namespace earthtop
