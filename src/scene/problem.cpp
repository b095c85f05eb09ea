// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the input of a scene's integrations from its body and its release.
#include "earthtop/model/gyrostat.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {

namespace {

template <class T>
TideSeries<T> tide_series(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const TideSpec& tide = *scenario.effects.tide;
  if (!tide.given)
    return TideSeries<T>::of_bodies(scene.site(), *parse_utc(*scenario.start_utc), scenario.duration_s, tide.options);
  const auto& a = tide.amplitude_m_s2;
  return TideSeries<T>::harmonic(Vec3<T>(T(a[0]), T(a[1]), T(a[2])), T(tide.frequency_hz),
                                 T(tide.phase_deg) * real::pi<T>() / T(180));
}

}  // namespace

/// The journey, in seconds.   @throws ScenarioError  where it cannot be made
template <class T>
Journey<T> journey_of(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  JourneySetting<T> setting;
  setting.site = scene.site();
  setting.earth_rate = T(scene.rotation_rate_rad_s());
  setting.gravity_anomaly = scenario.gravity_anomaly_m_s2;
  setting.duration_s = scenario.duration_s;
  try {
    return Journey<T>(*scenario.travel, setting);
  } catch (const JourneyError& error) {
    throw ScenarioError("/travel", error.what());
  }
}

template <class T>
Platform<T> platform_of(const Scene& scene) {
  const PlatformSpec& platform = *scene.scenario().platform;
  return make_platform<T>(platform, platform.motion == PlatformMotion::course ? journey_of<T>(scene) : Journey<T>());
}
template Platform<double> platform_of(const Scene&);
template Platform<float80> platform_of(const Scene&);
template Platform<float128> platform_of(const Scene&);

/// Puts the laboratory on its journey: in axes that turn with the Earth, or at rest in inertial space where the reference stays.
template <class T>
void put_journey(Model<T>& model, const Journey<T>& journey, const NaturalUnits& units) {
  model.journey = journey.in_time_units(units.time_exponent);
  if (model.kind == SceneKind::plain) model.kind = SceneKind::full;
  if (!model.journey.has_still_reference()) return;
  model.epsilon = model.journey.epsilon();
  model.W_IL_L = model.W_IL_L_scaled = Vec3<T>::Zero();
}

NaturalUnits units_of(const Scene& scene) {
  const bool on_platform = scene.scenario().platform.has_value();
  const Platform<double> platform = on_platform ? platform_of<double>(scene) : Platform<double>();
  NaturalUnits units = natural_units(scene.body<double>(), scene.release<double>(), scene.site().gravity_m_s2,
                                     scene.rotation_rate_rad_s(), on_platform ? &platform : nullptr);
  laws_of(scene).fit_units(scene, units);
  return units;
}

template <class T>
Model<T> model_of(const Scene& scene, const NaturalUnits& units) {
  const Scenario& scenario = scene.scenario();
  const EffectsSpec& effects = scenario.effects;
  const TorqueWeights<T> weights = weights_of<T>(effects);
  const bool on_platform = scenario.platform.has_value();
  const Journey<T> journey = scenario.travel ? journey_of<T>(scene) : Journey<T>();
  const Platform<T> platform = on_platform ? make_platform<T>(*scenario.platform, journey) : Platform<T>();
  auto model = make_model<T>(scene.body<T>(), scene.site(), scene.rotation_rate_rad_s(), weights,
                             on_platform ? &platform : nullptr, units);
  // On a table the gradient of gravitation acts through the contact, with its force.
  if (effects.applied.any() && !scene.support().has_contact) {
    model.applied = make_applied_torques<T>(effects.applied, scene.site(), scene.release<double>().w_XB_B[2],
                                            units.mass_exponent, units.time_exponent);
    put_support(model, effects.applied);
    model.kind = SceneKind::full;
  }
  if (effects.tide) {
    model.tide = tide_series<T>(scene).scaled(units.time_exponent);
    model.kind = SceneKind::full;
  }
  if (scenario.travel) put_journey(model, journey, units);
  if (!scene.support().has_moving_parts()) return model;
  if (scenario.rotor) put_rotor(model, make_rotor<T>(*scenario.rotor), units);
  put_masses(model, scenario.moving_masses, units);
  if (scenario.gimbals) put_gimbals(model, gimbals_of<T>(scenario), units);
  return model;
}
template Model<double> model_of(const Scene&, const NaturalUnits&);
template Model<float80> model_of(const Scene&, const NaturalUnits&);
template Model<float128> model_of(const Scene&, const NaturalUnits&);

template <class T>
Model<T> model_of_rows(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  Model<T> model = scene.model<T>();
  if (!is_caged_top(scenario)) return model;
  const Body<T> body = gyrostat_body(make_body<T>(scenario.body), *scenario.rotor, scenario.rotor->drive != RotorDrive::none);
  model.I_BP_B = body.I_BP_B, model.I_BP_B_inverse = body.I_BP_B_inverse;
  put_rotor(model, make_rotor<T>(*scenario.rotor), {});
  return model;
}
template Model<double> model_of_rows(const Scene&);
template Model<float128> model_of_rows(const Scene&);

template <class T>
DriftProblem<T> problem_of(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  DriftProblem<T> problem;
  problem.release = scene.release<T>();
  problem.units = scene.units();
  problem.model = model_of<T>(scene, problem.units);
  // The given rates are the reference's, relative to its laboratory; those of the problem are relative to the axes of the integration.
  if (scenario.travel)
    problem.release.w_XB_B += problem.units.rate_to_rad_s(
        transposed_times(rotation_matrix(problem.release.q_LB), problem.model.journey.at(JourneyPart::rate, T(0))));
  problem.fastest_rate = problem.units.rate_from_rad_s(T(scene.fastest_rate_rad_s()));
  if (scenario.numerics.stops_beyond_estimate) problem.pace = is_too_short_to_look(scene) ? scene.pace_by_rule() : scene.pace();
  problem.times_s = {0, scenario.duration_s};
  problem.threshold_rad = scenario.threshold_rad;
  laws_in<T>(scene).complete(scene, problem);
  return problem;
}
template DriftProblem<double> problem_of(const Scene&);
template DriftProblem<float80> problem_of(const Scene&);
template DriftProblem<float128> problem_of(const Scene&);

}  // namespace earthtop
