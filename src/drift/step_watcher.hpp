/// What watches a drift from step to step: the threshold, and angles that go round.
#pragma once

#include <optional>

#include "drift/turn_counter.hpp"
#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Sees every step: keeps the angles continuous, and notes when the axis drift first passes the threshold.
template <class T, class System>
class StepWatcher {
 public:
  StepWatcher(System& system, const NaturalUnits& units, std::optional<double> threshold)
      : system_(system), units_(units), threshold_(threshold) {}

  void operator()(T t, const typename System::State& x) {
    system_.follow(x);
    const DriftState<T> state = system_.deviation_state(x, t);
    const DriftPhases<T> phases = drift_phases(state);
    half_spin_.follow(phases.half_spin_sine, phases.half_spin_cosine);
    if (phases.azimuth_defined) azimuth_.follow(phases.azimuth_sine, phases.azimuth_cosine);
    if (threshold_ && !threshold_time_s_) watch_threshold(real::scale(t, units_.time_exponent), measure_drift(state).axis);
  }

  /// @param t  of the state, in natural units   @param t_s  the same as the scenario has it
  DriftSample<T> sample(const typename System::State& x, T t, double t_s) const {
    DriftSample<T> sample;
    sample.state = system_.shared_state(x, t);
    sample.measures = measure_drift(sample.state);
    sample.spin = T(2) * (sample.measures.half_spin + half_spin_.offset());
    sample.azimuth = sample.measures.azimuth + azimuth_.offset();
    sample.state.t_s = T(t_s);
    for (Vec3<T>* rate : {&sample.state.w_LB_B, &sample.state.ref_w_LB_B})
      for (int i = 0; i < 3; ++i) (*rate)[i] = units_.rate_to_rad_s((*rate)[i]);
    return sample;
  }
  std::optional<double> threshold_time_s() const { return threshold_time_s_; }

 private:
  void watch_threshold(T t_s, T axis) {
    if (axis >= T(*threshold_)) {
      const T climb = axis - axis_before_;
      const T part = climb > T(0) ? (T(*threshold_) - axis_before_) / climb : T(1);
      threshold_time_s_ = static_cast<double>(t_before_s_ + part * (t_s - t_before_s_));
    }
    axis_before_ = axis;
    t_before_s_ = t_s;
  }

  System& system_;
  const NaturalUnits& units_;
  std::optional<double> threshold_;
  TurnCounter<T> half_spin_, azimuth_;
  T axis_before_ = T(0), t_before_s_ = T(0);
  std::optional<double> threshold_time_s_;
};

}  // namespace earthtop
