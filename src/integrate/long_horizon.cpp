// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/long_horizon.hpp"

#include <algorithm>
#include <limits>

namespace earthtop {
namespace {

/// The logarithm of (x h)^2s over the relative error with which s Gauss nodes integrate exp(i x t) over a step h.
double gauss_gain(int s) { return real::log(2 * s + 1.0) + 3 * real::lgamma(2 * s + 1.0) - 4 * real::lgamma(s + 1.0); }
/// The largest phase x h over a step h for which integration of exp(i x t) with s Gauss nodes keeps this relative error.
double gauss_phase(int s, double error) { return real::exp((real::log(error) + gauss_gain(s)) / (2 * s)); }
constexpr std::array kGaussKicks{1, 2, 3, 4, 6, 8};

/// The smallest error that a run in double can resolve (rad).
constexpr double kLeastError = 1e-12;
/// The same for long steps (rad): the parts of a kick do not commute, and the turn about the axis has its round-off.
constexpr double kLeastAveraged = 1e-11;
/// The factor by which halving the step reduces the error: for the lowest order that there is, and for one worth halving for.
constexpr double kLeastGain = 4, kGain = 16;
/// The round-off that a flow adds to the distance of two trials (rad). Shorter steps only make more of it.
constexpr double kRoundOffAFlow = 2e-17;
/// A difference between two trials that may be nothing but round-off (rad).
constexpr double kLeastSquare = 1e-10;

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
  /// How far the attitudes of two trials come apart (rad).
  T distance(const Trial& other) const {
    T largest = T(0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(looks_); ++i) {
      const Quaternion<T> e = seen_[i].q_LF.conjugate() * other.seen_[i].q_LF;
      largest = std::max(largest, T(T(2) * real::atan2(norm(e.v), real::abs(e.w))));
    }
    return largest;
  }

 private:
  int looks_;
  std::array<typename TiltedTop<T>::Seen, static_cast<std::size_t>(Looks::kMost)> seen_;
};

/// The tolerance asked for, or the least one that makes sense over this horizon: a part of the error that averaging leaves, and
/// that is stated, whatever the steps.
template <class T>
T reachable(const TiltedTop<T>& top, T duration, T asked, Averaging averaging) {
  if (averaging == Averaging::none) return std::max(asked, T(kLeastError));
  return std::max({asked, T(kLeastAveraged), averaging_error(top, duration, averaging) / T(3)});
}

/// The beginning of the search for a plan.
template <class T>
struct Guess {
  LongHorizonPlan<T> plan;
  T tolerance;       ///< of the axis (rad)
  bool needs_trial;  ///< false where there is no perturbation, so that no step has an error
  T part;            ///< the part of the duration that a trial covers
  Looks looks;
};

template <class T>
Guess<T> guess_plan(const TiltedTop<T>& top, T duration, T asked) {
  const Averaging averaging = may_average(top, duration, duration, std::max(asked, T(kLeastError)));
  const bool averages = averaging != Averaging::none;
  const T tolerance = reachable(top, duration, asked, averaging);
  const double rate = static_cast<double>(averages ? top.precession_rate() : top.fast_rate());
  const double size = static_cast<double>(top.kick_rate() * std::min(duration, T(4 / rate)));
  // About a tenth of the perturbation is taken to oscillate, at twice this rate. A trial corrects this estimate.
  const double error = size > 0 ? std::min(static_cast<double>(tolerance) * 10 / size, 0.01) : 0.01;
  double least_work = std::numeric_limits<double>::infinity();
  KickSchedule schedule;
  T step = duration;
  for (const int s : kGaussKicks) {
    const double longest = gauss_phase(s, error) / (2 * rate), whole = static_cast<double>(duration);
    const double steps = std::max(1.0, std::ceil(whole / longest));
    if (const double work = s * steps; work < least_work) {
      least_work = work;
      schedule = kick_schedules::gauss(s);
      step = T(whole / steps);
    }
  }
  // The trial covers the whole duration where that costs little, because in an unstable scene errors grow.
  constexpr double kCheapSteps = 400;
  const T part = duration < T(kCheapSteps) * step
                     ? duration
                     : std::min(duration, std::max({T(16) * step, T(12 / rate), duration / T(32)}));
  const Looks looks = looks_in(static_cast<double>(part), static_cast<double>(step));
  return {make_plan(top, schedule, step, averaging), tolerance, size > 0, part, looks};
}

}  // namespace

