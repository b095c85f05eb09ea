// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates the drift of a top on a table. It is compiled apart from that of a top on a fixed pivot.
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// `integrate_drift` for a problem with a table: in the laboratory's or in inertial axes, by taylor, extrapolation or, in double,
/// rkf78; a symmetric body without its angle of spin unless the general form is asked for.
/// @throws std::logic_error for another observer or method
template <class T>
DriftTrajectory<T> integrate_contact(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch);
extern template DriftTrajectory<double> integrate_contact(const DriftProblem<double>&, const IntegrationOptions&, const Watch&);
extern template DriftTrajectory<float80> integrate_contact(const DriftProblem<float80>&, const IntegrationOptions&,
                                                           const Watch&);
extern template DriftTrajectory<float128> integrate_contact(const DriftProblem<float128>&, const IntegrationOptions&,
                                                            const Watch&);

}  // namespace earthtop
