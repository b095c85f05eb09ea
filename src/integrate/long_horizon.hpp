// SPDX-License-Identifier: GPL-3.0-or-later
/// The long-horizon method moves a symmetric top on the rotating Earth by exact flows and kicks (tilted_top.hpp). Where the
/// nutation is fast, its steps resolve only the precession; where it is not, they resolve the nutation. Neither the spin nor,
/// in the first case, the nutation costs any work.
///
/// Steps much longer than the nutation period would excite nutation by aliasing. Therefore each kick is spread: its parts follow
/// each other at intervals of a third or a fifth of the nutation period, centred on the time of the kick (kick_filter.hpp).
/// Since the flows between the parts are exact, spreading adds no error to the step. The parts of a kick do not commute: the
/// error that this leaves changes sign with their order. So the order is backward in the second half of a step and, for a
/// kick in the middle of it, in every other step.
///
/// A step with spread kicks leaves out the ripple: the effect that the kicks have within a nutation period. The state at
/// release contains its share of that. The ripple is evaluated by some further kicks; it is taken off at the start and put back at every output time.
///
/// The steps divide the whole run, whatever its output times. An output time within a step is reached by a shorter step aside, from
/// which nothing goes on.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "earthtop/integrate/options.hpp"
#include "earthtop/watch.hpp"
#include "integrate/kick_filter.hpp"
#include "integrate/kick_schedule.hpp"
#include "integrate/tilted_top.hpp"

namespace earthtop {

/// The settings with which the method steps through a run.
template <class T>
struct LongHorizonPlan {
  KickSchedule schedule;
  T step = T(1);  ///< the longest step; the one taken divides the duration
  Averaging averaging = Averaging::none;
  KickFilter<T> filter;  ///< how kicks are spread
  bool averages() const { return averaging != Averaging::none; }
};

/// Whether the plan's schedule is that of the composition ABA(8, 6, 4).
template <class T>
bool is_composed(const LongHorizonPlan<T>& plan) {
  return plan.schedule.kicks == kick_schedules::aba864().kicks;
}

/// A plan with this schedule and step. @param averaging  other than `none` only for a finite nutation period
template <class T>
LongHorizonPlan<T> make_plan(const TiltedTop<T>& top, const KickSchedule& schedule, T step, Averaging averaging);
/// The filter of a plan. @param wider  whether it spreads the kicks more widely, for an independent check
template <class T>
KickFilter<T> make_filter(const TiltedTop<T>& top, Averaging averaging, bool wider);

/// The plan whose error over `duration` is about `tolerance` (rad, of the attitude but for its turn by the spin). It is found from an estimate and a trial on
/// part of the duration, in which the step is halved until two results agree.
/// @param counters  the trial's cost is added to them
/// @param watch  may end the trial early: the plan returned is then not checked
template <class T>
LongHorizonPlan<T> find_plan(const TiltedTop<T>& top, T duration, T tolerance, StepCounters& counters, const Watch& watch = {});

/// The work of `find_plan`, and of a walk by the plan.
struct LongHorizonWork {
  double search_steps = 0, search_evaluations = 0;
  double steps = 0, evaluations = 0;
  Averaging averaging = Averaging::none;
};
/// The work of a walk through the duration that is looked at so many times; nothing is searched.
template <class T>
LongHorizonWork walking_work(const TiltedTop<T>& top, const LongHorizonPlan<T>& plan, T duration, double looks);
/// The work expected of the search and of a walk, from the guess with which `find_plan` begins.
/// @param share  the step taken in the walk, in steps found
template <class T>
LongHorizonWork expected_work(const TiltedTop<T>& top, T duration, T tolerance, double looks, double share = 1);

/// Whether steps of this length may average over the nutation, and how finely they must: whether they are longer than its
/// period, and keep the tolerance (rad) or an error that can be stated.
template <class T>
Averaging may_average(const TiltedTop<T>& top, T duration, T step, T tolerance);

/// The error of averaging over the nutation, over `duration` and beside the ripple (rad). On tops of many kinds the coarse
/// filter's was measured to be 0.03 to 0.15 of ripple x Earth's rate x time; a fifth is stated. It is what the fine filter
/// makes up for: there a hundredth to a fifteenth of that was left, and a tenth is stated.
template <class T>
T averaging_error(const TiltedTop<T>& top, T duration, Averaging averaging);

/// The plan with the steps that another run has found.
template <class T>
LongHorizonPlan<T> plan_from(const TiltedTop<T>& top, const KickSteps& steps, const NaturalUnits& units);

/// The number of steps of a plan in this time: at least 1, and at most more than any run takes.
template <class T>
std::int64_t steps_in(const LongHorizonPlan<T>& plan, T time) {
  constexpr double kMost = 1e18;
  const double steps = std::ceil(static_cast<double>(time / plan.step) * (1 - 1e-12));
  return static_cast<std::int64_t>(steps >= 1 ? std::min(steps, kMost) : 1.0);
}

/// A schedule with fewer kicks, and the longest step in which it errs no more than a plan's own schedule does in the plan's step.
template <class T>
struct ShorterStep {
  T longest;
  KickSchedule schedule;
};
/// Such schedules, beginning with the fewest kicks; at last the plan's own one for its step.
template <class T>
std::vector<ShorterStep<T>> shorter_steps(const TiltedTop<T>& top, const LongHorizonPlan<T>& plan);

/// Moves a top through time by a plan.   @tparam Top  a TiltedTop, or one whose kicks do more
template <class T, class Top = TiltedTop<T>>
class LongHorizonWalk {
 public:
  /// @param watch  may stop the walk between any two steps
  LongHorizonWalk(const Top& top, const LongHorizonPlan<T>& plan, StepCounters& counters, const Watch& watch)
      : top_(top), plan_(plan), counters_(counters), watch_(watch), x_(top.start()) {
    if (plan.averages()) ripple(T(-1), x_);
  }

