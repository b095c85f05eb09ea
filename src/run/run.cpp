// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <system_error>
#include <utility>

#include "earthtop/arithmetic.hpp"
#include "earthtop/error.hpp"
#include "run/assemble.hpp"
#include "run/later_rows.hpp"
#include "run/verdict.hpp"
#include "scene/second_integration.hpp"

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

/// Limits the steps of a method with equations of its own to the estimate, because such a method's number of steps is known in
/// advance. long_horizon decides by trial whether to step over the nutation, and in a short run it may follow the nutation.
IntegrationOptions within_estimate(const Scene& scene, IntegrationOptions options) {
  constexpr double kShortRun = 1e5;  // steps
  if (!options.stops_beyond_estimate || row_of(options.method).equations != MethodEquations::own) return options;
  Work work = scene.cost(options).work;
  if (!is_exact(options.method)) work.steps = std::max(work.steps, kShortRun);
  options.step_limit = std::min(options.step_limit, work_limit_for(work).steps);
  return options;
}

/// The second integration on a thread of its own, alongside the first one.
template <class T>
class SecondBeside {
 public:
  /// Starts it, unless the options have it wait for the first one, or no thread is available.
  SecondBeside(const Scene& scene, const DriftProblem<T>& rows, const Looks& looks, const IntegrationOptions& first,
               const IntegrationOptions& second, const RunOptions& run) {
    // long_horizon checks itself with the steps that the first integration has found.
    if (run.jobs < 2 || (first.method == second.method && first.method == Method::long_horizon)) return;
    DriftProblem<T> problem = rows;
    make_second(problem, looks, looks.size(), first);
    const Watch watch = run.watch.with_progress(nullptr);  // only one thread may report
    try {
      made_ = std::async(std::launch::async, [problem = std::move(problem), second, watch, &scene] {
        Made made;
        made.trajectory = integrate_timed(problem, second, scene.scenario().precision, watch, made.report);
        return made;
      });
    } catch (const std::system_error&) {  // then one integration follows the other
    }
  }
  bool runs() const { return made_.valid(); }
  /// Waits for it. @returns whether it was made, for all looks of the first one
  bool take(const DriftTrajectory<T>& first, std::size_t looks, DriftTrajectory<T>& second, IntegrationReport& report) {
    if (!made_.valid()) return false;
    Made made = made_.get();
    if (first.samples.size() < looks) return false;  // it went on to another end
    second = std::move(made.trajectory);
    report = std::move(made.report);
    return true;
  }

 private:
  struct Made {
    DriftTrajectory<T> trajectory;
    IntegrationReport report;
  };
  std::future<Made> made_;
};

/// @param whole  the scene with all its rows
template <class T>
RunResult run_in(const Scene& whole, const RunOptions& run_options) {
  const bool later = run_options.row_by_row && run_options.between && is_made_row_by_row(whole);
  const Scene scene = later ? with_few_rows(whole) : whole;
  const Precision precision = scene.scenario().precision;

  TwoIntegrations<T> made;
  if (later) made.all_rows.emplace(whole.scenario().duration_s, whole.scenario().output_step_s);
  made.options = within_estimate(scene, whole.choice().options);
  made.other_options = second_options(scene, made.options);
  const Watch& watch = run_options.watch;
  RunSeconds seconds = watch.has_progress() ? scene.estimate().seconds : RunSeconds();
  DriftProblem<T> problem = scene.problem_without_rows<T>();
  problem.times_s = output_times(scene.scenario().duration_s, scene.scenario().output_step_s);
  plan_first(scene, run_options.between, made, problem);
  SecondBeside<T> beside(scene, problem, made.looks, made.options, within_estimate(scene, made.other_options), run_options);
  if (beside.runs()) seconds.bound = std::max(0.0, seconds.bound - seconds.solution);
  Parts parts(watch, seconds.all());

  made.first = integrate_timed(problem, made.options, precision, parts.next(seconds.solution, "solution"), made.solution);
  made.solution.reason = whole.choice().reason;
  const Watch bound = parts.next(seconds.bound, "error bound");
  // Where an event has ended the first integration, the second goes on until it finds the event as well.
  const bool ended = std::ranges::any_of(made.first.contact_events, [](const ContactEvent& e) { return ends_run(e.kind); });
  const auto integrate_second = [&] {
    DriftProblem<T> second = problem;
    make_second(second, made.looks, made.first.samples.size() + (ended ? 1 : 0), made.options);
    if (made.other_options.method == made.options.method) made.other_options.kick_steps = made.first.kick_steps;
    made.other_options = within_estimate(scene, made.other_options);
    made.second = integrate_timed(second, made.other_options, precision, bound, made.certificate);
  };
  if (!beside.take(made.first, made.looks.size(), made.second, made.certificate)) integrate_second();
  if (made.second.status == RunStatus::step_underflow && made.first.status == RunStatus::completed)
    if (const auto looser = looser_second_options(scene, made.options, made.other_options)) {
      made.other_options = *looser;
      integrate_second();
    }
  // The error that long_horizon states is the part that a second integration by itself would not see. Another method sees all of it.
  if (made.options.method == Method::long_horizon && made.other_options.method != Method::long_horizon)
    for (DriftSample<T>& sample : made.first.samples) sample.drift_error = sample.attitude_error = T(0);
  return assemble_result(scene, std::move(made), seconds, parts, run_options);
}

