// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/integrate/pace.hpp"

#include <algorithm>
#include <cmath>

#include "earthtop/real.hpp"

namespace earthtop {
namespace {

/// The tolerance relative to the one at which `extrapolation` comes near the round-off of 113 bits, or 1 above it (as
/// measured). Below, fewer columns remain usable, because each one costs digits, and so the steps are shorter.
double near_round_off(double tolerance) { return std::min(1.0, tolerance / 1e-30); }

/// The phase of the fastest motion that a step covers (rad), as measured on a fast top. The steps of a method of order p grow
/// with the p-th root of its tolerance.
double radians_a_step(const MethodCost& cost, double tolerance) {
  const double radians = cost.radians * real::pow(tolerance / cost.at, cost.order_inverse);
  return std::min(cost.most_radians, radians * real::pow(near_round_off(tolerance), cost.near_round_off));
}

/// Right-hand sides for each step that is bounded by the tolerance, including those of rejected steps.
double evaluations_a_step(const MethodCost& cost, double tolerance) {
  const double logarithmic = cost.evaluations_per_log != 0 ? cost.evaluations_per_log * real::log(tolerance) : 0;
  return (cost.evaluations + logarithmic) * real::pow(tolerance / 1e-12, cost.evaluations_power) *
         real::pow(near_round_off(tolerance), cost.evaluations_near_round_off);
}

/// The largest angle between two looks of a watcher that counts turns (rad).
constexpr double kLook = 1.5;

constexpr double kStepsAHalt = 20;

Work times(const Work& work, const WorkRatio& ratio) {
  return {work.steps * ratio.steps, work.evaluations * ratio.evaluations};
}

}  // namespace

double damping_steps(const Pace& pace, const IntegrationOptions& options) {
  return pace.damping / row_of(options.method).cost.stable_phase;
}

Work estimated_work(const Pace& pace, const IntegrationOptions& options, bool reduced) {
  const MethodCost& cost = row_of(options.method).cost;
  const double tolerance = options.relative_tolerance, stops = pace.rows + pace.joints;
  const double an_evaluation = evaluations_a_step(cost, tolerance);
  if (options.step_s) {
    const double steps = pace.duration_s / *options.step_s + stops;
    return {steps, steps * an_evaluation};
  }
  double turning = reduced ? pace.reduced_turning_rad : pace.turning_rad;
  // Such a method finds its fixed step at the start, and keeps it although friction may slow the motion down.
  if (cost.tries_its_step && !reduced) turning = std::max(turning, pace.watched_angle_rad) + pace.damping;
  double steps = turning / radians_a_step(cost, tolerance) + pace.joints;
  double evaluations = steps * an_evaluation;
  if (reduced) {
    const double held = pace.reduced_damping / cost.stable_phase;
    steps += held;
    evaluations += held * an_evaluation;
  } else {
    const double held = (pace.damping + pace.undamped_rest_rad) / cost.stable_phase;
    steps += held + kStepsAHalt * pace.halts;
    evaluations += (held + kStepsAHalt * pace.halts) * cost.stable_evaluations;
    // Steps that are cut short for the watcher need as few columns as stable steps do.
    const double cut = cost.is_watched ? pace.watched_angle_rad / kLook - steps : 0;
    if (cut > 0) steps += cut, evaluations += cut * cost.stable_evaluations;
  }
  const WorkRatio& seen = pace.seen[static_cast<std::size_t>(options.method)];
  if (ends_steps_at_rows(options.method))
    return times({std::max(steps, pace.rows), evaluations + pace.rows * cost.evaluations_a_row}, seen);
  // A look between the steps of a method without dense output is a step of its own.
  const double a_look = cost.evaluations_a_row == 1 ? 1 : an_evaluation;
  const Work motion = times({steps, evaluations}, seen);
  return {motion.steps, motion.evaluations + (pace.rows + pace.judgement_looks) * a_look};
}

Work variational_work(const Pace& pace, double time_s, double relative_tolerance) {
  const MethodCost& cost = row_of(Method::rkf78).cost;
  const double part = pace.known() ? time_s / pace.duration_s : 0;
  const double steps = part * (pace.turning_rad / radians_a_step(cost, relative_tolerance) +
                               (pace.damping + pace.undamped_rest_rad) / cost.stable_phase) +
                       kStepsAHalt * pace.halts;
  return times({steps, steps * evaluations_a_step(cost, relative_tolerance)}, pace.variations_seen);
}

WorkLimit work_limit_for(const Work& estimate, double least_evaluations) {
  constexpr double kTimes = 10, kEvaluationsAStep = 10;
  const auto limit = [](double value, double least) {
    return static_cast<std::int64_t>(std::clamp(kTimes * value, least, static_cast<double>(WorkLimit::kNone)));
  };
  return {limit(estimate.steps, least_evaluations / kEvaluationsAStep), limit(estimate.evaluations, least_evaluations)};
}

}  // namespace earthtop
