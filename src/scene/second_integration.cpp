// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/second_integration.hpp"

#include <algorithm>

namespace earthtop {

IntegrationOptions second_options(const Scene& scene, const IntegrationOptions& first) {
  const Scenario& scenario = scene.scenario();
  const Precision precision = scenario.precision;
  const ModelForm form = scene.form(first);
  IntegrationOptions second = first;
  second.form = form;
  second.step_s.reset();
  if (scenario.contact) {
    // In inertial axes no Coriolis term appears: of all checks on a table this is the least like the laboratory's equations.
    second.observer = first.observer == Observer::inertial ? Observer::laboratory : Observer::inertial;
    second.method = Method::taylor;
    // The second of two series in unlike equations may as well be that of the larger error: the distance is then this error.
    constexpr double kLooser = 10, kFiner = 1e-2, kLoose = 5e-10;
    second.relative_tolerance = first.method == Method::taylor && first.relative_tolerance <= kLoose
                                    ? kLooser * first.relative_tolerance
                                    : std::max(kFiner * first.relative_tolerance, least_tolerance(precision));
    return second;
  }
  const Observer other =
      form == ModelForm::reduced ? Observer::laboratory : Observer::body;  // the reduced form has no body axes
  second.observer = first.observer == Observer::inertial ? other : Observer::inertial;
  if (first.method == Method::closed_form) return second;
  if (first.method == Method::taylor) {
    second.relative_tolerance = std::max(first.relative_tolerance / 1000, least_tolerance(precision));
    return second;
  }
  const bool dry_friction = scenario.effects.applied.coulomb_N_m != 0;
  if (dry_friction) second.observer = first.observer;
  const bool unlike = first.method != Method::extrapolation || precision == Precision::bits113;
  second.method = unlike ? Method::extrapolation : Method::rkf78;
  const double asked = first.relative_tolerance;
  const double least = precision == Precision::bits53 ? 1e-13 : least_tolerance(precision);
  second.relative_tolerance = std::max(asked / 1000, least);
  const bool dearer = precision == Precision::bits64 && second.method == Method::rkf78;
  if ((dearer || dry_friction) && second.relative_tolerance > asked / 30) second.relative_tolerance = std::min(10 * asked, 0.1);
  if (first.method == Method::long_horizon) {
    IntegrationOptions itself = second, series = second;
    itself.method = Method::long_horizon;
    itself.relative_tolerance = asked;
    series.method = Method::taylor;
    series.observer = Observer::laboratory;
    const bool follows = scene.cost(series).seconds < scene.cost(itself).seconds;
    return follows ? series : itself;
  }
  return second;
}

}  // namespace earthtop
