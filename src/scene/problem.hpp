// SPDX-License-Identifier: GPL-3.0-or-later
/// From a scene's body and release to its model and to the problem that an integration takes, in any precision.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

NaturalUnits units_of(const Scene& scene);

/// The scene's model, in SI units if no others are given.
template <class T>
Model<T> model_of(const Scene& scene, const NaturalUnits& units = {});
extern template Model<double> model_of(const Scene&, const NaturalUnits&);
extern template Model<long double> model_of(const Scene&, const NaturalUnits&);
extern template Model<float128> model_of(const Scene&, const NaturalUnits&);

template <class T>
DriftProblem<T> problem_of(const Scene& scene);
extern template DriftProblem<double> problem_of(const Scene&);
extern template DriftProblem<long double> problem_of(const Scene&);
extern template DriftProblem<float128> problem_of(const Scene&);

}  // namespace earthtop