template <class T>
KickFilter<T> make_filter(const TiltedTop<T>& top, Averaging averaging, bool wider) {
  const T period = top.nutation_period();
  switch (averaging) {
    case Averaging::none: break;
    case Averaging::coarse: return kick_filters::coarse(period, wider ? 2 : 1);
    case Averaging::fine:
      return kick_filters::fine(period, T(top.precession_rate() * period / (T(2) * real::pi<T>())), wider ? 2 : 1);
  }
  return {};
}

template <class T>
LongHorizonPlan<T> make_plan(const TiltedTop<T>& top, const KickSchedule& schedule, T step, Averaging averaging) {
  return {schedule, step, averaging, make_filter(top, averaging, false)};
}

template <class T>
LongHorizonPlan<T> plan_from(const TiltedTop<T>& top, const KickSteps& steps, const NaturalUnits& units) {
  const KickSchedule schedule = steps.kicks > 0 ? kick_schedules::gauss(steps.kicks) : kick_schedules::aba864();
  const bool is_periodic = real::isfinite(top.nutation_period());
  return make_plan(top, schedule, units.time_from_s(steps.step_s), is_periodic ? steps.averaging : Averaging::none);
}

template <class T>
std::vector<ShorterStep<T>> shorter_steps(const TiltedTop<T>& top, const LongHorizonPlan<T>& plan) {
  std::vector<ShorterStep<T>> steps;
  const double rate = static_cast<double>(plan.averages() ? top.precession_rate() : top.fast_rate());
  const double phase = 2 * rate * static_cast<double>(plan.step);
  const int kicks = plan.schedule.kicks;
  if (!is_composed(plan) && phase > 0) {
    const double error = 2 * kicks * real::log(phase) - gauss_gain(kicks);  // logarithm
    for (const int s : kGaussKicks)
      if (s < kicks) steps.push_back({T(real::exp((error + gauss_gain(s)) / (2 * s)) / (2 * rate)), kick_schedules::gauss(s)});
  }
  steps.push_back({plan.step, plan.schedule});
  return steps;
}

template <class T>
T averaging_error(const TiltedTop<T>& top, T duration, Averaging averaging) {
  const T ripple = top.kick_rate() * top.nutation_period() / (T(2) * real::pi<T>());
  const T second_order = ripple * top.earth_rate() * duration / T(5);
  switch (averaging) {
    case Averaging::none: break;
    case Averaging::coarse: return second_order;
    case Averaging::fine: return second_order / T(10);
  }
  return T(0);
}

template <class T>
Averaging may_average(const TiltedTop<T>& top, T duration, T step, T tolerance) {
  const T period = top.nutation_period();
  // A few periods are better resolved by steps, and steps shorter than the period resolve it anyway.
  if (!(T(32) * period < duration) || !(period < step)) return Averaging::none;
  const T nutation = T(2) * real::pi<T>() / period, precession = top.precession_rate(), ratio = precession / nutation;
  if (!(ratio < T(0.02))) return Averaging::none;
  const T ripple = top.kick_rate() / nutation;
  // The error left by second-order effects is accepted, and stated, where resolving the nutation would leave as much round-off
  // or would take minutes.
  constexpr double kAffordablePhase = 1e6, kRoundOff = 2.5e-17;  // rad; round-off measured in rad per rad of nutation
  const T phase = nutation * duration;
  if (ripple * ratio * (T(1) + ratio * precession * duration) < tolerance &&
      (averaging_error(top, duration, Averaging::coarse) < tolerance + T(kRoundOff) * phase || phase > T(kAffordablePhase)))
    return Averaging::coarse;
  // The fine filter lets the fifth harmonic of the nutation through. It is about this large, as the harmonics fall off with the
  // amplitude of the nutation; half the limit to the frame's rate over the frequency is at least that amplitude.
  const T amplitude = top.frame_rate() / (T(2) * nutation), square = amplitude * amplitude;
  const T fifth = top.kick_rate() / precession * square * square;
  if (!(fifth < tolerance)) return Averaging::none;
  // The error of second-order effects is accepted where it is below what can be shown of a method that follows the nutation: the
  // distance of two such integrations grows with the square of the phase, as measured.
  constexpr double kFollowed = 1e-20;  // rad per square of a rad of nutation
  const T least = averaging_error(top, duration, Averaging::fine) / T(3);
  return least < std::max(tolerance, T(kLeastAveraged)) + T(kFollowed) * phase * phase ? Averaging::fine : Averaging::none;
}

