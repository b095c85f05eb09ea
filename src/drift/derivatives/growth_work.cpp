// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/growth_work.hpp"

#include <algorithm>

#include "drift/given_impulse.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/model/reduced_torques.hpp"

namespace earthtop {

namespace {

/// Whether the motion is followed without its spin.
bool is_spinless(const Model<double>& model) { return is_reducible_when_driven(model) || is_compass(model); }

}  // namespace

bool has_smooth_series(const MotionProblem<double>& problem, double duration_s) {
  const Model<double>& model = problem.model;
  const double end = problem.units.time_from_s(duration_s);
  double I3 = 1, w3 = 0;  // of a body whose rates no symmetry keeps
  if (is_spinless(model)) {
    const int axis = symmetry_axis(model.I_BP_B, model.mass_moment_B);
    I3 = model.I_BP_B(axis, axis), w3 = problem.natural_release().w_XB_B[axis];
  }
  const double carrier_rate = model.platform.turn.largest_rate(end) + norm(model.W_IL_L);
  return (!model.applied.has_corner() || given_torque_keeps_spin(model.applied.given, I3, w3, end)) &&
         friction_stays_smooth(model.applied, I3, w3, carrier_rate, problem.fastest_rate, end);
}

Work growth_work(const MotionProblem<double>& problem, double duration_s, double relative_tolerance) {
  // As disturbance_growth has it.
  const bool is_embedded = problem.model.kind == SceneKind::plain && !is_spinless(problem.model);
  if (is_embedded || !has_smooth_series(problem, duration_s))
    return variational_work(problem.pace, duration_s, relative_tolerance);
  IntegrationOptions series;
  series.method = Method::taylor, series.relative_tolerance = growth_series_tolerance(relative_tolerance);
  Pace pace = problem.pace;
  pace.rows = 0;
  const Work whole = estimated_work(pace, series, is_spinless(problem.model));
  const double share = pace.known() ? duration_s / pace.duration_s : 0;
  // The steps and evaluations of these series as a share of those that a motion takes at the same tolerance, as measured: their orders are
  // higher (DisturbedMotion::Shape).
  constexpr double kSteps = 0.58, kEvaluations = 0.9;
  return {std::max(kFewestGrowthSteps, kSteps * share * whole.steps),
          std::max(kFewestGrowthSteps, share * whole.steps) * kEvaluations * whole.evaluations / whole.steps};
}

}  // namespace earthtop
