// SPDX-License-Identifier: GPL-3.0-or-later
/// How the non-rotating prediction of a top on a table changes with its inputs: derivatives of axis and tip, without a step of
/// differences.
#pragma once

#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/sensitivity.hpp"

namespace earthtop {

/// The change of the reference per unit of an input's change, in laboratory axes.
struct ContactDerivative {
  Vec3<double> axis_L;
  Vec3<double> tip_L_m;
};
struct ContactDerivatives {
  bool completed = false;               ///< whether `at_s` was reached
  std::vector<ContactDerivative> each;  ///< in the order of the inputs
  StepCounters counters;
};

/// The tolerance of these derivatives: they tell how large a change is, for which a few digits suffice.
inline constexpr double kContactDerivativeTolerance = 1e-4;

/// @param problem  has a table   @param inputs  none with the exact Coulomb law beyond a stop of the slip
/// @param at_s  time of the derivatives, after the release   @param watch  may end the integration early
ContactDerivatives contact_derivatives(const DriftProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                                       double at_s, double relative_tolerance = kContactDerivativeTolerance,
                                       const Watch& watch = {});

/// Whether a motion on a table can be followed with its derivatives: under exact dry friction only where its tip does not slip.
bool has_tangents(const DriftProblem<double>& problem);
/// The problem under a law that has tangents: a top rolls that does so from its release on under exact dry friction.
DriftProblem<double> with_law_of_tangents(const DriftProblem<double>& problem);

/// The change of gravity per radian by which the table is tilted further toward a compass direction. The top is released at the
/// same angles to the table, and seen from it.
/// @param start  on a table whose axes are the laboratory's turned about a horizontal axis with this azimuth, or by nothing
ProblemDerivative table_tilt_change(const Model<double>& model, const ContactRelease<double>& start,
                                    const SinCos<double>& azimuth);

}  // namespace earthtop
