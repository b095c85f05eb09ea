// SPDX-License-Identifier: GPL-3.0-or-later
/// Watches a drift from step to step: finds when it passes the threshold, and follows the angles that can go round.
#pragma once

#include <optional>
#include <type_traits>

#include "drift/watch/flow_search.hpp"
#include "drift/watch/turn_counter.hpp"
#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// A system whose equations are written out only in another system, `flow()`, with states that `flow_state(x, t)` converts to.
template <class System>
concept HasFlow = requires(const System& system, typename System::State x) {
  system.flow(), system.flow_state(x, x[0]);
};
/// A system with equations of its own.
template <class System>
concept HasEquations = requires(const System& system, typename System::State x) {
  system(x, x, x[0]);
};

/// Takes the place of the threshold search for a system without equations to search with.
struct NoSearch {};
template <class T, class System>
struct SearchOf {
  using Type = NoSearch;
};
template <class T, HasEquations System>
struct SearchOf<T, System> {
  using Type = FlowSearch<T, System>;
};
template <class T, HasFlow System>
struct SearchOf<T, System> {
  using Type = FlowSearch<T, typename System::Flow>;
};

/// Stands for the watch of events of a system that has none; a system with events of its own names another one.
struct NoEvents {
  template <class System, class Units>
  NoEvents(const System&, const Units&) {}
  template <class T, class State>
  void follow(const T&, const State&) {}
};
template <class T, class System>
struct EventWatchOf {
  using Type = NoEvents;
};

/// How often the two angles have gone round.
template <class T>
struct StepWatcherTurns {
  TurnCounter<T> half_spin, azimuth;
};

/// Is called with every step. It keeps the angles continuous, and finds when the axis drift first passes the threshold.
template <class T, class System>
class StepWatcher {
 public:
  using Search = typename SearchOf<T, System>::Type;

  StepWatcher(System& system, const DriftProblem<T>& problem)
      : system_(system), units_(problem.units), sought_(problem.sought), events_(system, problem.units) {
    if constexpr (!std::is_same_v<Search, NoSearch>)
      if (problem.threshold_rad) search_.emplace(flow(system), T(*problem.threshold_rad), problem.fastest_rate);
  }

  void operator()(T t, const typename System::State& x) {
    follow(x, t);
    if (sought_ == DriftSought::rows) follow_angles(system_.deviation_state(x, t));
    search(t, x);
    events_.follow(t, x);
  }
  const auto& events() const { return events_; }

  /// The sample for a state that operator() has seen. @param t  its time in natural units   @param t_s  the same time as given by
  /// the scenario (s)
  DriftSample<T> sample(const typename System::State& x, T t, double t_s) const {
    return sample_of(system_.shared_state(x, t), x, t, t_s);
  }
  /// Both in one: the angles are followed to those of the sample.
  DriftSample<T> seen_sample(const typename System::State& x, T t, double t_s) {
    follow(x, t);
    DriftState<T> state = system_.shared_state(x, t);
    if (sought_ == DriftSought::rows) follow_angles(state);
    search(t, x);
    return sample_of(state, x, t, t_s);
  }
  /// How often the angles have gone round so far, for another watcher that goes on from here.
  const StepWatcherTurns<T>& turns() const { return turns_; }
  void go_on_from(const StepWatcherTurns<T>& turns) { turns_ = turns; }
  /// The record of the drift's first passing of the threshold, in seconds; none where no threshold is asked for.
  std::optional<ThresholdRecord<T>> threshold() const {
    if constexpr (!std::is_same_v<Search, NoSearch>)
      if (search_) return search_->record().in_seconds(units_.time_exponent);
    return std::nullopt;
  }

 private:
  void follow(const typename System::State& x, [[maybe_unused]] T t) {
    if constexpr (requires { system_.follow(x, t); })
      system_.follow(x, t);
    else
      system_.follow(x);
  }
  void follow_angles(const DriftState<T>& state) {
    const DriftPhases<T> phases = drift_phases(state);
    turns_.half_spin.follow(phases.half_spin_sine, phases.half_spin_cosine);
    if (phases.azimuth_defined) turns_.azimuth.follow(phases.azimuth_sine, phases.azimuth_cosine);
  }
  void search([[maybe_unused]] T t, [[maybe_unused]] const typename System::State& x) {
    if constexpr (!std::is_same_v<Search, NoSearch>)
      if (search_) search_->follow(flow(system_), t, flow_state(x, t));
  }
  DriftSample<T> sample_of(const DriftState<T>& state, const typename System::State& x, T t, double t_s) const {
    DriftSample<T> sample;
    sample.state = state;
    sample.measures = measure_drift(state, sought_);
    sample.spin = T(2) * (sample.measures.half_spin + turns_.half_spin.offset());
    sample.azimuth = sample.measures.azimuth + turns_.azimuth.offset();
    sample.state.t_s = T(t_s);
    for (Vec3<T>* rate : {&sample.state.w_LB_B, &sample.state.ref_w_LB_B})
      for (int i = 0; i < 3; ++i) (*rate)[i] = units_.rate_to_rad_s((*rate)[i]);
    sample.rotor = rotor_of(state, x, t);
    sample.gimbals = gimbals_of(x, t);
    return sample;
  }
  /// The state of a gyrostat's rotor, with rates in rad/s; null for other tops.
  std::shared_ptr<const RotorState<T>> rotor_of([[maybe_unused]] const DriftState<T>& both,
                                                [[maybe_unused]] const typename System::State& x, [[maybe_unused]] T t) const {
    if constexpr (requires { system_.rotor_state(x, t); }) {
      std::optional<RotorState<T>> rotor = system_.rotor_state(x, t);
      if (!rotor) return nullptr;
      for (T* rate : {&rotor->rate, &rotor->ref_rate, &rotor->rate_difference_scaled}) *rate = units_.rate_to_rad_s(*rate);
      rotor->axis = drift_of_axis(both, rotor->axis_B);
      return std::make_shared<const RotorState<T>>(*rotor);
    } else {
      return nullptr;
    }
  }
  /// The gimbals of a Cardan suspension, with rates in rad/s; null for other tops.
  std::shared_ptr<const GimbalState<T>> gimbals_of([[maybe_unused]] const typename System::State& x,
                                                   [[maybe_unused]] T t) const {
    if constexpr (requires { system_.gimbal_state(x, t); }) {
      GimbalState<T> gimbals = system_.gimbal_state(x, t);
      for (Paired<T>* rate : {&gimbals.outer_rate, &gimbals.inner_rate})
        for (T* part : {&rate->ref, &rate->rot, &rate->diff}) *part = units_.rate_to_rad_s(*part);
      return std::make_shared<const GimbalState<T>>(gimbals);
    } else {
      return nullptr;
    }
  }
  static decltype(auto) flow(const System& system) {
    if constexpr (HasFlow<System>)
      return system.flow();
    else
      return (system);
  }
  decltype(auto) flow_state(const typename System::State& x, [[maybe_unused]] T t) const {
    if constexpr (HasFlow<System>)
      return system_.flow_state(x, t);
    else
      return (x);
  }

  System& system_;
  const NaturalUnits& units_;
  DriftSought sought_;
  StepWatcherTurns<T> turns_;
  std::optional<Search> search_;
  typename EventWatchOf<T, System>::Type events_;
};

}  // namespace earthtop