RunResult run_once(const Scene& scene, const RunOptions& options) {
  scene.require_affordable();
#ifndef EARTHTOP_DOUBLE_ONLY  // as tools/play has it, which refuses other scenes before
  switch (scene.scenario().precision) {
    case Precision::bits53: break;
    case Precision::bits64: return run_in<float80>(scene, options);
    case Precision::bits113: return run_in<float128>(scene, options);
  }
#endif
  return run_in<double>(scene, options);
}

/// The method that is tried where the one that "auto" chose ends without a drift that can be trusted; none where there is no other.
std::optional<Method> other_method(Method chosen) {
  switch (chosen) {
    case Method::long_horizon:
    case Method::closed_form:
    case Method::fourier: return Method::taylor;
    case Method::taylor: return Method::dop853;
    case Method::dop853: return Method::extrapolation;
    default: return std::nullopt;
  }
}

/// Whether another method could do better: nothing after the release is trusted, and it is not the motion that is to blame.
bool is_worth_another(const RunResult& result) {
  if (!result.scene.has_drift() || result.status == RunStatus::interrupted) return false;
  if (const DriftRow* row = last_reliable_row(result); row != nullptr && row->t_s > 0) return false;
  const Method chosen = result.solution.method;
  // A drift below the noise of a series is below that of its neighbours, too; the bounds of the other two are wider.
  const bool is_wide = chosen == Method::long_horizon || is_exact(chosen);
  return result.status != RunStatus::completed || (is_wide && result.verdict.verdict == Verdict::noise_floor);
}

/// The scene with the other method, if that is affordable.   @param most_seconds  that it may take by its estimate
std::optional<Scene> with_other_method(const Scene& scene, double most_seconds) {
  const std::optional<Method> method = other_method(scene.choice().options.method);
  if (scene.scenario().numerics.method != Method::automatic || !method || scene.method_refusal(*method)) return std::nullopt;
  Scenario scenario = scene.scenario();
  scenario.numerics.method = *method;
  Scene other = resolve(std::move(scenario));
  try {
    other.require_affordable();
  } catch (const ScenarioError&) {
    return std::nullopt;
  }
  if (!(other.estimate().seconds.all() <= most_seconds)) return std::nullopt;
  return other;
}

