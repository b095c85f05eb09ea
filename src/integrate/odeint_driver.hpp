/// The one place that knows Boost.Odeint: its steppers behind an own loop that lands exactly on the output times, checks
/// that every state is finite, keeps the time without rounding, counts in 64 bits and returns a named outcome.
///
/// odeint's own integrate functions accept NaN, count steps in an int and may stop short of the end; they are not used.
#pragma once

#include <array>
#include <atomic>
#include <boost/numeric/odeint/stepper/adams_bashforth_moulton.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cstdint>
#include <span>
#include <type_traits>

#include "earthtop/error.hpp"
#include "earthtop/integrate/options.hpp"
#include "integrate/extrapolation.hpp"
#include "integrate/group_norms.hpp"
#include "integrate/taylor/taylor_stepper.hpp"

namespace earthtop {

/// What the driver needs beside the system; times in the system's own unit.
template <class T>
struct DriveOptions {
  Method method = Method::rkf78;
  T relative_tolerance = T(1e-12);
  T first_step = T(0.01);
  T largest_step = T(0);  ///< of a controlled method; 0: any
  T fixed_step = T(0);    ///< largest step of a fixed-step method; the step taken divides each output interval
  std::int64_t step_limit = 0;
  const std::atomic<bool>* stop = nullptr;
};

/// A time kept as start + offset, the offset compensated: n steps cost one rounding, not n.
template <class T>
class IntervalClock {
 public:
  IntervalClock(T start, T end) : start_(start), length_(end - start) {}
  T now() const { return start_ + offset_; }
  T remaining() const { return (length_ - offset_) - carry_; }
  /// From now to a time.
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

/// Steps of less than this (in natural units, where the motion's own time is about 1) mean that no step is small enough.
template <class T>
constexpr T least_step() {
  return T(1e-13);
}

/// Whether a system wants to see its state between the output times; those that follow no angle do not.
template <class System>
constexpr bool is_watched() {
  if constexpr (requires { System::kWatched; })
    return System::kWatched;
  else
    return true;
}

/// @tparam System  x, dxdt, t -> void, with `kSize`, `groups()`   @param times  the first is where x stands
/// @param on_step  called with (t, x) after every step   @param on_row  called with (row index, x) at every output time
template <class T, class System, class OnStep, class OnRow>
class Driver {
 public:
  static constexpr std::size_t N = System::kSize;
  using State = std::array<T, N>;

  Driver(System& system, const DriveOptions<T>& options, OnStep& on_step, OnRow& on_row)
      : system_(system), options_(options), on_step_(on_step), on_row_(on_row) {}

  RunStatus run(State& x, std::span<const T> times) {
    using namespace boost::numeric::odeint;
    scales_.include(x);
    if constexpr (requires { system_.typical_state(); }) scales_.include(system_.typical_state());
    if (!all_finite(x)) return RunStatus::not_finite;
    on_step_(times[0], x);
    on_row_(std::size_t{0}, x);
    const Method method = options_.method;
    if (method == Method::rkf78 || method == Method::automatic) return run_embedded<runge_kutta_fehlberg78<State, T>>(x, times);
    if (method == Method::extrapolation) {
      Extrapolation<T, System> stepper(options_.relative_tolerance, scales_);
      return run_controlled(stepper, x, times);
    }
    if constexpr (requires { typename System::Series; }) {
      if (method == Method::taylor) {
        taylor::TaylorStepper<T, System> stepper(options_.relative_tolerance, scales_);
        auto series = system_.series();
        return run_dense(stepper, series, x, times);
      }
    }
    if constexpr (!std::is_same_v<T, float128>) {
      if (method == Method::bulirsch_stoer) {
        // odeint's own checker, component by component: relative to each, with a floor a little above round-off.
        const T absolute = std::max(T(1e-4) * options_.relative_tolerance, T(4) * real::epsilon<T>());
        bulirsch_stoer<State, T> stepper(absolute, options_.relative_tolerance);
        return run_controlled(stepper, x, times);
      }
    }
    if constexpr (std::is_same_v<T, double>) {
      if (method == Method::dopri5) return run_embedded<runge_kutta_dopri5<State, T>>(x, times);
      if (method == Method::abm8) return run_fixed(x, times);
    }
    throw std::logic_error("method not built for this precision");
  }

