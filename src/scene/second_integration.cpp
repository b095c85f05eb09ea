// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/second_integration.hpp"

#include <algorithm>

#include "scene/support_laws.hpp"

namespace earthtop {

IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first) {
  IntegrationOptions second = first;
  second.form = scene.form(first);
  second.step_s.reset();
  return laws_of(scene).second_options(scene, first, second);
}

namespace {

/// The second integration by steps.
IntegrationOptions stepping_check(const Scene& scene, const IntegrationOptions& first, IntegrationOptions second) {
  const Scenario& scenario = scene.scenario();
  const Precision precision = scenario.precision;
  const Observer other =
      second.form == ModelForm::reduced ? Observer::laboratory : Observer::body;  // the reduced form has no body axes
  second.observer = first.observer == Observer::inertial ? other : Observer::inertial;
  if (is_exact(first.method)) return second;
  // Against a laboratory at rest the laboratory's and the inertial observer's axes are the same (journey.hpp).
  if (scenario.travel && scenario.travel->reference == TravelReference::at_rest && !scene.support().has_gimbals) {
    second.form = ModelForm::general;
    second.observer = first.observer == Observer::body ? Observer::inertial : Observer::body;
  }
  if (first.method == Method::taylor) {
    second.relative_tolerance = std::max(first.relative_tolerance / 1000, least_tolerance(precision));
    return second;
  }
  const bool smooth = !scene.method_refusal(Method::taylor);
  if (scenario.effects.applied.coulomb_N_m != 0 && !smooth) second.observer = first.observer;
  const bool all_on = scenario.effects.all_on();
  if (!all_on) second.observer = Observer::laboratory;
  const Method checks_extrapolation = smooth                            ? Method::taylor
                                      : precision == Precision::bits113 ? Method::extrapolation
                                                                        : Method::rkf78;
  second.method = first.method == Method::extrapolation ? checks_extrapolation : Method::extrapolation;
  const double least = precision == Precision::bits53 && all_on ? 1e-13 : least_tolerance(precision);
  second.relative_tolerance = std::max(first.relative_tolerance / 1000, least);
  if (first.method == Method::long_horizon) {
    IntegrationOptions itself = second, series = second;
    itself.method = Method::long_horizon;
    itself.relative_tolerance = first.relative_tolerance;
    series.method = Method::taylor;
    series.observer = Observer::laboratory;
    constexpr double kUnnoticed = 0.1;  // s
    const double least_s = scenario.numerics.method == Method::long_horizon ? kUnnoticed : 0;
    return scene.cost(series).seconds < std::max(least_s, scene.cost(itself).seconds) ? series : itself;
  }
  return second;
}

}  // namespace

IntegrationOptions PivotLaws::second_options(const Scene& scene, const IntegrationOptions& first,
                                             IntegrationOptions second) const {
  const IntegrationOptions stepping = stepping_check(scene, first, second);
  constexpr double kNoticed_s = 0.02, kGain = 2;
  const bool is_double = scene.scenario().precision == Precision::bits53;
  if (is_exact(first.method) || !is_double || !may_have_fourier_sums(scene)) return stepping;
  const double seconds = scene.cost(stepping).seconds;
  if (!(seconds > kNoticed_s) || scene.method_refusal(Method::fourier)) return stepping;
  IntegrationOptions sums = scene.scenario().numerics;
  sums.method = Method::fourier;
  return kGain * scene.cost(sums).seconds < seconds ? sums : stepping;
}

std::optional<IntegrationOptions> looser_second_options(const Scene& scene, const IntegrationOptions& first,
                                                        const IntegrationOptions& failed) {
  constexpr double kLooser = 100, kLoosest = 0.1;
  IntegrationOptions second = failed;
  second.relative_tolerance = std::min(kLooser * first.relative_tolerance, kLoosest);
  if (scene.scenario().effects.applied.coulomb_N_m == 0 || !(second.relative_tolerance > failed.relative_tolerance)) return {};
  return second;
}

}  // namespace earthtop
