// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds when the axis drift first passes a threshold: from looks at the drift that lie some part of a turn apart, and from
/// further looks between them wherever the drift might have passed unseen.
#pragma once

#include <algorithm>
#include <functional>

#include "drift/watch/close_in.hpp"
#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// A look at the drift, made of the states at a time t and shortly before and after it.
/// @param apart  the time from `before` to `after`
template <class T>
AxisDriftSample<T> axis_look(T t, const DriftState<T>& at, const DriftState<T>& before, const DriftState<T>& after, T apart) {
  const AxisDrift<T> now = watched_drift(at), earlier = watched_drift(before), later = watched_drift(after);
  AxisDriftSample<T> look;
  look.t = t;
  look.axis = now.angle;
  look.rate = (later.angle - earlier.angle) / apart;
  look.difference = at.epsilon * now.difference_L_scaled;
  look.difference_rate = (at.epsilon / apart) * (later.difference_L_scaled - earlier.difference_L_scaled);
  return look;
}

/// A look that gives only the drift itself, without rates.
template <class T>
AxisDriftSample<T> axis_look(T t, const DriftState<T>& at) {
  AxisDriftSample<T> look;
  look.t = t;
  look.axis = watched_drift(at).angle;
  return look;
}

template <class T>
class ThresholdWatch {
 public:
  /// Gives the look at a time. It is called rarely, and the search is compiled once for all systems.
  using LookAt = std::function<AxisDriftSample<T>(T)>;

  /// @param threshold  in rad   @param motion_rate  roughly the rate of the fastest part of the motion (rad per unit of time)
  ThresholdWatch(T threshold, T motion_rate) : threshold_(threshold), motion_rate_(motion_rate) {}

  /// Goes on to the next look. @param look_at  gives the look at any time between the last look and this one
  void follow(const AxisDriftSample<T>& next, const LookAt& look_at) {
    if (!started_) {
      started_ = true;
    } else if (!record_.passing) {
      fastest_ = std::max({fastest_, norm(last_.difference_rate), norm(next.difference_rate)});
      looks_left_ = std::min(looks_left_ + kLooksAStep, kMostLooks);
      search(AxisDriftSample<T>(last_), next, look_at, 0);
    }
    note(next);
    last_ = next;
  }
  /// To be called if a look was impossible: what it showed is not the drift at the time asked for.
  void look_failed() { record_.unresolved = true; }
  const ThresholdRecord<T>& record() const { return record_; }
  /// Whether the drift has passed the threshold: from then on looks need no rates.
  bool has_passed() const { return record_.passing.has_value(); }
  /// Whether the record is complete.
  bool done() const { return record_.passing && next_beyond_ < 0; }

 private:
  /// The longest piece over which the drift is treated as a cubic, as an angle of the motion (rad). For an oscillation of
  /// amplitude A the error is then A 0.3^4/384, which is 2e-5 A.
  static constexpr double kFine = 0.3;
  /// Limits: more halvings than any piece of a run needs to become fine; the looks that may be taken at once, and the looks
  /// that each step adds to those left. They suffice for a passing, and are few enough for a drift that stays close to the
  /// threshold for the whole run.
  static constexpr int kMostHalvings = 60, kMostLooks = 20'000, kLooksAStep = 8;

  static T parts(int k) { return real::scale(T(1), -k); }

  void note(const AxisDriftSample<T>& look) {
    record_.last_t = look.t;
    const T axis = look.axis;
    if (!record_.passing) {
      if (axis < record_.highest) record_.turned_back = std::max(record_.turned_back, record_.highest);
      record_.highest = std::max(record_.highest, axis);
    } else if (axis < threshold_) {
      record_.fell_after = true;
    }
    for (; next_within_ < record_.kParts && (record_.passing || axis >= threshold_ * (T(1) - parts(next_within_)));
         ++next_within_)
      record_.within[static_cast<std::size_t>(next_within_)] = last_.t;
    for (; next_beyond_ >= 0 && axis >= threshold_ * (T(1) + parts(next_beyond_)); --next_beyond_)
      record_.beyond[static_cast<std::size_t>(next_beyond_)] = look.t;
  }

  /// Hermite's cubic through two looks, at the fraction s of the way from p to q.
  static T cubic(const AxisDriftSample<T>& p, const AxisDriftSample<T>& q, T s) {
    const T h = q.t - p.t, r = T(1) - s;
    return r * r * ((T(1) + T(2) * s) * p.axis + s * h * p.rate) + s * s * ((T(3) - T(2) * s) * q.axis - r * h * q.rate);
  }
  /// Roughly the largest value of that cubic, from values close together: it only decides which pieces to look into.
  static T cubic_top(const AxisDriftSample<T>& p, const AxisDriftSample<T>& q) {
    T top = std::max(p.axis, q.axis);
    for (int i = 1; i < 16; ++i) top = std::max(top, cubic(p, q, T(i) / T(16)));
    return top;
  }

