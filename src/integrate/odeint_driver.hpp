// SPDX-License-Identifier: GPL-3.0-or-later
/// Drives all steppers, those of Boost.Odeint among them: chooses the loop for the method.
#pragma once

#include <span>
#include <stdexcept>
#include <type_traits>

#include "integrate/splitting_stepper.hpp"
#include "integrate/step_loops.hpp"

namespace earthtop {

/// Integrates a system over its output times.
/// @tparam System  called with (x, dxdt, t); has the `Shape` of its states
/// @tparam OnStep  called with (t, x) at the start and after every step
/// @tparam OnRow  called with (row index, x) at every output time
template <class T, class System, class OnStep, class OnRow>
class Driver final : public StepLoops<T, typename System::Shape> {
  using Loops = StepLoops<T, typename System::Shape>;

 public:
  using State = typename Loops::State;

  Driver(System& system, const DriveOptions<T>& options, OnStep& on_step, OnRow& on_row)
      : Loops(system, options, is_watched<System>()), system_(system), on_step_(on_step), on_row_(on_row) {}

  /// @param x  the state at the first of the times; afterwards the last state   @param times  the output times
  /// @throws std::logic_error for a method that is not built for T or for this system
  RunStatus run(State& x, std::span<const T> times) {
    scales_.include(x);
    if constexpr (requires { system_.typical_state(); }) scales_.include(system_.typical_state());
    if (!all_finite(x)) return RunStatus::not_finite;
    settle(x, times[0]);
    see_step(times[0], x);
    see_row(std::size_t{0}, x);
    if (!options_.joints.empty()) {
      stops_.emplace(times, options_.joints, least_step<T>());
      times = stops_->times;
    }
    const Method method = options_.method;
    if constexpr (is_series_only<System>()) {
      if (method == Method::taylor) return run_series(x, times);
      throw std::logic_error("these equations are integrated by their series only");
    } else {
      return run_by(method, x, times);
    }
  }

 private:
  RunStatus run_series(State& x, std::span<const T> times) {
    State rest{};
    if constexpr (requires { system_.initial_rest(); }) rest = system_.initial_rest();
    auto series = system_.series();
    return Loops::run_series(series, rest, x, times);
  }

  RunStatus run_by(Method method, State& x, std::span<const T> times) {
    using namespace boost::numeric::odeint;
    if constexpr (has_runge_kutta<System>()) {
      if (method == Method::rkf78 || method == Method::automatic)
        return this->template run_embedded<runge_kutta_fehlberg78<State, T>>(x, times);
    }
    if (method == Method::extrapolation) return this->run_extrapolation(x, times);
    if constexpr (requires { typename System::Series; }) {
      if (method == Method::taylor) return run_series(x, times);
    }
    if constexpr (!std::is_same_v<T, float128> && !is_bound_only<System>()) {
      if (method == Method::bulirsch_stoer) return this->run_bulirsch_stoer(x, times);
    }
    if constexpr (std::is_same_v<T, double> && !is_bound_only<System>()) {
      if (method == Method::dopri5) return this->template run_embedded<runge_kutta_dopri5<State, T>>(x, times);
      if (method == Method::abm8) return this->run_multistep(x, times);
      if (method == Method::splitting) return run_splitting(x, times);
      if (method == Method::gauss) return this->run_gauss(x, times, rate_to_resolve(x));
      if (method == Method::dop853) return this->run_dop853(x, times);
    }
    throw std::logic_error("method not built for this precision");
  }

  /// Integrates by a composition of exact flows, with the step asked for or one that meets the tolerance.
  RunStatus run_splitting(State& x, std::span<const T> times) {
    if constexpr (std::is_same_v<T, double> && Splits<System>) {
      const auto flows = system_.flows();
      SplittingStepper stepper(flows, composition_table(options_.composition));
      const T step = options_.fixed_step_given ? options_.fixed_step : this->fixed_step_for(stepper, x, times, flows.rate(x));
      const RunStatus status = this->run_fixed(stepper, x, times, step);
      counters_.evaluations += counters_.accepted * stepper.evaluations_a_step();
      return status;
    }
    throw std::logic_error("this form of the equations does not split into exact flows");
  }

  /// The rate of the motion that fixed steps have to resolve; without the spin where its flow is exact.
  T rate_to_resolve([[maybe_unused]] const State& x) const {
    if constexpr (Splits<System>)
      return system_.flows().rate(x);
    else
      return options_.rate;
  }

  void see_step(T t, const State& x) override { on_step_(t, x); }
  void see_row(std::size_t row, const State& x) override { on_row_(row, x); }
  void settle([[maybe_unused]] State& x, [[maybe_unused]] T t) override {
    if constexpr (requires { system_.settle(x, t); }) system_.settle(x, t);
  }
  T limited(T proposed, [[maybe_unused]] const State& x, [[maybe_unused]] T t) override {
    if constexpr (requires { system_.longest_step(x, t); }) return std::min(proposed, system_.longest_step(x, t));
    return proposed;
  }

  using Loops::counters_;
  using Loops::options_;
  using Loops::scales_;
  using Loops::stops_;
  System& system_;
  OnStep& on_step_;
  OnRow& on_row_;
};

}  // namespace earthtop
