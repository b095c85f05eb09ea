// SPDX-License-Identifier: GPL-3.0-or-later
/// Problems in which one input is a little larger or smaller, for differences of whole integrations.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/sensitivity.hpp"

namespace earthtop {

/// Whether an input adds a torque to those of gravity and of [F].
bool adds_torque(const ProblemDerivative& d);

/// Whether an input changes the Earth's rate and nothing else.
bool changes_rate_only(const ProblemDerivative& d);

/// The centrifugal torque w x (S w) = -w x (Theta w), in the form of a gradient's torque k u x (Theta u) in units of w^2.
ProblemDerivative centrifugal_as_gradient(const Vec3<double>& W_L);

/// The problem in which one input is larger by h.   @param d  derivatives of the problem by the input; its tide is not added
DriftProblem<double> moved(const DriftProblem<double>& problem, const ProblemDerivative& d, double h);

}  // namespace earthtop
