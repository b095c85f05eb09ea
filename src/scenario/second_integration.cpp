#include "scenario/second_integration.hpp"

#include <algorithm>

namespace earthtop {

IntegrationOptions second_options(const IntegrationOptions& first, ModelForm form, Precision precision, double phase,
                                  bool dry_friction) {
  IntegrationOptions second = first;
  second.form = form;
  second.step_s.reset();
  const Observer other =
      form == ModelForm::reduced ? Observer::laboratory : Observer::body;  // the reduced form has no body axes
  second.observer = first.observer == Observer::inertial ? other : Observer::inertial;
  if (first.method == Method::closed_form) return second;
  if (dry_friction) second.observer = first.observer;
  const bool unlike = first.method != Method::extrapolation || precision == Precision::bits113;
  second.method = unlike ? Method::extrapolation : Method::rkf78;
  const double asked = first.relative_tolerance;
  const double least = precision == Precision::bits53 ? 1e-13 : least_tolerance(precision);  // of doubles, round-off
  const double finer = std::max(asked / 100, least);
  second.relative_tolerance = finer <= asked / 30 ? finer : std::min(10 * asked, 0.1);
  if (first.step_s || first.method == Method::taylor) second.relative_tolerance = finer;
  constexpr double kAffordable = 3e4;  // rad; a tenth of a second
  if (first.method == Method::long_horizon && phase > kAffordable) {
    second.method = Method::long_horizon;
    second.relative_tolerance = asked;
  }
  return second;
}

}  // namespace earthtop
