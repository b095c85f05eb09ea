// SPDX-License-Identifier: GPL-3.0-or-later
/// Both motions and the drift between them by closed forms, for the scenes that have them (exact_motion.hpp).
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Matched in inertial rates, or on an Earth that stands still, both motions are one, seen by a laboratory that turns and by
/// one that does not: the deviation is exp(-[W]x t), or nothing. Matched in the laboratory their inertial rates at release
/// differ by W, and what that makes of the motion is found in 113 bits (rate_change.hpp).
/// @throws std::logic_error for a scene without a closed form
template <class T>
DriftTrajectory<T> closed_form_drift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch);
extern template DriftTrajectory<double> closed_form_drift(const DriftProblem<double>&, const IntegrationOptions&, const Watch&);
extern template DriftTrajectory<long double> closed_form_drift(const DriftProblem<long double>&, const IntegrationOptions&,
                                                               const Watch&);
extern template DriftTrajectory<float128> closed_form_drift(const DriftProblem<float128>&, const IntegrationOptions&,
                                                            const Watch&);

}  // namespace earthtop
