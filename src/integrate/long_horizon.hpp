// SPDX-License-Identifier: GPL-3.0-or-later
/// The long-horizon method moves a symmetric top on the rotating Earth by exact flows and kicks (tilted_top.hpp). Where the
/// nutation is fast, its steps resolve only the precession; where it is not, they resolve the nutation. Neither the spin nor,
/// in the first case, the nutation costs any work.
///
/// Steps much longer than the nutation period would excite nutation by aliasing. Therefore each kick is spread: parts of 1, 2,
/// 3, 2 and 1 ninths follow each other at intervals of a third of the nutation period, centred on the time of the kick. The
/// spread kick has no response to the nutation and to its second harmonic, to first order in the precession too (the zeros are
/// double). Without the zero at the second harmonic, steps near a multiple of half the period would accumulate its error.
/// Since the flows between the parts are exact, spreading adds no error to the step. The parts of a kick do not commute: the
/// error that this leaves changes sign with their order. So the order is backward in the second half of a step and, for a
/// kick in the middle of it, in every other step.
///
/// A step with spread kicks leaves out the ripple: the effect that the kicks have within a nutation period. The state at
/// release contains its share of that. The ripple is an integral of zero mean over one period, evaluated by six further kicks;
/// it is taken off at the start and put back at every output time.
#pragma once

#include <array>
#include <cmath>

#include "earthtop/integrate/options.hpp"
#include "earthtop/watch.hpp"
#include "integrate/kick_schedule.hpp"
#include "integrate/tilted_top.hpp"

namespace earthtop {

/// The settings with which the method steps through a run.
template <class T>
struct LongHorizonPlan {
  KickSchedule schedule;
  T step = T(1);            ///< the longest step; the one taken divides the interval between two output times
  bool averages = false;    ///< whether kicks are spread to average over the nutation, with the ripple treated apart
  T period = T(0);          ///< nutation period, where `averages`
  int spacing = 1;          ///< interval between the parts of a kick, in thirds of the period; no multiple of 3
  T ripple_weight[3] = {};  ///< weights of the six ripple kicks, at 1/8, 2/8 and 3/8 of the period before and after
};

/// Whether the plan's schedule is that of the composition ABA(8, 6, 4).
template <class T>
bool is_composed(const LongHorizonPlan<T>& plan) {
  return plan.schedule.kicks == kick_schedules::aba864().kicks;
}

/// A plan with this schedule and step. @param averages  true only for a finite nutation period
template <class T>
LongHorizonPlan<T> make_plan(const TiltedTop<T>& top, const KickSchedule& schedule, T step, bool averages);

/// The plan whose error over `duration` is about `tolerance` (rad, of the axis). It is found from an estimate and a trial on
/// part of the duration, in which the step is halved until two results agree.
/// @param interval  the one between output times, which no step exceeds   @param counters  the trial's cost is added to them
/// @param watch  may end the trial early: the plan returned is then not checked
template <class T>
LongHorizonPlan<T> find_plan(const TiltedTop<T>& top, T duration, T interval, T tolerance, StepCounters& counters,
                             const Watch& watch = {});

/// Whether steps of this length may average over the nutation: whether they are longer than its period, and keep the tolerance
/// (rad) or an error that can be stated.
template <class T>
bool may_average(const TiltedTop<T>& top, T duration, T step, T tolerance);

/// The error of averaging over the nutation, over `duration` and beside the ripple (rad). On tops of many kinds it was measured
/// to be 0.03 to 0.15 of ripple x Earth's rate x time; a fifth is stated.
template <class T>
T averaging_error(const TiltedTop<T>& top, T duration);

/// The plan with the steps that another run has found.
template <class T>
LongHorizonPlan<T> plan_from(const TiltedTop<T>& top, const KickSteps& steps, const NaturalUnits& units);

/// Moves a top through time by a plan.   @tparam Top  a TiltedTop, or one whose kicks do more
template <class T, class Top = TiltedTop<T>>
class LongHorizonWalk {
 public:
  /// @param watch  may stop the walk between any two steps
  LongHorizonWalk(const Top& top, const LongHorizonPlan<T>& plan, StepCounters& counters, const Watch& watch)
      : top_(top), plan_(plan), counters_(counters), watch_(watch), x_(top.start()) {
    if (plan.averages) ripple(T(-1), x_);
  }

