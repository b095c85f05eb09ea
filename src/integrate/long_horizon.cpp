// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/long_horizon.hpp"

#include <algorithm>
#include <limits>

namespace earthtop {
namespace {

/// The largest phase x h over a step h for which integration of exp(i x t) with s Gauss nodes keeps this relative error.
double gauss_phase(int s, double error) {
  const double log = real::log(error) - 4 * real::lgamma(s + 1.0) + real::log(2 * s + 1.0) + 3 * real::lgamma(2 * s + 1.0);
  return real::exp(log / (2 * s));
}

/// The smallest error that a run in double can resolve (rad).
constexpr double kLeastError = 1e-12;
/// The same for long steps (rad): the parts of a kick do not commute, and the turn about the axis has its round-off.
constexpr double kLeastAveraged = 1e-11;
/// The factor by which halving the step reduces the error: for the lowest order that there is, and for one worth halving for.
constexpr double kLeastGain = 4, kGain = 16;
/// A difference between two trials that may be nothing but round-off (rad).
constexpr double kLeastSquare = 1e-10;

template <class T>
T angle_between(const Vec3<T>& a, const Vec3<T>& b) {
  return real::atan2(norm(Vec3<T>(a.cross(b))), a.dot(b));
}

/// How many times a trial looks at the top, and the number of steps between two looks. That number is whole, so that halving
/// the plan's step really halves the steps taken.
struct Looks {
  static constexpr int kMost = 8;
  int count = 1;
  double steps = 1;
};
/// The looks for the smallest number of steps, none longer than `step`, that some number of looks divides.
Looks looks_in(double part, double step) {
  const double steps = std::max(2.0, std::ceil(part / step * (1 - 1e-12)));
  if (steps <= Looks::kMost) return {static_cast<int>(steps), 1};
  Looks best{Looks::kMost, std::ceil(steps / Looks::kMost)};
  for (int count = Looks::kMost - 1; 2 * count >= Looks::kMost; --count)
    if (const double each = std::ceil(steps / count); each * count < best.steps * best.count) best = {count, each};
  return best;
}

/// The motion by one plan over the first part of a run, to be compared with that by another plan.
template <class T>
class Trial {
 public:
  Trial(const TiltedTop<T>& top, const LongHorizonPlan<T>& plan, T part, int looks, StepCounters& counters, const Watch& watch)
      : looks_(looks) {
    LongHorizonWalk<T> walk(top, plan, counters, watch);
    for (int i = 0; i < looks; ++i) {
      walk.advance(part / T(looks), T(0), [](T, const TiltedTopState<T>&) {});
      seen_[static_cast<std::size_t>(i)] = top.seen(walk.state(), part * T(i + 1) / T(looks));
    }
  }
  /// How far two trials come apart (rad): the axis, or a thirtieth of the attitude's turn where that is more.
  T distance(const Trial& other) const {
    constexpr double kTurnShare = 1.0 / 30;
    T largest = T(0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(looks_); ++i) {
      const Mat3<T> R = rotation_matrix(seen_[i].q_LF), S = rotation_matrix(other.seen_[i].q_LF);
      const Quaternion<T> e = seen_[i].q_LF.conjugate() * other.seen_[i].q_LF;
      const T turn = T(2) * real::atan2(norm(e.v), real::abs(e.w));
      largest = std::max({largest, angle_between<T>(R.col(2), S.col(2)), T(kTurnShare) * turn});
    }
    return largest;
  }