  /// @returns whether the drift passes between p, where it is below the threshold, and q
  bool search(const AxisDriftSample<T>& p, const AxisDriftSample<T>& q, const LookAt& look_at, int halvings) {
    const T h = q.t - p.t, turned = motion_rate_ * h;
    if (!(h > T(0))) return false;
    // `above` is how far the drift may lie above the cubic or, in a long piece, above the larger of its ends.
    const bool long_piece = turned > T(2);
    const T reach = T(2) * fastest_ * h, above = long_piece ? reach : reach * turned * turned * turned / T(64);
    const T top = long_piece ? std::max(p.axis, q.axis) : cubic_top(p, q);
    if (top + above < threshold_) return false;
    const bool may_halve = halvings < kMostHalvings && looks_left_ > 0;
    if (may_halve) {
      const AxisDriftSample<T> middle = look(look_at, p.t + h / T(2));
      const bool is_cubic = real::abs(middle.axis - cubic(p, q, T(1) / T(2))) <= T(1e-3) * reach;
      if (turned > T(kFine) || !is_cubic) {
        if (search(p, middle, look_at, halvings + 1)) return true;
        note_before(middle);
        return search(middle, q, look_at, halvings + 1);
      }
    } else if (turned > T(kFine)) {
      record_.unresolved = true;
    }
    return search_resolved(p, q, look_at);
  }

  bool search_resolved(const AxisDriftSample<T>& p, const AxisDriftSample<T>& q, const LookAt& look_at) {
    if (q.axis >= threshold_) {
      pass(p, q, look_at);
      return true;
    }
    if (!(p.rate > T(0) && q.rate < T(0))) return false;
    // The drift turns back between the two looks: it passes and returns, or touches the threshold, or stays below it.
    AxisDriftSample<T> top = p;
    const auto rate_at = [&](T t) {
      const AxisDriftSample<T> there = look(look_at, t);
      if (there.axis > top.axis) top = there;
      return there.rate;
    };
    close_in(p.t, p.rate, q.t, q.rate, rate_at, [&] { return top.axis >= threshold_; });
    if (top.axis >= threshold_) {
      pass(p, top, look_at);
      record_.fell_after = true;
      return true;
    }
    record_.highest = std::max(record_.highest, top.axis);
    record_.turned_back = std::max(record_.turned_back, record_.highest);
    return false;
  }

  /// Finds the passing itself, between p below the threshold and q at or above it.
  void pass(const AxisDriftSample<T>& p, const AxisDriftSample<T>& q, const LookAt& look_at) {
    AxisDriftSample<T> above = q;
    const auto excess_at = [&](T t) -> T {
      const AxisDriftSample<T> there = look(look_at, t);
      if (there.axis >= threshold_ && there.t < above.t) above = there;
      return there.axis - threshold_;
    };
    close_in(p.t, T(p.axis - threshold_), q.t, T(q.axis - threshold_), excess_at, [] { return false; });
    // The drift's rate leads from that look back to the passing.
    if (above.rate > T(0)) above.t = std::max(p.t, above.t - (above.axis - threshold_) / above.rate);
    note_before(p);
    record_.highest = std::max(record_.highest, p.axis);
    record_.passing = above;
    record_.curvature = (q.rate - p.rate) / (q.t - p.t);
    record_.resolved = q.t - p.t;
    last_ = p;
  }
  /// Notes a look within the search, if it is later than the last one noted.
  void note_before(const AxisDriftSample<T>& look) {
    if (look.t <= last_.t) return;
    note(look);
    last_ = look;
  }
  AxisDriftSample<T> look(const LookAt& look_at, T t) {
    --looks_left_;
    AxisDriftSample<T> there = look_at(t);
    fastest_ = std::max(fastest_, norm(there.difference_rate));
    return there;
  }

  T threshold_, motion_rate_;
  bool started_ = false;
  AxisDriftSample<T> last_;
  T fastest_ = T(0);  ///< the largest rate of the difference of the axes so far
  int looks_left_ = kMostLooks;
  ThresholdRecord<T> record_;
  int next_within_ = 0, next_beyond_ = ThresholdRecord<T>::kParts - 1;
};

}  // namespace earthtop
