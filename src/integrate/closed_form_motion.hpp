// SPDX-License-Identifier: GPL-3.0-or-later
/// A single motion on the rotating Earth by its closed form (exact_motion.hpp).
#pragma once

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// @throws std::logic_error for a scene without a closed form
template <class T>
MotionTrajectory<T> closed_form_motion(const MotionProblem<T>& problem, const IntegrationOptions& options, const Watch& watch);
extern template MotionTrajectory<double> closed_form_motion(const MotionProblem<double>&, const IntegrationOptions&,
                                                            const Watch&);
extern template MotionTrajectory<float80> closed_form_motion(const MotionProblem<float80>&, const IntegrationOptions&,
                                                             const Watch&);
extern template MotionTrajectory<float128> closed_form_motion(const MotionProblem<float128>&, const IntegrationOptions&,
                                                              const Watch&);

}  // namespace earthtop
