// SPDX-License-Identifier: GPL-3.0-or-later
/// Estimates how much work an integration will take, before it begins: from the angle that the scene's motion turns through,
/// from how fast friction damps it, and from the angle that a step of each method covers. Work is counted in steps and in
/// evaluations of the right-hand side, so that every machine finds the same.
#pragma once

#include <array>
#include <cstdint>

#include "earthtop/integrate/options.hpp"

namespace earthtop {

/// How many times the work that a rule finds an integration takes.
struct WorkRatio {
  double steps = 1;
  double evaluations = 1;
};

/// The properties of a scene that decide the number of steps over its whole duration.
struct Pace {
  double duration_s = 0;       ///< duration of the scene (s); 0: nothing is known of it
  double rows = 0;             ///< number of output times
  double judgement_looks = 0;  ///< number of other times at which a run looks at its motions to judge their errors
  double axis_rate_rad_s =
      0;                   ///< rough upper bound on the rates of the axis's motion, without a symmetric top's own spin (rad/s)
  double joints = 0;       ///< number of other times at which steps must end
  double turning_rad = 0;  ///< angle that the fastest motion turns through, as seen from the body
  double reduced_turning_rad = 0;  ///< the same angle in the reduced form, which leaves the spin out
  double reduced_damping = 0;      ///< `damping` in the reduced form
  double undamped_rest_rad =
      0;  ///< angle that a motion would have turned through after friction stopped it: it still bounds steps
  double watched_angle_rad = 0;  ///< largest angle that the watched angles turn through
  double damping = 0;            ///< time integral of the fastest rate at which friction damps a motion (dimensionless)
  double halts = 0;              ///< how often a motion stops or reverses, so that its friction jumps
  /// The work of stretches of the motion that were integrated to see it, against the rule's, by method and for the variational
  /// equations; 1 where nothing was looked at.
  std::array<WorkRatio, kMethodCount> seen = {};
  WorkRatio variations_seen = {};
  bool known() const { return duration_s > 0; }
};

/// The work of one integration: numbers of steps and of evaluations of the right-hand side.
struct Work {
  double steps = 0;
  double evaluations = 0;
};

/// The work of integrating both motions and the deviation between them, right within a factor of a few.
/// @param options  with any method but long_horizon and closed_form
/// @param reduced  whether the reduced form is integrated
Work estimated_work(const Pace& pace, const IntegrationOptions& options, bool reduced);

/// The work of integrating the variational equations of a motion (drift/growth.hpp, drift/sensitivity.hpp) by rkf78, the method
/// that is used for them.
/// @param time_s  how long they are integrated (s)
Work variational_work(const Pace& pace, double time_s, double relative_tolerance);

/// The number of steps that friction takes for the method to stay stable. Where that is nearly all the steps, a scene is stiff.
double damping_steps(const Pace& pace, const IntegrationOptions& options);

/// The work at which an integration is stopped: ten times its estimate.
struct WorkLimit {
  static constexpr std::int64_t kNone = std::int64_t{1} << 62;
  std::int64_t steps = kNone;
  std::int64_t evaluations = kNone;
};
/// The limit that belongs to an estimate.
/// @param least_evaluations  granted in any case: ten times the tenth of a second below which the estimate promises nothing
WorkLimit work_limit_for(const Work& estimate, double least_evaluations = 1e6);

}  // namespace earthtop
