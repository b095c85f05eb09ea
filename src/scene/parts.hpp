// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions that compute the parts of a scene. A Scene calls each of them once and keeps the result. Those that depend on what
/// carries the top are in support_laws.hpp.
#pragma once

#include "earthtop/closed_form/mean_precession.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"
#include "earthtop/scene/top_figures.hpp"

namespace earthtop {

// constants.cpp: the constants that the results depend on, and their sources.
std::vector<Constant> constants_of(const Scene& scene);

// problem.cpp: from body and release to the model and to the problem that an integration takes, in any precision.
NaturalUnits units_of(const Scene& scene);
template <class T>
TorqueWeights<T> weights_of(const EffectsSpec& effects) {
  return {T(effects.coriolis ? 1 : 0), T(effects.transverse ? 1 : 0), T(effects.centrifugal ? 1 : 0)};
}
template <class T>
Model<T> model_of(const Scene& scene, const NaturalUnits& units = {});
extern template Model<double> model_of(const Scene&, const NaturalUnits&);
extern template Model<float80> model_of(const Scene&, const NaturalUnits&);
extern template Model<float128> model_of(const Scene&, const NaturalUnits&);
/// The Cardan suspension of a scenario, which has one, in SI units.
/// The platform of a scene that has one, in seconds.   @throws ScenarioError  where it turns with a journey that cannot be made
template <class T>
Platform<T> platform_of(const Scene& scene);
extern template Platform<double> platform_of(const Scene&);
extern template Platform<float80> platform_of(const Scene&);
extern template Platform<float128> platform_of(const Scene&);

template <class T>
Gimbals<T> gimbals_of(const Scenario& scenario) {
  return make_gimbals<T>(*scenario.gimbals, *scenario.release.gimbals, scenario.moving_masses, scenario.rotor.has_value());
}
/// The model that the rows of a run belong to (SI): that of the scene, which for a rotor in a symmetric cage is the rigid top that moves
/// as its axis does, and then that of cage and rotor.
template <class T>
Model<T> model_of_rows(const Scene& scene);
extern template Model<double> model_of_rows(const Scene&);
extern template Model<float128> model_of_rows(const Scene&);
/// Its times are only the release and the end.
template <class T>
DriftProblem<T> problem_of(const Scene& scene);
extern template DriftProblem<double> problem_of(const Scene&);
extern template DriftProblem<float80> problem_of(const Scene&);
extern template DriftProblem<float128> problem_of(const Scene&);

// method_fit.cpp. The scene must be plain, and its top symmetric about body axis 3.
FourierOutlook fourier_outlook_of(const Scene& scene);
/// Whether it is such a scene, and asks for no other variables: all that is known of its Fourier sums before they are sought.
bool may_have_fourier_sums(const Scene& scene);

// top_figures.cpp: the figures of the body and of its motion without Earth rotation.
TopFigures top_figures_of(const Scene& scene);
/// The constants of the motion of a top that is symmetric about body axis 3, to 113 bits.
BasicTopConstants<float128> top_constants_of(const Scene& scene);

/// The number of times besides its rows at which a run looks at its two integrations, to judge their errors.
inline constexpr int kJudgementLooks = 480;
/// The same for one method: long_horizon takes a step aside for each look.
constexpr int judgement_looks(Method method) { return method == Method::long_horizon ? kJudgementLooks / 8 : kJudgementLooks; }

/// The most times at which a run looks at its motion for pictures and largest values.
inline constexpr int kMostPictureLooks = 24'000;
/// Windows of these looks in a long run: so many in each turn of the precession, but no fewer than these.
inline constexpr double kWindowsATurn = 12, kFewestWindows = 300;
/// Looks at the azimuth for the trend of a symmetric top: so many in each turn of the precession, but no fewer than these; and the turns
/// after which more tell nothing new.
inline constexpr double kTrendLooksATurn = 7.3, kFewestTrendLooks = 560, kTrendTurns = 400;

/// Whether the inertia of a scene's body has the rotor's axial moment: not where the rotor is a free one that is followed by itself.
bool has_axial_moment(const Scene& scene);
/// What masses on given paths add to the rates of a scene, at most: their moment (kg m), their momentum relative to what carries them
/// (kg m^2/s), the rate of their motions (rad/s), and the number of times at which a path has a joint.
struct MassesPace {
  double moment_kg_m = 0, momentum_kg_m2_s = 0, rate_rad_s = 0, joints = 0;
};
MassesPace masses_pace(const Scene& scene);
/// The momentum of a rotor in body axes, as large as its drive makes it (kg m^2/s); 0 without one.
Vec3<double> rotor_momentum(const Scene& scene);
// pace.cpp: the rates of a scene and how long they last, which decide how many steps its integrations take.
PlatformDemand demand_of(const Scene& scene);
struct Paced {
  Pace pace;
  StiffFriction stiffest;
};
// stretches.cpp: the same for a body in a gimbal or on a platform, whose steps no rate at release tells: stretches of the motion are
// integrated, by the methods of the run, and the pace says how many steps they took against what the rule finds.
Pace pace_as_seen(const Scene& scene);
/// Returns whether a carried scene is so short that looking at it would take a large part of a run, and that the limit of a run's
/// work is far above it in any case.
bool is_too_short_to_look(const Scene& scene);

// method_fit.cpp: which method fits the scene.
ExactKind closed_form_of(const Scene& scene);
std::optional<std::string> refuse_method(Method method, const Scene& scene);

// integration_cost.cpp: the cost of one integration with given options.
IntegrationCost cost_of(const Scene& scene, const IntegrationOptions& options);
/// Returns the options of an integration in double that is made for looks between the rows: by the method of a run if it can look at any
/// time, otherwise by series, or by the run's method in scenes that have no series. Where looks by long_horizon are more work than
/// a series over the whole run, that takes its place.
/// @param first  of the run's first integration
/// @param asides  how many of the looks take a step aside by long_horizon
IntegrationOptions options_for_looks(const Scene& scene, const IntegrationOptions& first, double looks, double asides);
/// Returns about how often a run looks at its motion for pictures.
double picture_looks(const Scene& scene);
/// Returns the time (s) of an integration for these looks.
double seconds_looking(const Scene& scene, const IntegrationOptions& first);
/// Returns the time (s) of one right-hand side of both predictions and the deviation between them, in double and in the general
/// form, including its share of the stepper.
double general_evaluation_seconds(const Scene& scene);

// run_estimate.cpp: the cost of the run with the chosen method.
RunEstimate estimate_run(const Scene& scene);
/// Returns about how many times the motions of a run are held in memory for, at its rows and between them.
/// @param between  whether the run looks between its rows
double times_held(const Scene& scene, bool between);
/// The most of these times that runs side by side hold together: some 150 MB.
inline constexpr double kMostTimesHeld = 200'000;
void refuse_unaffordable(const Scene& scene);

}  // namespace earthtop
