// SPDX-License-Identifier: GPL-3.0-or-later
/// The closed form of a scenario's motion, if it has one.
#pragma once

#include <functional>

#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// The motion in the laboratory as a function of time (s).
template <class T>
using ExactLaboratoryMotion = std::function<LaboratoryState<T>(T)>;

/// The rotating motion of a scenario: for a body without torque anywhere, and for a symmetric top on an Earth that does not
/// rotate or at one of its poles. Empty for all others, on platforms and with effects switched off.
template <class T>
ExactLaboratoryMotion<T> exact_laboratory_motion(const Scene& scene);
extern template ExactLaboratoryMotion<double> exact_laboratory_motion(const Scene&);
extern template ExactLaboratoryMotion<float80> exact_laboratory_motion(const Scene&);
extern template ExactLaboratoryMotion<float128> exact_laboratory_motion(const Scene&);

}  // namespace earthtop
