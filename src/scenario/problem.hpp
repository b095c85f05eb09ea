// SPDX-License-Identifier: GPL-3.0-or-later
/// From a validated scenario to the problem an integration takes, in any precision.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// The scene's model, in SI units if no others are given.
template <class T>
Model<T> make_model(const Scenario& scenario, const NaturalUnits& units = {});
extern template Model<double> make_model(const Scenario&, const NaturalUnits&);
extern template Model<long double> make_model(const Scenario&, const NaturalUnits&);
extern template Model<float128> make_model(const Scenario&, const NaturalUnits&);

/// The given doubles are exact; everything derived from them is computed in T.
template <class T>
DriftProblem<T> make_problem(const Scenario& scenario);
extern template DriftProblem<double> make_problem(const Scenario&);
extern template DriftProblem<long double> make_problem(const Scenario&);
extern template DriftProblem<float128> make_problem(const Scenario&);

}  // namespace earthtop
