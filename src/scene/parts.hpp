// SPDX-License-Identifier: GPL-3.0-or-later
/// How the parts of a scene are computed: a Scene calls each of these once and keeps what it gives.
#pragma once

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

// problem.cpp: from body and release to the model and to the problem that an integration takes, in any precision.
NaturalUnits units_of(const Scene& scene);
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

// pace.cpp: the rates of a scene and how long they last, which decide how many steps its integrations take.
PlatformDemand demand_of(const Scene& scene);
double fastest_rate_of(const Scene& scene);
struct Paced {
  Pace pace;
  StiffFriction stiffest;
};
Paced paced(const Scene& scene);

// method_fit.cpp: which method fits the scene.
ExactKind closed_form_of(const Scene& scene);
std::optional<std::string> refuse_method(Method method, const Scene& scene);
/// How fast both motions and the laboratory turn together (rad/s), without the spin of a top that is symmetric about body axis
/// 3. @param scene  with a closed form
double closed_form_turn_rate_rad_s(const Scene& scene);

// integration_cost.cpp: what one integration costs whose options are known.
IntegrationCost cost_of(const Scene& scene, const IntegrationOptions& options);
/// Seconds for one right-hand side of both predictions and the deviation between them, in double and in the general form, with
/// its share of the stepper.
double general_evaluation_seconds(const Scene& scene);

// method_choice.cpp: the method that "auto" stands for, from what one integration costs with the options of each method.
MethodChoice choose_method(const Scene& scene);

// run_estimate.cpp: what the run costs with the method that was chosen.
RunEstimate estimate_run(const Scene& scene);
void refuse_unaffordable(const Scene& scene);

}  // namespace earthtop