  const StepCounters& counters() const { return counters_; }

 private:
  auto counted_system() {
    return [this](const State& x, State& dxdt, T t) {
      ++counters_.evaluations;
      system_(x, dxdt, t);
    };
  }

  template <class ErrorStepper>
  RunStatus run_embedded(State& x, std::span<const T> times) {
    using Algebra = typename ErrorStepper::algebra_type;
    using Checker = GroupErrorChecker<T, System, Algebra>;
    boost::numeric::odeint::controlled_runge_kutta<ErrorStepper, Checker, StepAdjuster<T>> stepper(
        Checker(options_.relative_tolerance, scales_));
    return run_controlled(stepper, x, times);
  }

  template <class ControlledStepper>
  RunStatus run_controlled(ControlledStepper& stepper, State& x, std::span<const T> times) {
    using boost::numeric::odeint::success;
    const auto system = counted_system();
    T proposed = options_.first_step;
    State next;
    for (std::size_t row = 1; row < times.size(); ++row) {
      IntervalClock<T> clock(times[row - 1], times[row]);
      for (T remaining = clock.remaining(); remaining > T(0); remaining = clock.remaining()) {
        if (const RunStatus status = may_go_on(clock.now(), times); status != RunStatus::completed) return status;
        // Land on the output time; two like steps rather than a long one and a sliver.
        if (options_.largest_step > T(0)) proposed = std::min(proposed, options_.largest_step);
        const bool lands = proposed >= remaining;
        const T step = lands ? remaining : (T(2) * proposed > remaining ? remaining / T(2) : proposed);
        T dt = step, t = clock.now();
        next = x;
        if (stepper.try_step(system, next, t, dt) == success && all_finite(next)) {
          x = next;
          ++counters_.accepted;
          if (lands)
            clock.advance(remaining);
          else
            clock.advance(step);
          // A step cut short by the output time tells nothing against the longer one proposed before.
          proposed = step < proposed ? std::max(dt, proposed) : dt;
          scales_.include(x);
          on_step_(lands ? times[row] : clock.now(), x);
          if (lands) break;
        } else {
          ++counters_.rejected;
          proposed = dt < step ? dt : step / T(4);
          if (proposed < least_step<T>()) {
            State dxdt;
            system_(x, dxdt, clock.now());
            return all_finite(dxdt) ? RunStatus::step_underflow : RunStatus::not_finite;
          }
        }
      }
      on_row_(row, x);
    }
    return RunStatus::completed;
  }

  /// Output times do not cut the steps: rows come from the stepper's dense output.
  template <class DenseStepper, class Equations>
  RunStatus run_dense(DenseStepper& stepper, Equations& equations, State& x, std::span<const T> times) {
    IntervalClock<T> clock(times.front(), times.back());
    stepper.initialize(x, times.front(), clock.remaining());
    if constexpr (requires { stepper.add_rest(system_.initial_rest()); }) stepper.add_rest(system_.initial_rest());
    for (std::size_t row = 1; row < times.size();) {
      if (const RunStatus status = may_go_on(clock.now(), times); status != RunStatus::completed) return status;
      const T remaining = clock.remaining();
      stepper.limit_step(options_.largest_step > T(0) ? std::min(options_.largest_step, remaining) : remaining);
      stepper.do_step(equations);
      ++counters_.accepted;
      counters_.evaluations += stepper.evaluations();
      x = stepper.current_state();
      if (!all_finite(x)) return RunStatus::not_finite;
      const T step = stepper.current_time_step();
      const bool lands = step >= remaining;
      if (!lands && step < least_step<T>()) return RunStatus::step_underflow;
      show_step(stepper, clock, step, lands, times, row);
      scales_.include(x);
      clock.advance(step);
    }
    return RunStatus::completed;
  }