  /// Moves on by one interval.
  /// @param longest_time_between_looks  the longest time between two looks; 0: no looks
  /// @param look  called with the time since the interval's beginning and a state that is good enough for counting turns
  template <class Look>
  void advance(T interval, T longest_time_between_looks, Look&& look) {
    lay_out(interval);
    T position = T(0), looked = T(0), target = T(0);
    const auto move = [&]() {
      if (target == position) return;
      const typename TiltedTop<T>::Flow flow(top_, x_);
      ++counters_.evaluations;
      if (longest_time_between_looks > T(0))
        for (; looked + longest_time_between_looks < target; looked += longest_time_between_looks)
          if (looked + longest_time_between_looks > position)
            look(looked + longest_time_between_looks, flow.at(looked + longest_time_between_looks - position));
      x_ = flow.at(target - position);
      position = target;
    };
    const int kicks = plan_.schedule.kicks, parts = plan_.averages ? kSpread : 1;
    for (std::int64_t i = 0; i < steps_; ++i, backward_ = !backward_) {
      if (watch_.asks_to_stop()) return;
      for (int j = 0; j < kicks; ++j) {
        const bool backward = 2 * j + 1 == kicks ? backward_ : 2 * j + 1 > kicks;
        for (int part = 0; part < parts; ++part) {
          const int number = parts * j + (backward ? parts - 1 - part : part);
          const auto k = static_cast<std::size_t>(number);
          target = (T(i) + time_[k]) * step_;
          move();
          top_.kick(weight_[k] * step_, x_);
        }
      }
    }
    target = interval;
    move();
    counters_.accepted += steps_;
  }
  /// The state at the end of the last interval, with its ripple.
  TiltedTopState<T> state() const {
    TiltedTopState<T> x = x_;
    if (plan_.averages) ripple(T(1), x);
    return x;
  }

 private:
  static constexpr int kSpread = 5;

  void lay_out(T interval) {
    steps_ = static_cast<std::int64_t>(std::ceil(static_cast<double>(interval / plan_.step) * (1 - 1e-12)));
    if (steps_ < 1) steps_ = 1;
    step_ = interval / T(steps_);
    std::size_t k = 0;
    const KickSchedule& s = plan_.schedule;
    const T third = plan_.averages ? T(plan_.spacing) * plan_.period / T(3) / step_ : T(0);
    const int reach = plan_.averages ? kSpread / 2 : 0;
    for (int i = 0; i < s.kicks; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int j = -reach; j <= reach; ++j) {
        time_[k] = T(s.at[at]) + T(j) * third;
        weight_[k++] = T(s.weight[at]) * T(reach + 1 - std::abs(j)) / T((reach + 1) * (reach + 1));
      }
    }
  }

  /// Adds the ripple (sign = 1) or takes it off (sign = -1). It is the integral of the kick times s / period - sign(s)/2 over
  /// the times s from half a period before the present to half a period after it.
  void ripple(T sign, TiltedTopState<T>& x) const {
    T position = T(0);
    for (const int i : {-3, -2, -1, 1, 2, 3}) {
      const T target = plan_.period * T(i) / T(8);
      top_.flow(target - position, x);
      const T weight = plan_.ripple_weight[std::abs(i) - 1];
      top_.kick(sign * (i < 0 ? -weight : weight), x);
      position = target;
    }
    top_.flow(-position, x);
    counters_.evaluations += 7;
  }

  const Top& top_;
  const LongHorizonPlan<T>& plan_;
  StepCounters& counters_;
  Watch watch_;
  TiltedTopState<T> x_;
  std::int64_t steps_ = 1;
  T step_ = T(0);
  bool backward_ = false;  ///< whether the parts of a middle kick come in backward order
  std::array<T, static_cast<std::size_t>(kSpread*KickSchedule::kMost)> time_, weight_;  ///< of the parts, in units of a step
};

}  // namespace earthtop
