// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/run.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <utility>

#include "earthtop/arithmetic.hpp"
#include "run/assemble.hpp"
#include "run/run_work.hpp"
#include "scenario/problem.hpp"
#include "scenario/second_integration.hpp"

namespace earthtop {
namespace {

template <class T>
DriftTrajectory<T> integrate_timed(const DriftProblem<T>& problem, const IntegrationOptions& options, Precision precision,
                                   const Watch& watch, IntegrationReport& report) {
  const auto start = std::chrono::steady_clock::now();
  DriftTrajectory<T> trajectory = integrate_drift(problem, options, watch);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  describe(problem, options, trajectory, precision, report);
  return trajectory;
}

/// The methods that know beforehand how many steps they take are limited in those. Whether long_horizon steps over the nutation
/// it finds by trial; in a short run it may follow it.
IntegrationOptions within_estimate(const Scenario& scenario, IntegrationOptions options) {
  constexpr double kShortRun = 1e6;  // steps
  const bool long_horizon = options.method == Method::long_horizon;
  if (!options.stops_beyond_estimate || !(long_horizon || options.method == Method::closed_form)) return options;
  Work work = estimated_work(scenario, options);
  if (long_horizon) work.steps = std::max(work.steps, kShortRun);
  options.step_limit = std::min(options.step_limit, limit_of(work).steps);
  return options;
}

template <class T>
RunResult run_in(const Scenario& scenario, const RunOptions& run_options) {
  auto problem = make_problem<T>(scenario);
  const Precision precision = scenario.precision;
  const MethodChoice choice = method_choice(scenario);

  TwoIntegrations<T> made;
  made.options = within_estimate(scenario, choice.options);
  const ModelForm form = form_taken(problem, made.options);
  made.other_options = second_options(scenario, made.options, form);
  const Watch& watch = run_options.watch;
  const RunWork work = watch.is_told() ? work_of_run(scenario, made.options, made.other_options, form) : RunWork();
  Parts parts(watch, work.all());

  made.first = integrate_timed(problem, made.options, precision, parts.next(work.solution, "solution"), made.solution);
  made.solution.reason = choice.reason;
  make_second(problem, made.first);
  if (made.other_options.method == Method::long_horizon) made.other_options.kick_steps = made.first.kick_steps;
  made.other_options = within_estimate(scenario, made.other_options);
  made.second =
      integrate_timed(problem, made.other_options, precision, parts.next(work.bound, "error bound"), made.certificate);
  return assemble_result(scenario, made, work, parts, run_options.partial);
}

RunResult run_once(const Scenario& scenario, const RunOptions& options) {
  require_affordable(scenario);
  switch (scenario.precision) {
    case Precision::bits53: break;
    case Precision::bits64: return run_in<long double>(scenario, options);
    case Precision::bits113: return run_in<float128>(scenario, options);
  }
  return run_in<double>(scenario, options);
}

/// Where an error is asked for, and method and tolerance are free, from the loosest tolerance that may reach it to finer ones.
/// @param left_out_rad  what the effects left out may cost of it
RunResult run_to_accuracy(Scenario scenario, double left_out_rad, const RunOptions& options) {
  if (!scenario.accuracy_rad) return run_once(scenario, options);
  constexpr double kLoosest = 1e-6, kFiner = 1e-3;
  constexpr int kAttempts = 4;
  AccuracyReport accuracy{*scenario.accuracy_rad, 0, 0};
  double& tolerance = scenario.numerics.relative_tolerance;
  const double least = least_tolerance(scenario.precision);
  const bool free = scenario.numerics.method == Method::automatic && tolerance == default_tolerance(scenario.precision);
  // A tenth of the error asked for: steps are many, and the second run's error counts as the first one's.
  if (free) tolerance = std::clamp(accuracy.asked_rad / 10, least, kLoosest);
  // As a rule the first attempt is enough: what comes after it has what is left of the progress.
  constexpr double kShare = 0.7;
  RunOptions attempt = options;
  for (double done = 0;;) {
    const double next = free ? done + kShare * (1 - done) : 1;
    attempt.watch = options.watch.part(std::exchange(done, next), next);
    RunResult result = run_once(scenario, attempt);
    ++accuracy.attempts;
    accuracy.reached_rad = has_drift(result) ? result.drift.axis_bound_rad + left_out_rad : HUGE_VAL;
    const bool may_be_finer = free && tolerance > least && accuracy.attempts < kAttempts;
    if (accuracy.reached() || !may_be_finer || result.status != RunStatus::completed) {
      result.accuracy = accuracy;
      return result;
    }
    // Where disturbances grow, only the finest tolerance may do.
    const bool grows = result.verdict.verdict != Verdict::reliable && result.verdict.verdict != Verdict::noise_floor;
    const double finer = grows ? 0 : std::max(kFiner, 0.1 * accuracy.asked_rad / accuracy.reached_rad);
    tolerance = std::max(least, tolerance * finer);
  }
}

}  // namespace

double estimated_run_seconds(const Scenario& scenario) {
  const IntegrationOptions first = method_choice(scenario).options;
  const ModelForm form = form_taken(make_problem<double>(scenario), first);
  const double choice = scenario.effects.automatic ? selection_work(scenario) : 0;
  return choice + work_of_run(scenario, first, second_options(scenario, first, form), form).all();
}

RunResult run(const Scenario& scenario, const RunOptions& options) {
  require_ieee_arithmetic();
  Scenario modelled = scenario;
  std::optional<Selection> selection;
  RunOptions after = options;
  if (scenario.effects.automatic) {
    const double choice = options.watch.is_told() ? selection_work(scenario) : 0;
    const double share = choice > 0 ? choice / estimated_run_seconds(scenario) : 0;
    selection = select_effects(modelled, options.watch.part(0, share, "choice of effects"));
    after.watch = options.watch.part(share, 1);
  }
  if (const auto reason = method_refusal(modelled.numerics.method, modelled)) throw ScenarioError("/numerics/method", *reason);
  RunResult result = run_to_accuracy(modelled, selection ? selection->left_out_drift_rad : 0, after);
  result.modelled = std::move(result.scenario);
  result.scenario = scenario;
  result.selection = std::move(selection);
  return result;
}

}  // namespace earthtop
