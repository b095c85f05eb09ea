// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/event_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "run/drift_bound.hpp"

namespace earthtop {
namespace {

/// Smallest bound as a share of the time: neither a double nor the search for the event resolves less.
constexpr double kLeast = 1e-12;

/// Returns the bound on the drift's error when the drift passes the threshold (rad). It combines the bound of the rows before
/// with the distance of the two integrations at the passing, the second one's extrapolated to the first one's time.
template <class T>
T bound_at_passing(const TwoIntegrations<T>& made, const AxisDriftSample<T>& passing, int safety) {
  DriftBound<T> bound(safety);
  const std::size_t count = std::min(made.first.samples.size(), made.second.samples.size());
  T stated = T(0);  // error that the method states for the rows, interpolated to the passing
  for (std::size_t i = 0; i < count; ++i) {
    const DriftSample<T>& sample = made.first.samples[i];
    if (sample.state.t_s > passing.t) {
      const T before_s = i > 0 ? made.first.samples[i - 1].state.t_s : T(0);
      stated += std::max(T(0), T(sample.drift_error - stated)) * (passing.t - before_s) / (sample.state.t_s - before_s);
      break;
    }
    stated = std::max(stated, sample.drift_error);
    const DriftSample<T>& second = made.second.samples[i];
    bound.include(sample, second);
  }
  const AxisDriftSample<T>& other = *made.second.threshold->passing;
  const T later = passing.t - other.t;
  const Vec3<T> apart = passing.difference - (other.difference + later * other.difference_rate);
  const T distance = std::max(norm(apart), T(real::abs(passing.rate * later)));
  const T round_off = T(1024) * real::epsilon<T>() * passing.axis;
  return stated + std::max(bound.watched_axis(), T(T(safety) * distance + round_off));
}

/// Returns the time (s) that the drift takes from the threshold to a distance `bound` from it, by its rate and curvature; empty
/// where it may turn back before.
template <class T>
std::optional<T> time_to(T bound, T rate, T curvature) {
  const T bend = T(2) * curvature * bound;
  if (!(real::abs(bend) <= rate * rate / T(2))) return std::nullopt;
  const T slower = real::sqrt(rate * rate - real::abs(bend));
  return T(2) * bound / (rate + slower);
}

/// Returns the earliest time (s) at which the drift can have been less than `bound` below the threshold; `first_beyond` returns
/// the latest time (s) by which it was `bound` above the threshold.
template <class T>
std::optional<T> first_within(const ThresholdRecord<T>& record, T threshold, T bound) {
  std::optional<T> t = T(0);
  for (std::size_t k = 0; k < record.within.size() && real::scale(threshold, -static_cast<int>(k)) >= bound; ++k)
    if (record.within[k]) t = record.within[k];
  return t;
}
template <class T>
std::optional<T> first_beyond(const ThresholdRecord<T>& record, T threshold, T bound) {
  for (std::size_t k = record.beyond.size(); k-- > 0;)
    if (record.beyond[k] && real::scale(threshold, -static_cast<int>(k)) >= bound) return record.beyond[k];
  return std::nullopt;
}

struct Judged {
  ThresholdCrossing crossing;
  std::optional<double> bound_s = {};
};

template <class T>
Judged judge_passing(const ThresholdRecord<T>& record, T threshold, T bound) {
  const AxisDriftSample<T>& passing = *record.passing;
  if (record.unresolved || !(bound < threshold)) return {ThresholdCrossing::uncertain};
  const T early = passing.t - first_within(record, threshold, bound).value_or(T(0));
  const std::optional<T> near = passing.rate > T(0) ? time_to(bound, passing.rate, record.curvature) : std::nullopt;
  const bool is_local = near && *near <= record.resolved && *near <= record.last_t - passing.t;
  // The drift came as near before and fell again, unless that fall is only the rounding of the drift.
  constexpr double kSoon = 8;
  const bool came_near = threshold - record.turned_back <= bound;
  if (came_near && !(is_local && early <= T(kSoon) * *near + record.resolved)) return {ThresholdCrossing::tangential};
  T moved = T(0);
  if (is_local) {
    moved = *near;
  } else if (const std::optional<T> beyond = first_beyond(record, threshold, bound)) {
    moved = std::max(early, T(*beyond - passing.t));
  } else {
    return {record.fell_after ? ThresholdCrossing::tangential : ThresholdCrossing::uncertain};
  }
  return {ThresholdCrossing::clear, std::max(static_cast<double>(moved), kLeast * static_cast<double>(passing.t))};
}

/// Returns the largest difference (rad/s) between the two integrations in the size of a motion's rate, over the rows before it
/// stops. It is needed because the two stop times may agree by chance.
template <class T>
T rate_distance(const TwoIntegrations<T>& made, Prediction prediction, double until_s) {
  const auto rate = [&](const DriftSample<T>& sample) {
    return norm(prediction == Prediction::rotating ? sample.state.w_LB_B : sample.state.ref_w_LB_B);
  };
  const std::size_t count = std::min(made.first.samples.size(), made.second.samples.size());
  T distance = T(0);
  for (std::size_t i = 0; i < count && made.first.samples[i].state.t_s < T(until_s); ++i)
    distance = std::max(distance, T(real::abs(rate(made.first.samples[i]) - rate(made.second.samples[i]))));
  return distance;
}

}  // namespace

template <class T>
void assess_threshold(const TwoIntegrations<T>& made, double threshold_rad, int safety, DriftSummary& drift) {
  if (!made.first.threshold || !made.second.threshold) return;
  const ThresholdRecord<T>&first = *made.first.threshold, &second = *made.second.threshold;
  const T threshold = T(threshold_rad);
  drift.threshold_time_s = first.time_s();
  if (first.passing && second.passing) {
    const Judged judged = judge_passing(first, threshold, bound_at_passing(made, *first.passing, safety));
    drift.threshold_crossing = judged.crossing, drift.threshold_time_bound_s = judged.bound_s;
  } else if (first.passing || second.passing) {
    // Only one of the two integrations passes the threshold.
    const ThresholdRecord<T>& short_of_it = first.passing ? second : first;
    drift.threshold_crossing =
        short_of_it.turned_back >= short_of_it.highest ? ThresholdCrossing::tangential : ThresholdCrossing::uncertain;
  } else {
    const bool told = T(drift.watched_axis_bound_rad()) < threshold - first.highest && !first.unresolved;
    const bool turned = first.turned_back >= first.highest;
    drift.threshold_crossing = told     ? ThresholdCrossing::not_reached
                               : turned ? ThresholdCrossing::tangential
                                        : ThresholdCrossing::uncertain;
  }
}

template <class T>
std::vector<GimbalEvent> assess_gimbal_events(const TwoIntegrations<T>& made, int safety) {
  std::vector<GimbalEvent> events = made.first.gimbal_events;
  const std::vector<GimbalEvent>& others = made.second.gimbal_events;
  for (std::size_t i = 0; i < std::min(events.size(), others.size()); ++i) {
    if (others[i].kind != events[i].kind) break;
    events[i].bound_s = safety * std::abs(others[i].t_s - events[i].t_s) + 64 * real::epsilon<double>() * events[i].t_s;
  }
  return events;
}

template <class T>
std::vector<StopEvent> assess_stops(const TwoIntegrations<T>& made, int safety) {
  std::vector<StopEvent> stops = made.first.stops;
  for (StopEvent& stop : stops) {
    const auto other = std::ranges::find(made.second.stops, stop.prediction, &StopEvent::prediction);
    if (other == made.second.stops.end()) continue;
    double distance = std::abs(stop.t_s - other->t_s);
    if (stop.slowing_rad_s2 > 0)
      distance += static_cast<double>(rate_distance(made, stop.prediction, stop.t_s)) / stop.slowing_rad_s2;
    stop.bound_s = safety * distance + kLeast * stop.t_s;
  }
  return stops;
}

#define EARTHTOP_EVENT_BOUNDS(T)                                                         \
  template void assess_threshold(const TwoIntegrations<T>&, double, int, DriftSummary&); \
  template std::vector<StopEvent> assess_stops(const TwoIntegrations<T>&, int);          \
  template std::vector<GimbalEvent> assess_gimbal_events(const TwoIntegrations<T>&, int);
EARTHTOP_EVENT_BOUNDS(double)
EARTHTOP_EVENT_BOUNDS(float80)
EARTHTOP_EVENT_BOUNDS(float128)

}  // namespace earthtop
