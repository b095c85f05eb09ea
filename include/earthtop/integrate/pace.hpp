// SPDX-License-Identifier: GPL-3.0-or-later
/// How much work an integration takes, before any of it is done: from how far the scene's motion turns, how fast friction
/// damps it, and what a step of each method covers. Counted in steps and evaluations of the right-hand side, so that every
/// machine finds the same.
#pragma once

#include <cstdint>

#include "earthtop/integrate/options.hpp"

namespace earthtop {

/// What of a scene decides the number of steps, over its whole duration.
struct Pace {
  double duration_s = 0;           ///< 0: nothing is known of the scene
  double rows = 0;                 ///< output times
  double joints = 0;               ///< other times at which steps end
  double turning_rad = 0;          ///< what the fastest motion turns through, as seen from the body
  double reduced_turning_rad = 0;  ///< the same in the reduced form, which leaves the spin out
  double settled_rad = 0;  ///< what motions would turn through that friction has brought to rest: they bound steps still
  double looks_rad = 0;    ///< what the watched angles turn through at the most
  double damping = 0;      ///< integral of the fastest rate at which friction damps a motion (1)
  double halts = 0;        ///< how often dry friction ends a motion, or turns it round
  bool known() const { return duration_s > 0; }
};

/// Of one integration.
struct Work {
  double steps = 0;
  double evaluations = 0;
};

/// Of both motions and the deviation between them, within a factor of a few. @param options  with a method that takes steps of
/// its own: neither long_horizon nor closed_form   @param reduced  whether it is the reduced form
Work estimated_work(const Pace& pace, const IntegrationOptions& options, bool reduced);

/// Of the variational equations of a motion, by the method of order 8 that follows them (drift/growth.hpp, sensitivity.hpp).
/// @param time_s  how long they are followed
Work variational_work(const Pace& pace, double time_s, double relative_tolerance);

/// Friction's share of the steps: where it is nearly all, a scene is stiff.
double damping_steps(const Pace& pace, const IntegrationOptions& options);

/// Where an integration stops for having taken too much: at ten times the work estimated of it.
struct WorkLimit {
  static constexpr std::int64_t kNone = std::int64_t{1} << 62;
  std::int64_t steps = kNone;
  std::int64_t evaluations = kNone;
};
/// @param least_evaluations  what is granted in any case: ten times the tenth of a second below which nothing is promised
WorkLimit limit_of(const Work& estimate, double least_evaluations = 1e6);

}  // namespace earthtop