template <class T>
LongHorizonPlan<T> find_plan(const TiltedTop<T>& top, T duration, T asked, StepCounters& counters, const Watch& watch) {
  const Guess<T> guess = guess_plan(top, duration, asked);
  LongHorizonPlan<T> plan = guess.plan;
  if (!guess.needs_trial) return plan;
  const T tolerance = guess.tolerance, part = guess.part, growth = duration / part;
  const bool averages = plan.averages();
  const Looks& looks = guess.looks;
  T step = plan.step;
  plan.step = step = part / T(looks.steps * looks.count);
  const std::int64_t begun = counters.evaluations;
  Trial<T> coarse(top, plan, part, looks.count, counters, watch);
  T before = std::numeric_limits<T>::infinity();
  int stalls = 0;
  // The run's second integration sees the error of a plan whose search takes too long.
  constexpr double kTimes = 10, kLeast = 4e5;
  const double most = std::max(kLeast, kTimes * walking_work(top, plan, duration, 0).evaluations);
  for (int halvings = 0; halvings < 16; ++halvings) {
    if (watch.asks_to_stop() || static_cast<double>(counters.evaluations - begun) > most) return plan;
    LongHorizonPlan<T> finer = plan;
    finer.step /= T(2);
    const Trial<T> fine(top, finer, part, looks.count, counters, watch);
    const T distance = coarse.distance(fine), round_off = T(kRoundOffAFlow) * static_cast<T>(counters.evaluations - begun);
    if (distance * growth < tolerance || distance < round_off) return plan;
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

template <class T>
LongHorizonWork walking_work(const TiltedTop<T>& top, const LongHorizonPlan<T>& plan, T duration, double looks) {
  const auto steps = static_cast<double>(steps_in(plan, duration));
  // Each look takes a step aside, from the last look within the same step.
  const T aside = std::min(plan.step / T(2), duration / T(std::max(looks, 1.0)));
  const std::vector<ShorterStep<T>> shorter = shorter_steps(top, plan);
  const auto found = std::ranges::find_if(shorter, [&](const ShorterStep<T>& s) { return aside <= s.longest; });
  const int kicks_aside = found == shorter.end() ? plan.schedule.kicks : found->schedule.kicks;
  LongHorizonWork work;
  work.averaging = plan.averaging;
  work.steps = steps + looks;
  work.evaluations =
      (steps * plan.schedule.kicks + looks * kicks_aside) * plan.filter.flows() + looks * (1 + plan.filter.ripple_flows());
  return work;
}

template <class T>
LongHorizonWork expected_work(const TiltedTop<T>& top, T duration, T tolerance, double looks, double share) {
  const Guess<T> guess = guess_plan(top, duration, tolerance);
  LongHorizonPlan<T> plan = guess.plan;
  LongHorizonWork search;
  if (guess.needs_trial) {
    // A trial in steps of the length guessed, and one in half of it. Further ones follow if these disagree.
    plan.step = guess.part / T(guess.looks.steps * guess.looks.count);
    search = walking_work(top, plan, guess.part, 0);
    LongHorizonPlan<T> half = plan;
    half.step /= T(2);
    const LongHorizonWork finer = walking_work(top, half, guess.part, 0);
    search.steps += finer.steps, search.evaluations += finer.evaluations;
  }
  plan.step *= T(share);
  LongHorizonWork work = walking_work(top, plan, duration, looks);
  work.search_steps = search.steps, work.search_evaluations = search.evaluations;
  return work;
}

template LongHorizonPlan<double> make_plan(const TiltedTop<double>&, const KickSchedule&, double, Averaging);
template std::vector<ShorterStep<double>> shorter_steps(const TiltedTop<double>&, const LongHorizonPlan<double>&);
template KickFilter<double> make_filter(const TiltedTop<double>&, Averaging, bool);
template LongHorizonPlan<double> find_plan(const TiltedTop<double>&, double, double, StepCounters&, const Watch&);
template LongHorizonPlan<double> plan_from(const TiltedTop<double>&, const KickSteps&, const NaturalUnits&);
template LongHorizonWork walking_work(const TiltedTop<double>&, const LongHorizonPlan<double>&, double, double);
template LongHorizonWork expected_work(const TiltedTop<double>&, double, double, double, double);
template double averaging_error(const TiltedTop<double>&, double, Averaging);
template Averaging may_average(const TiltedTop<double>&, double, double, double);

}  // namespace earthtop
