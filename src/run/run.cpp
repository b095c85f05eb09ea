#include "earthtop/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <type_traits>
#include <utility>

#include "earthtop/arithmetic.hpp"
#include "run/assessment.hpp"
#include "run/drift_bound.hpp"
#include "run/rows.hpp"
#include "run/sensitivities.hpp"
#include "run/verdict.hpp"
#include "scenario/problem.hpp"

namespace earthtop {
namespace {

std::atomic<bool> stop_asked = false;

/// The second integration: in another observer's equations, of the same form, and by another method wherever one is affordable.
/// Two runs of one method make the same error where output times, not the tolerance, cut their steps: their distance then says
/// nothing. extrapolation, the cheapest of those that know nothing of the model, stands against all others, and rkf78 against
/// it; only in float128, where rkf78 would take ten times as long as both runs, does extrapolation stand against itself. The
/// tolerance is a hundredth, so that the distance is the error of the rows; where the digits do not allow that ten times as
/// large, so that it is more.
///
/// closed_form has no error that an integration could see: its own statement is far below. What is left is what the rounding of
/// the scene makes of the motion, and the same closed form of the nudged scene shows that at the price of the rows. That the
/// formula is the motion, no comparison within a run has to show: the tests hold it against integrations of every scene it
/// fits.
///
/// With dry friction both are in body axes, where a motion at rest is held.
///
/// Against long_horizon no method that follows the nutation is affordable where that method is worth taking: there it stands
/// against itself at a finer tolerance and in steps that have no common measure with the first ones (the observer names them),
/// which excite other nutation. Where a run has few nutations, extrapolation.
IntegrationOptions second_options(const IntegrationOptions& first, ModelForm form, Precision precision, double phase,
                                  bool dry_friction) {
  IntegrationOptions second = first;
  second.form = form;
  second.step_s.reset();
  const Observer other =
      form == ModelForm::reduced ? Observer::laboratory : Observer::body;  // the reduced form has no body axes
  second.observer = first.observer == Observer::inertial ? other : Observer::inertial;
  if (first.method == Method::closed_form) return second;
  if (dry_friction) second.observer = first.observer;
  const bool unlike = first.method != Method::extrapolation || precision == Precision::bits113;
  second.method = unlike ? Method::extrapolation : Method::rkf78;
  const double asked = first.relative_tolerance;
  const double least = precision == Precision::bits53 ? 1e-13 : least_tolerance(precision);  // of doubles, round-off
  const double finer = std::max(asked / 100, least);
  second.relative_tolerance = finer <= asked / 30 ? finer : std::min(10 * asked, 0.1);
  if (first.step_s || first.method == Method::taylor) second.relative_tolerance = finer;
  constexpr double kAffordable = 3e5;  // rad; a second
  if (first.method == Method::long_horizon && phase > kAffordable) {
    second.method = Method::long_horizon;
    second.relative_tolerance = std::max(asked / 100, least_tolerance(precision));
  }
  return second;
}

template <class T>
DriftTrajectory<T> integrate_timed(const DriftProblem<T>& problem, const IntegrationOptions& options, Precision precision,
                                   IntegrationReport& report) {
  const auto start = std::chrono::steady_clock::now();
  DriftTrajectory<T> trajectory = integrate_drift(problem, options, &stop_asked);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.observer = options.observer;
  const bool closed_form = options.method == Method::closed_form;
  report.form = !closed_form && takes_reduced_form(problem.model, options) ? ModelForm::reduced : ModelForm::general;
  report.method = options.method;
  report.precision = to_string(precision);
  if (!closed_form) report.relative_tolerance = options.relative_tolerance;
  report.step_s = trajectory.step_s;
  report.counters = trajectory.counters;
  return trajectory;
}

/// By how much the distance to the second integration is multiplied. Where that one is the rows' own method, or no finer than
/// they are, both err by as much, and may do so to the same side: in 3 of 92 random scenes three times their distance was not
/// enough.
int bound_safety(const IntegrationOptions& first, const IntegrationOptions& second) {
  const bool alike = second.method == first.method && first.method != Method::closed_form;
  return alike || second.relative_tolerance >= first.relative_tolerance ? 10 : 3;
}

/// How many rows the bound of row i rests on: in the first ones two runs may agree by chance, so that each is held against what
/// they make of the next two as well.
std::size_t rows_compared(std::size_t i) { return i + 3; }

/// The angle between two attitudes (rad).
template <class T>
double attitude_distance(const Quaternion<T>& p, const Quaternion<T>& q) {
  const Quaternion<T> d = p.conjugate() * q;
  return static_cast<double>(T(2) * real::atan2(norm(d.v), real::abs(d.w)));
}

/// A row in double, and in full where there is more to it.
template <class T>
void add_row(const BasicDriftRow<T>& row, RunResult& result) {
  if constexpr (std::is_same_v<T, double>) {
    result.rows.push_back(row);
  } else {
    result.rows.push_back(row_cast<double>(row));
    result.extended_rows.push_back(row_cast<float128>(row));
  }
}

/// What is known of a run that was asked to stop: how far it came.
RunResult stopped(RunResult result, double reached_s) {
  result.status = RunStatus::interrupted;
  result.reached_s = reached_s;
  result.rows.clear();
  result.extended_rows.clear();
  return result;
}

/// A disc whose flow changes on the way: the formula taken at release is kept.
std::optional<std::string> note_on_air(const RunResult& result) {
  const auto& disc = result.scenario.effects.applied.air_drag;
  if (!disc || disc->flow != DiscFlow::automatic || result.rows.empty()) return std::nullopt;
  const bool turbulent = is_turbulent(*disc, result.rows.front().w_LB_B[2]);
  const auto other = std::find_if(result.rows.begin(), result.rows.end(),
                                  [&](const DriftRow& row) { return is_turbulent(*disc, row.w_LB_B[2]) != turbulent; });
  if (other == result.rows.end()) return std::nullopt;
  return fmt::format(
      "from {} s on the air round the disc is {}, but the drag is that of the release, {}: give /effects/air_drag/flow",
      other->t_s, turbulent ? "laminar" : "turbulent", turbulent ? "turbulent" : "laminar");
}

template <class T>
RunResult run_in(const Scenario& scenario) {
  auto problem = make_problem<T>(scenario);
  const Precision precision = scenario.precision;
  const MethodChoice choice = method_choice(scenario);
  const IntegrationOptions& options = choice.options;

  RunResult result;
  result.scenario = scenario;
  const DriftTrajectory<T> first = integrate_timed(problem, options, precision, result.solution);
  result.solution.reason = choice.reason;
  const double reached_s = first.samples.empty() ? 0 : problem.times_s[first.samples.size() - 1];
  problem.rotating = RotatingMotion::composed;
  problem.times_s.resize(std::max<std::size_t>(1, first.samples.size()));  // no further than the rows got
  nudge(problem);
  const double phase = fastest_rate_rad_s(scenario) * problem.times_s.back();
  const bool dry_friction = scenario.effects.applied.coulomb_N_m != 0;
  const IntegrationOptions other_options = second_options(options, result.solution.form, precision, phase, dry_friction);
  const DriftTrajectory<T> second = integrate_timed(problem, other_options, precision, result.certificate);
  result.status = first.status != RunStatus::completed ? first.status : second.status;

  // What follows takes seconds where the rows are millions.
  const int safety = bound_safety(options, other_options);
  DriftBound<T> bound(safety);
  const std::size_t count = std::min(first.samples.size(), second.samples.size());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < count && !stop_asked; ++i) {
    for (const std::size_t ahead = std::min(count, rows_compared(i)); compared < ahead; ++compared) {
      const DriftSample<T>& sample = first.samples[compared];
      bound.include(sample.measures, second.samples[compared].measures, sample.state.epsilon);
      bound.include_stated(sample.drift_error);
    }
    const DriftSample<T>& sample = first.samples[i];
    const DriftSample<T>& other = second.samples[i];
    add_row(make_row(sample, bound), result);
    const double distance = std::max(attitude_distance(sample.state.q_LB, other.state.q_LB),
                                     attitude_distance(sample.state.ref_q_LB, other.state.ref_q_LB));
    result.attitude_bound_rad =
        std::max(result.attitude_bound_rad, safety * distance + static_cast<double>(sample.attitude_error));
  }
  if (stop_asked) return stopped(std::move(result), reached_s);
  result.reached_s = result.rows.empty() ? 0 : result.rows.back().t_s;
  result.drift = summarize_drift(result.rows, scenario.rotation_rate_rad_s);
  result.drift.threshold_time_s = first.threshold_time_s;
  result.stops = first.stops;
  if (stop_asked) return stopped(std::move(result), reached_s);
  result.verdict = assess_verdict(result, stop_asked);
  mark_rows(result);
  if (stop_asked) return stopped(std::move(result), reached_s);
  result.sensitivities = assess_sensitivities(result, stop_asked);
  if (stop_asked) return stopped(std::move(result), reached_s);
  result.invariants = assess_invariants(result);
  if (stop_asked) return stopped(std::move(result), reached_s);
  result.theory = assess_theory(scenario, result.rows, result.drift);
  if (stop_asked) return stopped(std::move(result), reached_s);
  result.ledger = assess_ledger(result);
  if (const auto note = note_on_air(result)) result.notes.push_back(*note);
  if (!scenario.effects.all_on()) result.notes.emplace_back("non-physical scene: a non-inertial torque is switched off");
  return result;
}

RunResult run_once(const Scenario& scenario) {
  require_affordable(scenario);
  switch (scenario.precision) {
    case Precision::bits53: break;
    case Precision::bits64: return run_in<long double>(scenario);
    case Precision::bits113: return run_in<float128>(scenario);
  }
  return run_in<double>(scenario);
}

/// Where an error is asked for, and method and tolerance are free, from the loosest tolerance that may reach it to finer ones.
/// @param left_out_rad  what the effects left out may cost of it
RunResult run_to_accuracy(Scenario scenario, double left_out_rad) {
  if (!scenario.accuracy_rad) return run_once(scenario);
  constexpr double kLoosest = 1e-6, kFiner = 1e-3;
  constexpr int kAttempts = 4;
  AccuracyReport accuracy{*scenario.accuracy_rad, 0, 0};
  double& tolerance = scenario.numerics.relative_tolerance;
  const double least = least_tolerance(scenario.precision);
  const bool free = scenario.numerics.method == Method::automatic && tolerance == default_tolerance(scenario.precision);
  // A tenth of the error asked for: steps are many, and the second run's error counts as the first one's.
  if (free) tolerance = std::clamp(accuracy.asked_rad / 10, least, kLoosest);
  for (;;) {
    RunResult result = run_once(scenario);
    ++accuracy.attempts;
    accuracy.reached_rad = result.drift.axis_bound_rad + left_out_rad;
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

void request_interrupt() noexcept { stop_asked = true; }

bool interrupt_requested() noexcept { return stop_asked; }

const std::atomic<bool>& interrupt_flag() noexcept { return stop_asked; }

RunResult run(const Scenario& scenario) {
  require_ieee_arithmetic();
  Scenario modelled = scenario;
  std::optional<Selection> selection;
  if (scenario.effects.automatic) selection = select_effects(modelled, &stop_asked);
  if (const auto reason = method_refusal(modelled.numerics.method, modelled)) throw ScenarioError("/numerics/method", *reason);
  RunResult result = run_to_accuracy(modelled, selection ? selection->left_out_drift_rad : 0);
  result.modelled = std::move(result.scenario);
  result.scenario = scenario;
  result.selection = std::move(selection);
  return result;
}

}  // namespace earthtop
