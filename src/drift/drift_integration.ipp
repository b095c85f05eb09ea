// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of integrate_drift; each of drift_integration_*.cpp instantiates it for one scalar.
#pragma once

#include "drift/closed_form_drift.hpp"
#include "drift/fourier_drift.hpp"
#include "drift/gimbals/gimbal_watch.hpp"
#include "drift/integrate_system.hpp"
#include "drift/long_horizon/long_horizon_drift.hpp"
#include "drift/pivot/compass_drift.hpp"
#include "drift/pivot/drift_system.hpp"
#include "drift/pivot/driven_reduced_drift.hpp"
#include "drift/pivot/reduced_drift_system.hpp"
#include "drift/table/contact_integration.hpp"

namespace earthtop {
namespace {

template <class T, Observer O, SceneKind K, RotatingMotion R>
DriftTrajectory<T> integrate_general(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  DriftSystem<T, O, K, R> system(problem.model);
  const auto x = system.initial_state(problem.natural_release());
  // The steps of the other methods are short enough anyway.
  const T largest_step = row_of(options.method).cost.is_watched ? longest_unseen_step(problem) : T(0);
  return integrate_system(system, x, problem, options, watch, largest_step);
}

template <class T, Observer O, RotatingMotion R = RotatingMotion::integrated>
DriftTrajectory<T> integrate_as(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  if (problem.model.kind == SceneKind::plain) return integrate_general<T, O, SceneKind::plain, R>(problem, options, watch);
  return integrate_general<T, O, SceneKind::full, R>(problem, options, watch);
}

template <class T>
DriftTrajectory<T> integrate_gyrostat(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  constexpr auto K = SceneKind::gyrostat;
  constexpr auto R = RotatingMotion::composed;
  switch (options.observer) {
    case Observer::laboratory: return integrate_general<T, Observer::laboratory, K, R>(problem, options, watch);
    case Observer::body: return integrate_general<T, Observer::body, K, R>(problem, options, watch);
    case Observer::inertial: return integrate_general<T, Observer::inertial, K, R>(problem, options, watch);
  }
  throw std::logic_error("unknown observer");
}

template <class T, Observer O>
DriftTrajectory<T> integrate_gimbals(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  GimbalDrift<T, O> system(problem.model, problem.release.X);
  const T largest_step = row_of(options.method).cost.is_watched ? longest_unseen_step(problem) : T(0);
  return integrate_system(system, system.initial_state(), problem, options, watch, largest_step);
}

template <class T, Observer O>
DriftTrajectory<T> integrate_reduced(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  const auto integrate = [&](auto&& system) {
    return integrate_system(system, system.initial_state(), problem, options, watch, system.largest_step());
  };
  if (is_reducible(problem.model)) return integrate(ReducedDriftSystem<T, O>(problem.model, problem.natural_release()));
  if (is_compass(problem.model)) return integrate(CompassDrift<T, O>(problem.model, problem.natural_release()));
  return integrate(DrivenReducedDrift<T, O>(problem.model, problem.natural_release()));
}

}  // namespace

template <class T>
DriftTrajectory<T> integrate_drift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  if (problem.table) return integrate_contact(problem, options, watch);
  if (options.method == Method::closed_form) return closed_form_drift(problem, options, watch);
  if (options.method == Method::fourier) return fourier_drift(problem, options, watch);
  if (options.method == Method::long_horizon) {
    if constexpr (std::is_same_v<T, double>)
      return long_horizon_drift(problem, options, watch);
    else
      throw std::logic_error("long_horizon is built for double only");
  }
  if (problem.model.kind == SceneKind::gyrostat) return integrate_gyrostat(problem, options, watch);
  if (problem.model.kind == SceneKind::suspension) {
    if (options.observer == Observer::body) throw std::logic_error("a Cardan suspension is not integrated in body axes");
    return options.observer == Observer::inertial ? integrate_gimbals<T, Observer::inertial>(problem, options, watch)
                                                  : integrate_gimbals<T, Observer::laboratory>(problem, options, watch);
  }
  const bool reduced = takes_reduced_form(problem.model, options), composed = options.method == Method::taylor;
  switch (options.observer) {
    case Observer::laboratory:
      if (reduced) return integrate_reduced<T, Observer::laboratory>(problem, options, watch);
      return integrate_as<T, Observer::laboratory>(problem, options, watch);
    case Observer::body:
      if (reduced) throw std::logic_error("the reduced form has no body axes");
      if (composed || (problem.rotating == RotatingMotion::composed && problem.model.applied.coulomb == T(0)))
        return integrate_as<T, Observer::body, RotatingMotion::composed>(problem, options, watch);
      return integrate_as<T, Observer::body>(problem, options, watch);
    case Observer::inertial:
      if (reduced) return integrate_reduced<T, Observer::inertial>(problem, options, watch);
      if (composed || problem.rotating == RotatingMotion::composed)
        return integrate_as<T, Observer::inertial, RotatingMotion::composed>(problem, options, watch);
      return integrate_as<T, Observer::inertial>(problem, options, watch);
  }
  throw std::logic_error("unknown observer");
}

}  // namespace earthtop
