// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of integrate_motion; each of motion_integration_*.cpp instantiates it for one scalar.
#pragma once

#include <stdexcept>

#include "integrate/closed_form_motion.hpp"
#include "integrate/driven_axis_motion.hpp"
#include "integrate/fourier/fourier_motion.hpp"
#include "integrate/long_horizon_motion.hpp"
#include "integrate/motion_system.hpp"

namespace earthtop {
namespace {

template <class T, class System>
MotionTrajectory<T> integrate_motion_of(const MotionProblem<T>& problem, const IntegrationOptions& options,
                                        const Watch& watch) {
  System system(problem);
  const std::vector<T> times = natural_times(problem);
  const DriveOptions<T> drive = drive_options(problem, options, watch);
  MotionTrajectory<T> trajectory;
  trajectory.samples.reserve(times.size());
  using State = typename System::State;
  const auto on_step = [&](T, const State& x) { system.follow(x); };
  const auto on_row = [&](std::size_t row, const State& x) {
    trajectory.samples.push_back(sample_at(system, problem, x, times[row], problem.times_s[row]));
  };
  Driver<T, System, decltype(on_step), decltype(on_row)> driver(system, drive, on_step, on_row);
  State x = system.initial_state();
  trajectory.status = driver.run(x, times);
  trajectory.counters = driver.counters();
  return trajectory;
}

template <class T, Observer O>
MotionTrajectory<T> integrate_general_motion(const MotionProblem<T>& problem, const IntegrationOptions& options,
                                             const Watch& watch) {
  if (problem.model.kind == SceneKind::plain)
    return integrate_motion_of<T, GeneralMotionSystem<T, O, SceneKind::plain>>(problem, options, watch);
  return integrate_motion_of<T, GeneralMotionSystem<T, O, SceneKind::full>>(problem, options, watch);
}

template <class T, Observer O>
MotionTrajectory<T> integrate_reduced_motion(const MotionProblem<T>& problem, const IntegrationOptions& options,
                                             MotionSought sought, const Watch& watch) {
  if (sought == MotionSought::symmetry_axis)
    return integrate_motion_of<T, ReducedMotionSystem<T, O, MotionSought::symmetry_axis>>(problem, options, watch);
  return integrate_motion_of<T, ReducedMotionSystem<T, O, MotionSought::attitude>>(problem, options, watch);
}

}  // namespace

template <class T>
MotionTrajectory<T> integrate_motion(const MotionProblem<T>& problem, const IntegrationOptions& options, MotionSought sought,
                                     const Watch& watch) {
  if (options.method == Method::closed_form) return closed_form_motion(problem, options, watch);
  if (options.method == Method::fourier) return fourier_motion(problem, watch);
  if (options.method == Method::long_horizon) {
    if constexpr (std::is_same_v<T, double>)
      return long_horizon_motion(problem, options, watch);
    else
      throw std::logic_error("long_horizon is built for double only");
  }
  if (problem.model.kind == SceneKind::gyrostat)
    return integrate_motion_of<T, GeneralMotionSystem<T, Observer::body, SceneKind::gyrostat>>(problem, options, watch);
  const bool reduced = takes_reduced_form(is_reducible(problem.model), options);
  if constexpr (std::is_same_v<T, double>)
    if (sought == MotionSought::symmetry_axis && has_axis_motion(problem.model, options))
      return integrate_motion_of<double, DrivenAxisMotion>(problem, options, watch);
  // In scenes that are not plain only the general form in body axes has a series.
  if (options.method == Method::taylor && problem.model.kind != SceneKind::plain)
    return integrate_general_motion<T, Observer::body>(problem, options, watch);
  switch (options.observer) {
    case Observer::laboratory:
      if (reduced) return integrate_reduced_motion<T, Observer::laboratory>(problem, options, sought, watch);
      return integrate_general_motion<T, Observer::laboratory>(problem, options, watch);
    case Observer::body:
      if (reduced) throw std::logic_error("the reduced form has no body axes");
      return integrate_general_motion<T, Observer::body>(problem, options, watch);
    case Observer::inertial:
      if (reduced) return integrate_reduced_motion<T, Observer::inertial>(problem, options, sought, watch);
      return integrate_general_motion<T, Observer::inertial>(problem, options, watch);
  }
  throw std::logic_error("unknown observer");
}

}  // namespace earthtop
