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
  const Observer other =
      form == ModelForm::reduced ? Observer::laboratory : Observer::body;  // the reduced form has no body axes
  second.observer = first.observer == Observer::inertial ? other : Observer::inertial;
  if (first.method == Method::closed_form) return second;
  const bool dry_friction = scenario.effects.applied.coulomb_N_m != 0 && first.method != Method::taylor;
  if (first.method == Method::taylor) {
    second.relative_tolerance = std::max(first.relative_tolerance / 1000, least_tolerance(precision));
    return second;
  }
  if (dry_friction) second.observer = first.observer;
  const bool unlike = first.method != Method::extrapolation || precision == Precision::bits113;
  second.method = unlike ? Method::extrapolation : Method::rkf78;
  const double asked = first.relative_tolerance;
  const double least = precision == Precision::bits53 ? 1e-13 : least_tolerance(precision);
  second.relative_tolerance = std::max(asked / 1000, least);
  const bool dearer = precision == Precision::bits64 && second.method == Method::rkf78;
  if ((dearer || dry_friction) && second.relative_tolerance > asked / 30) second.relative_tolerance = std::min(10 * asked, 0.1);
  constexpr double kAffordable = 3e4;  // rad; takes a tenth of a second
  const double phase = scene.fastest_rate_rad_s() * scenario.duration_s;
  if (first.method == Method::long_horizon && phase > kAffordable) {
    second.method = Method::long_horizon;
    second.relative_tolerance = asked;
  }
  return second;
}

}  // namespace earthtop
