// SPDX-License-Identifier: GPL-3.0-or-later
/// Records the right-hand side of a single motion in a scene with applied torques, a platform, a tide or without one of [F]'s
/// torques. The recording scalar is compiled apart, since it takes long.
#pragma once

#include <span>

#include "earthtop/model/model.hpp"
#include "integrate/driven_axis_equations.hpp"
#include "integrate/taylor/operations.hpp"

namespace earthtop {

/// The equations of any body in body axes (motion_system.hpp).   @param x, t  state and time at which they are recorded
template <class T>
taylor::Operations<T> record_motion(const Model<T>& model, std::span<const T> x, T t);
extern template taylor::Operations<double> record_motion(const Model<double>&, std::span<const double>, double);
extern template taylor::Operations<float80> record_motion(const Model<float80>&, std::span<const float80>, float80);
extern template taylor::Operations<float128> record_motion(const Model<float128>&, std::span<const float128>, float128);

/// The equations of a symmetric top's axis (driven_axis_equations.hpp).
taylor::Operations<double> record_axis_motion(const DrivenAxisEquations<double>& equations, std::span<const double> x,
                                              double t);

}  // namespace earthtop
