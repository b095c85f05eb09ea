// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "earthtop/integrate/motion_integration.hpp"

namespace earthtop {

/// A single motion of a plain symmetric top by its Fourier sum (fourier_top.hpp).
/// A top without one ends as not_converged, without a row.
/// @throws std::logic_error for a model that is not a top symmetric about body axis 3
template <class T>
MotionTrajectory<T> fourier_motion(const MotionProblem<T>& problem, const Watch& watch);

}  // namespace earthtop
