// SPDX-License-Identifier: GPL-3.0-or-later
/// Both motions and the drift between them by closed forms, for the scenes that have them (exact_motion.hpp).
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// Integrates nothing: both motions and the drift at the output times come from closed forms.
///
/// If the two motions are released with the same inertial rate, or on an Earth that stands still, they are one motion in
/// inertial space, seen by a laboratory that turns and by one that does not: the deviation is exp(-[W]x t), or zero. If they
/// are released with the same rate relative to the laboratory, their inertial rates at release differ by W; the effect of that
/// difference is found in 113 bits (rate_change.hpp).
/// @throws std::logic_error for a scene without a closed form
template <class T>
DriftTrajectory<T> closed_form_drift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch);
extern template DriftTrajectory<double> closed_form_drift(const DriftProblem<double>&, const IntegrationOptions&, const Watch&);
extern template DriftTrajectory<float80> closed_form_drift(const DriftProblem<float80>&, const IntegrationOptions&,
                                                           const Watch&);
extern template DriftTrajectory<float128> closed_form_drift(const DriftProblem<float128>&, const IntegrationOptions&,
                                                            const Watch&);

}  // namespace earthtop
