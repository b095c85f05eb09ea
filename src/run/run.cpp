#include "earthtop/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <utility>

#include "run/assessment.hpp"
#include "run/drift_bound.hpp"
#include "run/setup.hpp"

namespace earthtop {
namespace {

std::atomic<bool> stop_asked = false;

/// `automatic` is rkf78, of odeint's methods the one with the least error at a given cost on the shipped scenarios, with a
/// local tolerance a hundred times finer than the one asked for: local errors add up over the thousands of steps of a run.
IntegrationOptions first_options(const IntegrationOptions& asked) {
  IntegrationOptions first = asked;
  if (first.method != Method::automatic) return first;
  first.method = Method::rkf78;
  first.relative_tolerance = std::max(0.01 * asked.relative_tolerance, 1e-14);
  return first;
}

/// The second integration: rkf78 in another observer's equations, of the same form; ten times coarser where the rows come from
/// rkf78 too, finer than the rows otherwise.
IntegrationOptions second_options(const IntegrationOptions& first, ModelForm form) {
  IntegrationOptions second = first;
  second.form = form;
  second.step_s.reset();
  second.method = Method::rkf78;
  second.observer = first.observer == Observer::inertial ? Observer::body : Observer::inertial;
  if (first.method == Method::rkf78)
    second.relative_tolerance = std::min(10 * first.relative_tolerance, 0.1);
  else if (first.method == Method::abm8)
    second.relative_tolerance = 1e-13;
  else
    second.relative_tolerance = std::max(1e-13, std::min(0.1 * first.relative_tolerance, 1e-10));
  return second;
}

DriftTrajectory<double> integrate_timed(const DriftProblem<double>& problem, const IntegrationOptions& options,
                                        IntegrationReport& report) {
  const auto start = std::chrono::steady_clock::now();
  DriftTrajectory<double> trajectory = integrate_drift(problem, options, &stop_asked);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.observer = options.observer;
  report.form = takes_reduced_form(problem.model, options) ? ModelForm::reduced : ModelForm::general;
  report.method = options.method;
  report.relative_tolerance = options.relative_tolerance;
  report.step_s = trajectory.step_s;
  report.counters = trajectory.counters;
  return trajectory;
}

template <class Vector>
std::array<double, 3> to_array(const Vector& v) {
  return {v[0] + 0.0, v[1] + 0.0, v[2] + 0.0};
}
std::array<double, 4> to_array(const Quaternion<double>& q) { return {q.w + 0.0, q.v[0] + 0.0, q.v[1] + 0.0, q.v[2] + 0.0}; }

DriftRow make_row(const DriftSample<double>& sample, const DriftBound& bound) {
  const DriftState<double>& s = sample.state;
  const DriftMeasures<double>& m = sample.measures;
  DriftRow row;
  row.t_s = s.t_s;
  const Quaternion<double> q_LB = s.q_LB.normalized(), ref_q_LB = s.ref_q_LB.normalized();
  row.q_LB = to_array(q_LB);
  row.w_LB_B = to_array(s.w_LB_B);
  row.ref_q_LB = to_array(ref_q_LB);
  row.ref_w_LB_B = to_array(s.ref_w_LB_B);
  row.axis_L = to_array(rotation_matrix(q_LB).col(2));
  row.ref_axis_L = to_array(rotation_matrix(ref_q_LB).col(2));
  row.drift_axis_rad = m.axis;
  row.drift_axis_bound_rad = bound.axis();
  if (m.azimuth_defined) row.drift_azimuth_rad = sample.azimuth;
  row.drift_tilt_rad = m.tilt;
  row.drift_attitude_rad = m.attitude;
  row.drift_attitude_bound_rad = bound.attitude();
  row.drift_spin_rad = sample.spin;
  return row;
}

/// The angle between two attitudes (rad).
double attitude_distance(const Quaternion<double>& p, const Quaternion<double>& q) {
  const Quaternion<double> d = p.conjugate() * q;
  return 2 * std::atan2(norm(d.v), std::abs(d.w));
}

}  // namespace

void request_interrupt() noexcept { stop_asked = true; }

bool interrupt_requested() noexcept { return stop_asked; }

namespace {

/// What is known of a run that was asked to stop: how far it came.
RunResult stopped(RunResult result, const DriftTrajectory<double>& first) {
  result.status = RunStatus::interrupted;
  result.reached_s = first.samples.empty() ? 0 : first.samples.back().state.t_s;
  result.rows.clear();
  return result;
}

}  // namespace

RunResult run(const Scenario& scenario) {
  require_affordable(scenario);
  auto problem = make_problem<double>(scenario);
  const IntegrationOptions options = first_options(scenario.numerics);

  RunResult result;
  result.scenario = scenario;
  const DriftTrajectory<double> first = integrate_timed(problem, options, result.solution);
  problem.rotating = RotatingMotion::composed;
  problem.times_s.resize(std::max<std::size_t>(1, first.samples.size()));  // no further than the rows got
  nudge(problem);
  const DriftTrajectory<double> second =
      integrate_timed(problem, second_options(options, result.solution.form), result.certificate);
  result.status = first.status != RunStatus::completed ? first.status : second.status;

  // What follows takes seconds where the rows are millions.
  DriftBound bound;
  const std::size_t count = std::min(first.samples.size(), second.samples.size());
  for (std::size_t i = 0; i < count && !stop_asked; ++i) {
    const DriftSample<double>& sample = first.samples[i];
    const DriftSample<double>& other = second.samples[i];
    bound.include(sample.measures, other.measures, sample.state.epsilon);
    result.rows.push_back(make_row(sample, bound));
    const double distance = std::max(attitude_distance(sample.state.q_LB, other.state.q_LB),
                                     attitude_distance(sample.state.ref_q_LB, other.state.ref_q_LB));
    result.attitude_bound_rad = std::max(result.attitude_bound_rad, DriftBound::kSafety * distance);
  }
  if (stop_asked) return stopped(std::move(result), first);
  result.reached_s = result.rows.empty() ? 0 : result.rows.back().t_s;
  result.drift = summarize_drift(result.rows, scenario.rotation_rate_rad_s);
  result.drift.threshold_time_s = first.threshold_time_s;
  if (stop_asked) return stopped(std::move(result), first);
  result.invariants = assess_invariants(scenario, result.rows);
  if (stop_asked) return stopped(std::move(result), first);
  result.theory = assess_theory(scenario, result.rows, result.drift);
  if (stop_asked) return stopped(std::move(result), first);
  result.ledger = assess_ledger(scenario, result.rows);
  if (!scenario.effects.all_on()) result.notes.emplace_back("non-physical scene: a non-inertial torque is switched off");
  return result;
}

}  // namespace earthtop
