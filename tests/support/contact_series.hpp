// SPDX-License-Identifier: GPL-3.0-or-later
/// Motions on a table by Taylor series, watched for events.
#pragma once

#include <string>

#include "drift/table/contact_watch.hpp"
#include "integrate/taylor/taylor_stepper.hpp"
#include "support/contact_runs.hpp"

namespace earthtop::testing {

/// The problem of a scene as the run has it, without output times.
inline DriftProblem<double> drift_problem(const ContactProblem<double>& made) {
  DriftProblem<double> problem;
  problem.model = made.model, problem.release = made.release, problem.units = made.units;
  problem.table = {made.contact, made.start};
  return problem;
}

/// The event of a watched motion is what ends it early.
struct WatchedMotion {
  std::vector<ContactEvent> events;
  double reached_s = 0;
};
template <class T, Observer O, Form F = Form::reduced>
WatchedMotion watched_motion(const ContactScene& scene, double duration_s, double tolerance) {
  const ContactProblem<T> problem(scene);
  auto system = problem.template system<O, F>();
  using System = decltype(system);
  auto functions = contact_event_functions(problem.model, problem.contact, problem.start);
  if (scene.contact.max_tilt_deg) functions.least_cosine = T(std::cos(*scene.contact.max_tilt_deg * real::pi<double>() / 180));
  if (scene.contact.static_coefficient) functions.most_friction = T(*scene.contact.static_coefficient);
  ContactWatch<T, System> watch(system, functions, problem.units.rate_from_rad_s(T(scene.spin_rad_s + 50)));

  GroupScales<T, typename System::Shape> scales;
  auto x = system.initial_state();
  scales.include(x), scales.include(system.typical_state());
  taylor::TaylorStepper<T, System> stepper(T(tolerance), scales);
  auto series = system.series();
  stepper.initialize(x, T(0));
  const T end = problem.units.time_from_s(T(duration_s));
  WatchedMotion motion;
  T t = T(0);
  bool ended = watch.follow(t, x);
  for (int i = 0; i < 1'000'000 && t < end && !ended; ++i) {
    stepper.limit_step(T(end - t));
    stepper.do_step(series);
    x = stepper.current_state();
    if (!all_finite(x)) break;
    t = stepper.current_time();
    scales.include(x);
    ended = watch.follow(t, x);
  }
  motion.reached_s = static_cast<double>(real::scale(t, problem.units.time_exponent));
  motion.events = contact_events(watch, problem.model.epsilon, problem.units);
  return motion;
}

}  // namespace earthtop::testing