/// Runs a scene, and once more by another method where the one chosen ends without a drift that can be trusted.
RunResult run_or_try_another(const Scene& scene, const RunOptions& options) {
  RunResult result = run_once(scene, options);
  if (!is_worth_another(result)) return result;
  constexpr double kTimes = 5, kLeast_s = 0.1;  // a run may take ten times its estimate
  const auto other = with_other_method(scene, kTimes * std::max(kLeast_s, scene.estimate().seconds.all()));
  if (!other) return result;
  RunOptions again = options;
  again.watch = options.watch.part(1, 1);
  RunResult second = run_once(*other, again);
  if (second.status == RunStatus::interrupted) return second;
  const DriftRow* row = last_reliable_row(second);
  if (row == nullptr || !(row->t_s > 0)) {
    result.notes.push_back(
        fmt::format("{} was tried as well: no drift by it can be trusted either", to_string(second.solution.method)));
    return result;
  }
  second.notes.push_back(fmt::format("{}, which \"auto\" chooses here, was tried first: no drift by it can be trusted",
                                     to_string(result.solution.method)));
  second.solution.reason = "the method that was tried first has no drift that can be trusted";
  return second;
}

/// Runs a scene until the requested accuracy is reached. If method and tolerance are free, it starts at the loosest tolerance
/// that may suffice and tries finer ones. @param left_out_rad  error due to the effects left out (rad)
RunResult run_to_accuracy(const Scene& scene, double left_out_rad, const RunOptions& options) {
  if (!scene.scenario().accuracy_rad) return run_or_try_another(scene, options);
  constexpr double kLoosest = 1e-6, kFiner = 1e-3;
  constexpr int kAttempts = 4;
  Scenario scenario = scene.scenario();
  AccuracyReport accuracy{*scenario.accuracy_rad, 0, 0};
  double& tolerance = scenario.numerics.relative_tolerance;
  const double least = least_tolerance(scenario.precision);
  const bool free = scenario.numerics.method == Method::automatic && tolerance == default_tolerance(scenario.precision);
  // The tolerance starts at a tenth of the requested error: errors of many steps add up, and so does the second run's error.
  if (free) tolerance = std::clamp(accuracy.asked_rad / 10, least, kLoosest);
  // The first attempt usually suffices, so it gets the larger part of the progress; later attempts share the rest.
  constexpr double kShare = 0.7;
  RunOptions attempt = options;
  for (double done = 0;;) {
    const double next = free ? done + kShare * (1 - done) : 1;
    attempt.watch = options.watch.part(std::exchange(done, next), next);
    RunResult result = run_once(free ? resolve(scenario) : scene, attempt);
    ++accuracy.attempts;
    accuracy.reached_rad = has_drift(result) ? result.drift.watched_axis_bound_rad() + left_out_rad : HUGE_VAL;
    const bool may_be_finer = free && tolerance > least && accuracy.attempts < kAttempts;
    if (accuracy.reached() || !may_be_finer || result.status != RunStatus::completed) {
      result.accuracy = accuracy;
      return result;
    }
    // Where disturbances grow, only the finest tolerance may suffice.
    const bool grows = result.verdict.verdict != Verdict::reliable && result.verdict.verdict != Verdict::noise_floor;
    const double finer = grows ? 0 : std::max(kFiner, 0.1 * accuracy.asked_rad / accuracy.reached_rad);
    tolerance = std::max(least, tolerance * finer);
  }
}

}  // namespace

double estimated_run_seconds(const Scene& scene) {
  const double choice = scene.scenario().effects.automatic ? selection_seconds(scene) : 0;
  return choice + scene.estimate().seconds.all();
}

RunResult run(const Scene& scene, const RunOptions& options) {
  require_ieee_arithmetic();
  Scene modelled = scene;
  std::optional<Selection> selection;
  RunOptions after = options;
  if (scene.scenario().effects.automatic) {
    const double choice = options.watch.has_progress() ? selection_seconds(scene) : 0;
    const double share = choice > 0 ? choice / estimated_run_seconds(scene) : 0;
    selection = select_effects(modelled, options.watch.part(0, share, "choice of effects"));
    after.watch = options.watch.part(share, 1);
  }
  modelled.require_integrable();
  RunResult result = run_to_accuracy(modelled, selection ? selection->left_out_drift_rad : 0, after);
  result.scene = scene;
  result.selection = std::move(selection);
  return result;
}

}  // namespace earthtop
