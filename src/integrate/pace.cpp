// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/integrate/pace.hpp"

#include <algorithm>
#include <cmath>

#include "earthtop/real.hpp"

namespace earthtop {
namespace {

/// The tolerance relative to the one at which `extrapolation` comes near the round-off of 113 bits, or 1 above it (as
/// measured). Below, fewer columns remain usable, because each one loses digits, and so the steps are shorter.
double near_round_off(double tolerance) { return std::min(1.0, tolerance / 1e-30); }

/// The phase of the fastest motion that a step covers (rad), as measured on a fast top. The steps of a method of order p grow
/// with the p-th root of its tolerance. The order of `extrapolation` depends on its tolerance.
double radians_a_step(Method method, double tolerance) {
  switch (method) {
    case Method::dopri5: return 0.25 * real::pow(tolerance / 1e-8, 1.0 / 5);
    case Method::rkf78: return 0.22 * real::pow(tolerance / 1e-14, 1.0 / 8);
    case Method::bulirsch_stoer: return 2 * real::pow(tolerance / 1e-12, 1.0 / 16);
    case Method::extrapolation: return 4 * real::pow(tolerance / 1e-12, 1.0 / 35) * real::pow(near_round_off(tolerance), 0.45);
    case Method::taylor: return 1.8;
    case Method::dop853: return 0.35 * real::pow(tolerance / 1e-12, 1.0 / 8);
    case Method::gauss: return std::min(2.0, 1.0 * real::pow(tolerance / 1e-12, 1.0 / 13));
    case Method::splitting: return std::min(2.0, 0.8 * real::pow(tolerance / 1e-12, 1.0 / 7));
    case Method::automatic:
    case Method::abm8:  // its step is given
    case Method::long_horizon:
    case Method::closed_form: break;
  }
  return 0.04;
}

/// The length and cost of a step that is bounded by nothing but stability, as measured on an overdamped pendulum. `phase` is
/// the damping rate times the length of the step: with more, errors would grow from step to step. `evaluations` counts the
/// right-hand sides for each step, including those of rejected steps.
struct StableStep {
  double phase, evaluations;
};
StableStep stable_step(Method method) {
  switch (method) {
    case Method::dopri5: return {2.5, 8};
    case Method::rkf78:
    case Method::automatic: return {3, 13};
    case Method::dop853: return {3.5, 13};
    case Method::bulirsch_stoer: return {3, 15};
    case Method::extrapolation: return {2, 8};
    case Method::gauss: return {1.2, 50};  // with longer steps its fixed-point iteration does not converge
    case Method::taylor:
    case Method::abm8:
    case Method::splitting:
    case Method::long_horizon:
    case Method::closed_form: break;
  }
  return {1, 13};
}

/// Right-hand sides for each step that is bounded by the tolerance, including those of rejected steps.
double evaluations_a_step(Method method, double tolerance) {
  switch (method) {
    case Method::dopri5: return 6;
    case Method::bulirsch_stoer: return 53;
    case Method::extrapolation: return 80 * real::pow(tolerance / 1e-12, -1.0 / 35) * real::pow(near_round_off(tolerance), 0.2);
    case Method::abm8: return 2;
    case Method::taylor: return 8 - 0.7 * real::log(tolerance);
    case Method::gauss: return 120;
    case Method::splitting: return 14;
    case Method::dop853: return 12;
    case Method::rkf78:
    case Method::automatic:
    case Method::long_horizon:
    case Method::closed_form: break;
  }
  return 13;
}

/// Whether rows come from the method's dense output. Any other method has to end a step at each row.
bool steps_past_rows(Method method) { return method == Method::taylor || method == Method::dop853; }

/// The largest angle between two looks of a watcher that counts turns (rad).
constexpr double kLook = 1.5;
/// Whether the method's steps are cut short so that the watcher can count turns.
bool is_watched(Method method) { return method == Method::extrapolation || method == Method::dop853; }

constexpr double kStepsAHalt = 20;

}  // namespace

double damping_steps(const Pace& pace, const IntegrationOptions& options) {
  return pace.damping / stable_step(options.method).phase;
}

Work estimated_work(const Pace& pace, const IntegrationOptions& options, bool reduced) {
  const Method method = options.method;
  const double tolerance = options.relative_tolerance, stops = pace.rows + pace.joints;
  const double an_evaluation = evaluations_a_step(method, tolerance);
  if (options.step_s) {
    const double steps = pace.duration_s / *options.step_s + stops;
    return {steps, steps * an_evaluation};
  }
  double turning = reduced ? pace.reduced_turning_rad : pace.turning_rad;
  // This method finds its fixed step at the start, and keeps it although friction may slow the motion down.
  if (method == Method::gauss && !reduced) turning = std::max(turning, pace.looks_rad) + pace.damping;
  double steps = turning / radians_a_step(method, tolerance) + pace.joints;
  double evaluations = steps * an_evaluation;
  if (!reduced) {
    const StableStep stable = stable_step(method);
    const double held = (pace.damping + pace.settled_rad) / stable.phase;
    steps += held + kStepsAHalt * pace.halts;
    evaluations += (held + kStepsAHalt * pace.halts) * stable.evaluations;
    // Steps that are cut short for the watcher need as few columns as stable steps do.
    const double cut = is_watched(method) ? pace.looks_rad / kLook - steps : 0;
    if (cut > 0) steps += cut, evaluations += cut * stable.evaluations;
  }
  // A step that ends at a row is shorter, and `extrapolation` needs fewer columns for it than for a long one.
  const double a_row = steps_past_rows(method) ? 1 : method == Method::extrapolation ? 40 : 13;
  if (!steps_past_rows(method)) steps = std::max(steps, pace.rows);
  return {steps, evaluations + pace.rows * a_row};
}

Work variational_work(const Pace& pace, double time_s, double relative_tolerance) {
  IntegrationOptions options;
  options.method = Method::rkf78;
  options.relative_tolerance = relative_tolerance;
  const double part = pace.known() ? time_s / pace.duration_s : 0;
  const double steps = part * (pace.turning_rad / radians_a_step(options.method, relative_tolerance) +
                               (pace.damping + pace.settled_rad) / stable_step(options.method).phase) +
                       kStepsAHalt * pace.halts;
  return {steps, steps * evaluations_a_step(options.method, relative_tolerance)};
}

WorkLimit limit_of(const Work& estimate, double least_evaluations) {
  constexpr double kTimes = 10, kEvaluationsAStep = 10;
  const auto limit = [](double value, double least) {
    return static_cast<std::int64_t>(std::clamp(kTimes * value, least, static_cast<double>(WorkLimit::kNone)));
  };
  return {limit(estimate.steps, least_evaluations / kEvaluationsAStep), limit(estimate.evaluations, least_evaluations)};
}

}  // namespace earthtop