 private:
  int looks_;
  std::array<typename TiltedTop<T>::Seen, static_cast<std::size_t>(Looks::kMost)> seen_;
};

}  // namespace

template <class T>
LongHorizonPlan<T> make_plan(const TiltedTop<T>& top, const KickSchedule& schedule, T step, bool averages) {
  LongHorizonPlan<T> plan;
  plan.schedule = schedule;
  plan.step = step;
  plan.averages = averages;
  if (!averages) return plan;
  plan.period = top.nutation_period();
  // The weights integrate the first three harmonics of the nutation exactly: they are a discrete sine transform of 1/k.
  for (int i = 1; i <= 3; ++i) {
    T sum = T(0);
    for (int k = 1; k <= 3; ++k) sum += real::sin(T(k * i) * real::pi<T>() / T(4)) / T(k);
    plan.ripple_weight[i - 1] = -plan.period * sum / (T(8) * real::pi<T>());
  }
  return plan;
}

template <class T>
LongHorizonPlan<T> plan_from(const TiltedTop<T>& top, const KickSteps& steps, const NaturalUnits& units) {
  const KickSchedule schedule = steps.kicks > 0 ? kick_schedules::gauss(steps.kicks) : kick_schedules::aba864();
  const bool averages = steps.averages && real::isfinite(top.nutation_period());
  return make_plan(top, schedule, units.time_from_s(steps.step_s), averages);
}

template <class T>
T averaging_error(const TiltedTop<T>& top, T duration) {
  const T ripple = top.kick_rate() * top.nutation_period() / (T(2) * real::pi<T>());
  return ripple * top.earth_rate() * duration / T(5);
}

template <class T>
bool may_average(const TiltedTop<T>& top, T duration, T step, T tolerance) {
  const T period = top.nutation_period();
  // A few periods are better resolved by steps, and steps shorter than the period resolve it anyway.
  if (!(T(32) * period < duration) || !(period < step)) return false;
  const T nutation = T(2) * real::pi<T>() / period, precession = top.precession_rate(), ratio = precession / nutation;
  if (!(ratio < T(0.02))) return false;
  const T ripple = top.kick_rate() / nutation;
  if (!(ripple * ratio * (T(1) + ratio * precession * duration) < tolerance)) return false;
  // An averaging error above the tolerance is accepted, and stated, where resolving the nutation would leave as much round-off
  // or would take minutes.
  constexpr double kAffordablePhase = 1e6, kRoundOff = 2.5e-17;  // rad; round-off measured in rad per rad of nutation
  const T phase = nutation * duration;
  return averaging_error(top, duration) < tolerance + T(kRoundOff) * phase || phase > T(kAffordablePhase);
}

template <class T>
LongHorizonPlan<T> find_plan(const TiltedTop<T>& top, T duration, T interval, T asked, StepCounters& counters,
                             const Watch& watch) {
  const bool averages = may_average(top, duration, interval, std::max(asked, T(kLeastError)));
  const T tolerance = std::max(asked, T(averages ? kLeastAveraged : kLeastError));
  const double rate = static_cast<double>(averages ? top.precession_rate() : top.fast_rate());
  const double size = static_cast<double>(top.kick_rate() * std::min(duration, T(4 / rate)));
  // About a tenth of the perturbation is taken to oscillate, at twice this rate. The trial below corrects this estimate.
  const double error = size > 0 ? std::min(static_cast<double>(tolerance) * 10 / size, 0.01) : 0.01;
  double least_work = std::numeric_limits<double>::infinity();
  KickSchedule schedule;
  T step = interval;
  for (const int s : {1, 2, 3, 4, 6, 8}) {
    const double longest = gauss_phase(s, error) / (2 * rate), whole = static_cast<double>(interval);
    const double steps = std::max(1.0, std::ceil(whole / longest));
    if (const double work = s * steps; work < least_work) {
      least_work = work;
      schedule = kick_schedules::gauss(s);
      step = T(whole / steps);
    }
  }
  LongHorizonPlan<T> plan = make_plan(top, schedule, step, averages);
  if (!(size > 0)) return plan;

  // The trial covers the whole duration where that costs little, because in an unstable scene errors grow.
  constexpr double kCheapSteps = 400;
  const T part = duration < T(kCheapSteps) * step
                     ? duration
                     : std::min(duration, std::max({T(16) * step, T(12 / rate), duration / T(32)}));
  const T growth = duration / part;
  const Looks looks = looks_in(static_cast<double>(part), static_cast<double>(step));
  plan.step = step = part / T(looks.steps * looks.count);
  Trial<T> coarse(top, plan, part, looks.count, counters, watch);
  T before = std::numeric_limits<T>::infinity();
  int stalls = 0;
  for (int halvings = 0; halvings < 16; ++halvings) {
    if (watch.asks_to_stop()) return plan;
    LongHorizonPlan<T> finer = plan;
    finer.step /= T(2);
    const Trial<T> fine(top, finer, part, looks.count, counters, watch);
    const T distance = coarse.distance(fine);
    if (distance * growth < tolerance) return plan;
    if (distance * growth < T(kLeastGain) * tolerance) return finer;
    const bool composed = is_composed(plan);
    if (halvings > 0 && !(distance < before / (composed ? T(1.5) : T(kGain)))) {
      // Halving the step hardly helped. Either round-off is reached, or the error is of second order in a large perturbation,
      // for which there is another schedule. With that one, halving may fail once where the leading error changes its order and
      // sign. The error that averaging steps leave falls again with shorter steps.
      if (distance < T(kLeastSquare) || stalls > 1) return averages ? finer : plan;
      if (composed) {
        ++stalls;
      } else {
        plan.schedule = kick_schedules::aba864();
        plan.step = step;
        coarse = Trial<T>(top, plan, part, looks.count, counters, watch);
        before = std::numeric_limits<T>::infinity();
        continue;
      }
    }
    before = distance;
    plan = finer;
    coarse = fine;
  }
  return plan;
}

template LongHorizonPlan<double> make_plan(const TiltedTop<double>&, const KickSchedule&, double, bool);
template LongHorizonPlan<double> find_plan(const TiltedTop<double>&, double, double, double, StepCounters&, const Watch&);
template LongHorizonPlan<double> plan_from(const TiltedTop<double>&, const KickSteps&, const NaturalUnits&);
template double averaging_error(const TiltedTop<double>&, double);
template bool may_average(const TiltedTop<double>&, double, double, double);

}  // namespace earthtop
