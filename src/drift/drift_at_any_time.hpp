// SPDX-License-Identifier: GPL-3.0-or-later
/// The rows of a drift that a formula gives at any time, without steps to get there.
#pragma once

#include <optional>
#include <vector>

#include "closed_form/followed_motion.hpp"
#include "drift/release_rates.hpp"
#include "drift/watch/angle_follower.hpp"
#include "drift/watch/threshold_watch.hpp"

namespace earthtop {

/// Looks at the drift at any time.
template <class T, class Pair>
class LooksAtPair {
 public:
  explicit LooksAtPair(Pair& pair)
      : pair_(pair), apart_(T(real::cbrt(static_cast<double>(real::epsilon<T>())) * pair.radian_time())) {}
  AxisDriftSample<T> operator()(T t) {
    const T before = std::max(T(0), T(t - apart_)), after = t + apart_;
    const DriftState<T> at = pair_.state(t), at_before = pair_.state(before), at_after = pair_.state(after);
    return axis_look(t, at, at_before, at_after, T(after - before));
  }

 private:
  Pair& pair_;
  T apart_;
};

/// @tparam Pair  the two motions and their deviation at any time from the release on, in natural units:
///   state(t)  the drift state, with rates in natural units; `t_s` is left to the caller
///   rotor(t, state)  the rotor at the time of the last state, or null
///   attitude_error(t), drift_error(attitude_drift)  bounds that hold for the last state
///   advance(t), followed_state(t)  as AngleFollower asks
///   longest_step()  the longest time between two looks at which no angle can go round unseen
///   watch_step()  the same, where the drift is watched for a threshold
///   radian_time()  the time in which both motions turn by about a radian
template <class T, class Pair>
DriftTrajectory<T> drift_at_any_time(Pair& pair, const DriftProblem<T>& problem, const std::vector<T>& times,
                                     const IntegrationOptions& options, const Watch& watch) {
  const std::vector<double> seen(times.begin(), times.end());
  AngleFollower angles(pair);
  DriftTrajectory<T> trajectory;
  trajectory.samples.reserve(times.size());
  std::optional<ThresholdWatch<T>> threshold;
  if (problem.threshold_rad)
    threshold.emplace(T(*problem.threshold_rad), std::max(problem.fastest_rate, T(1 / pair.radian_time())));
  LooksAtPair<T, Pair> look_at(pair);
  const auto visit = [&](double t, std::int64_t row) {
    ++trajectory.counters.accepted;
    ++trajectory.counters.evaluations;
    angles.follow_to(t);
    const T exact_t = row < 0 ? T(t) : times[static_cast<std::size_t>(row)];
    if (threshold && !threshold->done())
      threshold->follow(threshold->has_passed() ? axis_look(exact_t, pair.state(exact_t)) : look_at(exact_t), look_at);
    if (row < 0) return;
    const DriftState<T> state = pair.state(exact_t);
    const DriftMeasures<T> measures = measure_drift(state);
    angles.settle(drift_phases(state));
    DriftSample<T> sample;
    sample.state = state, sample.measures = measures;
    sample.spin = T(2) * (measures.half_spin + T(angles.half_spin_offset()));
    sample.azimuth = measures.azimuth + T(angles.azimuth_offset());
    sample.attitude_error = pair.attitude_error(exact_t);
    sample.drift_error = pair.drift_error(measures.attitude);
    sample.rotor = pair.rotor(exact_t, state);
    sample.state.t_s = T(problem.times_s[static_cast<std::size_t>(row)]);
    for (Vec3<T>* rate : {&sample.state.w_LB_B, &sample.state.ref_w_LB_B})
      for (int i = 0; i < 3; ++i) (*rate)[i] = problem.units.rate_to_rad_s((*rate)[i]);
    if (row == 0) set_release_rates(problem, sample.state);
    trajectory.samples.push_back(sample);
  };
  trajectory.status = visit_times(seen, threshold ? pair.watch_step() : pair.longest_step(), options.step_limit, watch, visit);
  if (threshold) trajectory.threshold = threshold->record().in_seconds(problem.units.time_exponent);
  return trajectory;
}

}  // namespace earthtop