  /// Rows within a step just made, and as many points between as the watcher needs to see every turn.
  template <class DenseStepper>
  void show_step(const DenseStepper& stepper, const IntervalClock<T>& clock, T step, bool lands, std::span<const T> times,
                 std::size_t& row) {
    constexpr int kMostPieces = 16;
    int pieces = 1;
    if constexpr (is_watched<System>()) pieces = 1 + static_cast<int>(std::min(stepper.turned(), T(kMostPieces - 1)));
    State seen;
    for (int piece = 1; piece <= pieces; ++piece) {
      const bool ends = piece == pieces;
      const T end = ends ? step : step * T(piece) / T(pieces);
      for (; row < times.size() && (clock.until(times[row]) <= end || (ends && lands)); ++row) {
        stepper.state_after(std::min(clock.until(times[row]), step), seen);
        on_step_(times[row], seen);
        on_row_(row, seen);
      }
      if (row == times.size()) return;
      if constexpr (is_watched<System>()) {
        stepper.state_after(end, seen);
        on_step_(clock.now() + end, seen);
      }
    }
  }

  /// Adams-Bashforth-Moulton of order 8, started (and restarted where the step changes) by Fehlberg's 8th-order method.
  RunStatus run_fixed(State& x, std::span<const T> times) {
    using namespace boost::numeric::odeint;
    using Starter = runge_kutta_fehlberg78<State, T>;
    using Algebra = typename Starter::algebra_type;
    using Operations = typename Starter::operations_type;
    using Stepper = adams_bashforth_moulton<8, State, T, State, T, Algebra, Operations, initially_resizer, Starter>;
    const auto system = counted_system();
    Stepper stepper;
    T step_before = T(0);
    for (std::size_t row = 1; row < times.size(); ++row) {
      const T interval = times[row] - times[row - 1];
      const auto steps =
          std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(interval / options_.fixed_step * (1 - 1e-12))));
      T h = interval / static_cast<T>(steps);
      // Output times k * step differ by a rounding: the step is the same one.
      if (real::abs(h - step_before) <= T(1e-9) * h)
        h = step_before;
      else
        stepper = Stepper();
      step_before = h;
      for (std::int64_t k = 0; k < steps; ++k) {
        const T now = times[row - 1] + static_cast<T>(k) * h;
        if (const RunStatus status = may_go_on(now, times); status != RunStatus::completed) return status;
        stepper.do_step(system, x, now, h);
        ++counters_.accepted;
        if (!all_finite(x)) return RunStatus::not_finite;
        on_step_(times[row - 1] + static_cast<T>(k + 1) * h, x);
      }
      on_row_(row, x);
    }
    return RunStatus::completed;
  }

  /// Ends at the step limit, and as soon as a million steps have come so little forward that the limit is out of reach of the
  /// end.
  RunStatus may_go_on(T now, std::span<const T> times) const {
    constexpr std::int64_t kReview = 1'000'000;
    const std::int64_t steps = counters_.accepted + counters_.rejected;
    if (steps >= options_.step_limit) return RunStatus::step_limit;
    if (steps % kReview == 0 && steps > 0) {
      const auto part = static_cast<double>((now - times.front()) / (times.back() - times.front()));
      if (static_cast<double>(steps) > part * static_cast<double>(options_.step_limit)) return RunStatus::step_limit;
    }
    if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed)) return RunStatus::interrupted;
    return RunStatus::completed;
  }

  System& system_;
  const DriveOptions<T>& options_;
  OnStep& on_step_;
  OnRow& on_row_;
  GroupScales<T, System> scales_;
  StepCounters counters_;
};

}  // namespace earthtop