  /// Moves on by one interval.
  /// @param longest_time_between_looks  the longest time between two looks; 0: no looks
  /// @param look  called with the time since the interval's beginning and a state that is good enough for counting turns
  template <class Look>
  void advance(T interval, T longest_time_between_looks, Look&& look) {
    steps_ = steps_in(plan_, interval);
    go(interval, plan_.schedule, longest_time_between_looks, look);
  }
  /// The same in one step of another schedule.
  template <class Look>
  void advance_by(T interval, const KickSchedule& schedule, T longest_time_between_looks, Look&& look) {
    steps_ = 1;
    go(interval, schedule, longest_time_between_looks, look);
  }
  /// Where a walk stands between two intervals; a walk of the same top by the same plan can go on from there.
  struct Position {
    TiltedTopState<T> x;
    bool backward = false;
  };
  Position position() const { return {x_, backward_}; }
  void go_to(const Position& there) { x_ = there.x, backward_ = there.backward; }
  /// The state at the end of the last interval, with its ripple.
  TiltedTopState<T> state() const {
    TiltedTopState<T> x = x_;
    if (plan_.averages()) ripple(T(1), x);
    return x;
  }

 private:
  template <class Look>
  void go(T interval, const KickSchedule& schedule, T longest_time_between_looks, Look&& look) {
    step_ = interval / T(steps_);
    T position = T(0), looked = T(0), target = T(0);
    const auto move = [&]() {
      if (target == position) return;
      const bool brief = plan_.averages() && real::abs(target - position) <= plan_.filter.period;
      const typename TiltedTop<T>::Flow flow(top_, x_, brief ? ClosedFormSpan::few_periods : ClosedFormSpan::any);
      ++counters_.evaluations;
      if (longest_time_between_looks > T(0))
        for (; looked + longest_time_between_looks < target; looked += longest_time_between_looks)
          if (looked + longest_time_between_looks > position)
            look(looked + longest_time_between_looks, flow.at(looked + longest_time_between_looks - position));
      x_ = flow.at(target - position);
      position = target;
    };
    const int kicks = schedule.kicks, parts = plan_.filter.parts;
    for (std::int64_t i = 0; i < steps_; ++i, backward_ = !backward_) {
      if (watch_.asks_to_stop()) return;
      for (int j = 0; j < kicks; ++j) {
        const bool backward = 2 * j + 1 == kicks ? backward_ : 2 * j + 1 > kicks;
        const T at = (T(i) + T(schedule.at[static_cast<std::size_t>(j)])) * step_;
        const T weight = T(schedule.weight[static_cast<std::size_t>(j)]) * step_;
        const auto pass = [&](bool back, T share) {
          for (int part = 0; part < parts; ++part) {
            const auto k = static_cast<std::size_t>(back ? parts - 1 - part : part);
            target = at + plan_.filter.at[k];
            move();
            top_.kick(share * plan_.filter.weight[k] * weight, x_);
          }
        };
        if (plan_.filter.returns) {
          const T more = plan_.filter.second_order / weight, forward = (T(1) + more) / T(2), back = (T(1) - more) / T(2);
          pass(backward, backward ? back : forward);
          pass(!backward, backward ? forward : back);
        } else {
          pass(backward, T(1));
        }
      }
    }
    target = interval;
    move();
    counters_.accepted += steps_;
  }

