// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds how far both axes of a symmetric top move with inputs, from differences of whole integrations of the drift in which one
/// input is a little larger or smaller. An integration without the spin, or one that steps over the nutation, is so much cheaper
/// than one of the variational equations in body axes that twenty pairs of them are cheaper too.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/sensitivity.hpp"

namespace earthtop {

/// How the runs are integrated whose differences are taken.
struct DifferenceMethods {
  IntegrationOptions alone;   ///< for the problem itself, and for inputs that add no torque to it
  IntegrationOptions driven;  ///< for inputs that add a torque; not used where `alone` is long_horizon, whose kicks take it up
};

/// The least number of periods of the nutation for which rows of long_horizon tell the largest responses.
inline constexpr double kLeastNutations = 300;

/// The numbers of integrations that a list of inputs takes.
struct DifferenceRuns {
  int alone = 0, driven = 0;
  int all() const { return alone + driven; }
};
DifferenceRuns difference_runs(const DriftProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                               const DifferenceMethods& methods);

/// Whether the differences exist for a problem: it must be of a top symmetric about body axis 3 that keeps a reduced form with
/// every further torque, without a platform, on an Earth that turns, with all its torques.
bool has_drift_differences(const DriftProblem<double>& problem);

/// Returns what drift_sensitivity returns, apart from the derivatives of the drift's own measures, which stay empty. Responses
/// are good to about 1e-4 of themselves.
/// @param problem  as has_drift_differences demands   @param time_s  the time after the release that is covered (s)
/// @param methods  with long_horizon only where the nutation has kLeastNutations periods
/// @param on_step  called at some hundred times
/// @returns nothing if one of the integrations does not come to the end
std::optional<DriftSensitivity> drift_differences(const DriftProblem<double>& problem,
                                                  const std::vector<ProblemDerivative>& inputs, double time_s,
                                                  const DifferenceMethods& methods, const Watch& watch,
                                                  const std::function<void(const FollowedStep&)>& on_step);

}  // namespace earthtop
