// SPDX-License-Identifier: GPL-3.0-or-later
/// The closed form of a scenario's motion, where it has one.
#pragma once

#include <functional>

#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The motion in the laboratory at a time (s).
template <class T>
using ExactLaboratoryMotion = std::function<LaboratoryState<T>(T)>;

/// The rotating motion of a scenario: of a body without torque anywhere, and of a symmetric top on an Earth that stands still
/// or at one of its poles. Empty for all others, on platforms and with switched-off effects.
template <class T>
ExactLaboratoryMotion<T> exact_laboratory_motion(const Scene& scene);
extern template ExactLaboratoryMotion<double> exact_laboratory_motion(const Scene&);
extern template ExactLaboratoryMotion<long double> exact_laboratory_motion(const Scene&);
extern template ExactLaboratoryMotion<float128> exact_laboratory_motion(const Scene&);

}  // namespace earthtop