  /// Adds the ripple (sign = 1) or takes it off (sign = -1).
  void ripple(T sign, TiltedTopState<T>& x) const {
    const KickFilter<T>& filter = plan_.filter;
    T position = T(0);
    for (int i = -filter.ripples; i <= filter.ripples; ++i) {
      if (i == 0) continue;
      const auto k = static_cast<std::size_t>(std::abs(i) - 1);
      const T target = i < 0 ? -filter.ripple_at[k] : filter.ripple_at[k];
      top_.flow_briefly(target - position, x);
      top_.kick(sign * (i < 0 ? -filter.ripple_weight[k] : filter.ripple_weight[k]), x);
      position = target;
    }
    top_.flow_briefly(-position, x);
    counters_.evaluations += filter.ripple_flows();
  }

  const Top& top_;
  const LongHorizonPlan<T>& plan_;
  StepCounters& counters_;
  Watch watch_;
  TiltedTopState<T> x_;
  std::int64_t steps_ = 1;
  T step_ = T(0);
  bool backward_ = false;  ///< whether the parts of a middle kick come in backward order
};

/// A top's way through a whole run in equal steps, seen at any times. A time within a step is reached by a walk aside, in as few
/// kicks as its shorter step needs, so that the way does not depend on the times at which it is seen.
template <class T>
class LongHorizonPath {
 public:
  LongHorizonPath(const TiltedTop<T>& top, const LongHorizonPlan<T>& plan, T duration, StepCounters& counters,
                  const Watch& watch)
      : plan_(in_equal_steps(plan, duration)), shorter_(shorter_steps(top, plan_)), walk_(top, plan_, counters, watch) {}
  LongHorizonPath(const LongHorizonPath&) = delete;
  LongHorizonPath& operator=(const LongHorizonPath&) = delete;

  /// The number of steps up to this time, which is not before the last one asked for.
  T steps_to(T t) const { return t / plan_.step - T(done_); }
  /// The number of whole steps in this time.
  std::int64_t whole_steps(T t) const {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(t / plan_.step) * (1 + 1e-12)));
  }
  /// The steps done, and where they have led.
  std::int64_t steps_done() const { return done_; }
  T time_done() const { return T(done_) * plan_.step; }
  const LongHorizonWalk<T>& walk() const { return walk_; }
  /// Goes on from a position after so many steps, more than are done.
  void go_to(std::int64_t steps, const typename LongHorizonWalk<T>::Position& position) {
    done_ = steps, walk_.go_to(position), aside_.reset();
  }
  /// Returns the state at a time that is not before the last one asked for, with its ripple.
  /// @param look  called with increasing times on the way, and states that are good enough for counting turns
  /// @param stop  called after whole steps
  template <class Look, class Stop>
  TiltedTopState<T> at(T t, T longest_time_between_looks, Look&& look, Stop&& stop) {
    const auto seen = [&](T begin) {
      return [&, begin](T since, const TiltedTopState<T>& x) {
        if (begin + since > looked_) looked_ = begin + since, look(looked_, x);
      };
    };
    if (const std::int64_t whole = whole_steps(t); whole > done_) {
      walk_.advance(T(whole - done_) * plan_.step, longest_time_between_looks, seen(time_done()));
      done_ = whole;
      stop();
    }
    const T step_begin = time_done();
    if (!(t - step_begin > T(1e-12) * plan_.step)) return walk_.state();
    if (!aside_ || aside_at_ < step_begin) aside_.emplace(walk_), aside_at_ = step_begin;
    if (const T rest = t - aside_at_; rest > T(0)) {
      const auto shorter = std::ranges::find_if(shorter_, [&](const ShorterStep<T>& s) { return rest <= s.longest; });
      aside_->advance_by(rest, shorter == shorter_.end() ? plan_.schedule : shorter->schedule, longest_time_between_looks,
                         seen(aside_at_));
      aside_at_ = t;
    }
    return aside_->state();
  }

 private:
  static LongHorizonPlan<T> in_equal_steps(LongHorizonPlan<T> plan, T duration) {
    if (duration > T(0)) plan.step = duration / T(steps_in(plan, duration));
    return plan;
  }

  LongHorizonPlan<T> plan_;
  std::vector<ShorterStep<T>> shorter_;
  LongHorizonWalk<T> walk_;
  std::int64_t done_ = 0;                    ///< steps of the way
  std::optional<LongHorizonWalk<T>> aside_;  ///< goes on from look to look within a step
  T aside_at_ = T(0);                        ///< its time
  T looked_ = T(0);                          ///< time of the last look
};

}  // namespace earthtop
