// SPDX-License-Identifier: GPL-3.0-or-later
/// How the non-rotating prediction of a top on a table changes with its inputs: derivatives of axis and tip, without a step of
/// differences.
#pragma once

#include <span>
#include <vector>

#include "drift/derivatives/contact_change.hpp"
#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// The change of the reference per unit of an input's change, in laboratory axes.
struct ContactDerivative {
  Vec3<double> axis_L;
  Vec3<double> tip_L_m;
};
struct ContactDerivatives {
  bool completed = false;               ///< whether `at_s` was reached
  std::vector<ContactDerivative> each;  ///< in the order of the changes
  StepCounters counters;
};

/// The tolerance of these derivatives: they tell how large a change is, for which a few digits suffice.
inline constexpr double kContactDerivativeTolerance = 1e-4;

/// @param problem  has a table   @param changes  six at most, none with the exact Coulomb law beyond a stop of the slip
/// @param at_s  time of the derivatives, after the release   @param watch  may end the integration early
ContactDerivatives contact_derivatives(const DriftProblem<double>& problem, std::span<const ContactChange<double>> changes,
                                       double at_s, double relative_tolerance = kContactDerivativeTolerance,
                                       const Watch& watch = {});

}  // namespace earthtop
