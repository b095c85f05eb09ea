// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/growth_work.hpp"

#include <algorithm>

#include "earthtop/drift/growth.hpp"
#include "earthtop/model/reduced_torques.hpp"

namespace earthtop {

bool has_spinless_series(const MotionProblem<double>& problem, double duration_s) {
  if (!is_reducible_when_driven(problem.model) && !is_compass(problem.model)) return false;
  const int axis = symmetry_axis(problem.model.I_BP_B, problem.model.mass_moment_B);
  const double w3 = problem.units.rate_from_rad_s(problem.release.w_XB_B[axis]), I3 = problem.model.I_BP_B(axis, axis);
  const double end = problem.units.time_from_s(duration_s);
  const double carrier_rate = problem.model.platform.turn.largest_rate(end) + norm(problem.model.W_IL_L);
  return friction_stays_smooth(problem.model.applied, I3, w3, carrier_rate, problem.fastest_rate, end);
}

Work growth_work(const MotionProblem<double>& problem, double duration_s, double relative_tolerance) {
  if (problem.model.kind == SceneKind::plain || !has_spinless_series(problem, duration_s))
    return variational_work(problem.pace, duration_s, relative_tolerance);
  IntegrationOptions series;
  series.method = Method::taylor, series.relative_tolerance = relative_tolerance;
  Pace pace = problem.pace;
  pace.rows = 0;
  const Work whole = estimated_work(pace, series, true);
  const double share = pace.known() ? duration_s / pace.duration_s : 0;
  const double steps = std::max(kFewestGrowthSteps, share * whole.steps);
  return {steps, steps * whole.evaluations / whole.steps};
}

}  // namespace earthtop
