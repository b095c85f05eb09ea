// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/problem.hpp"

#include "scenario/pace.hpp"

namespace earthtop {

namespace {

template <class T>
TideSeries<T> tide_series(const Scenario& scenario) {
  const TideSpec& tide = *scenario.effects.tide;
  if (!tide.given)
    return TideSeries<T>::of_bodies(scenario.site, *parse_utc(*scenario.start_utc), scenario.duration_s, tide.options);
  const auto& a = tide.amplitude_m_s2;
  return TideSeries<T>::harmonic(Vec3<T>(T(a[0]), T(a[1]), T(a[2])), T(tide.frequency_hz),
                                 T(tide.phase_deg) * real::pi<T>() / T(180));
}

}  // namespace

template <class T>
Model<T> make_model(const Scenario& scenario, const NaturalUnits& units) {
  const EffectsSpec& effects = scenario.effects;
  const TorqueWeights<T> weights{T(effects.coriolis ? 1 : 0), T(effects.transverse ? 1 : 0), T(effects.centrifugal ? 1 : 0)};
  const bool on_platform = scenario.platform.has_value();
  const Platform<T> platform = on_platform ? make_platform<T>(*scenario.platform) : Platform<T>();
  const auto body = make_body<T>(scenario.body);
  auto model =
      make_model<T>(body, scenario.site, scenario.rotation_rate_rad_s, weights, on_platform ? &platform : nullptr, units);
  if (effects.applied.any()) {
    const auto release = make_release<double>(scenario.release, make_body<double>(scenario.body), scenario.site.gravity_m_s2);
    model.applied =
        make_applied_torques<T>(effects.applied, scenario.site, release.w_XB_B[2], units.mass_exponent, units.time_exponent);
    model.kind = SceneKind::full;
  }
  if (effects.tide) {
    model.tide = tide_series<T>(scenario).scaled(units.time_exponent);
    model.kind = SceneKind::full;
  }
  return model;
}
template Model<double> make_model(const Scenario&, const NaturalUnits&);
template Model<long double> make_model(const Scenario&, const NaturalUnits&);
template Model<float128> make_model(const Scenario&, const NaturalUnits&);

template <class T>
DriftProblem<T> make_problem(const Scenario& scenario) {
  const Site& site = scenario.site;
  const auto body = make_body<T>(scenario.body);
  const auto body_double = make_body<double>(scenario.body);
  const auto release_double = make_release<double>(scenario.release, body_double, site.gravity_m_s2);
  const bool on_platform = scenario.platform.has_value();
  const Platform<double> platform_double = on_platform ? make_platform<double>(*scenario.platform) : Platform<double>();

  DriftProblem<T> problem;
  problem.release = make_release<T>(scenario.release, body, T(site.gravity_m_s2));
  problem.units = natural_units(body_double, release_double, site.gravity_m_s2, scenario.rotation_rate_rad_s,
                                on_platform ? &platform_double : nullptr);
  problem.model = make_model<T>(scenario, problem.units);
  problem.fastest_rate = problem.units.rate_from_rad_s(T(fastest_rate_rad_s(scenario)));
  if (scenario.numerics.stops_beyond_estimate) problem.pace = pace_of(scenario);
  problem.times_s = output_times(scenario.duration_s, scenario.output_step_s);
  problem.threshold_rad = scenario.threshold_rad;
  return problem;
}
template DriftProblem<double> make_problem(const Scenario&);
template DriftProblem<long double> make_problem(const Scenario&);
template DriftProblem<float128> make_problem(const Scenario&);

}  // namespace earthtop
