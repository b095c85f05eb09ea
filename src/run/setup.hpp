/// From a validated scenario to the problem an integration takes, in any precision.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// The given doubles are exact; everything derived from them is computed in T.
template <class T>
DriftProblem<T> make_problem(const Scenario& scenario);
extern template DriftProblem<double> make_problem(const Scenario&);
extern template DriftProblem<long double> make_problem(const Scenario&);
extern template DriftProblem<float128> make_problem(const Scenario&);

}  // namespace earthtop
