// SPDX-License-Identifier: GPL-3.0-or-later
// The method that "auto" stands for in a scene.
#include <algorithm>

#include "scene/parts.hpp"

namespace earthtop {
namespace {

/// The series are those of the reduced form in laboratory axes, or of any body in its own axes: the same motion, whatever the
/// observer.
IntegrationOptions with_taylor(const Scene& scene) {
  IntegrationOptions options = scene.scenario().numerics;
  options.method = Method::taylor;
  if (options.observer == Observer::inertial) options.observer = Observer::laboratory;
  if (scene.form(options) != ModelForm::reduced) options.observer = Observer::body;
  return options;
}

/// Local errors add up over the thousands of steps of a run.
IntegrationOptions with_finer_tolerance(const Scene& scene, Method method, double times) {
  IntegrationOptions options = scene.scenario().numerics;
  options.method = method;
  options.relative_tolerance = std::max(options.relative_tolerance / times, least_tolerance(scene.scenario().precision));
  return options;
}

/// Seconds for both integrations of a top without its spin, as if the second were like the first; a flow and a kick take as
/// long as 20 right-hand sides.
double seconds_with(const Scene& scene, const IntegrationOptions& options) {
  constexpr double kSecondsAnEvaluation = 1.5e-7, kKick = 20;
  const double each = options.method == Method::long_horizon ? kKick : 1;
  return 2 * kSecondsAnEvaluation * each * scene.cost(options).work.evaluations;
}

/// Where the difference of the two motions is a turn of the laboratory, closed forms cost their calls; elsewhere digits that
/// only 113 bits have.
bool has_cheap_closed_form(const Scene& scene) { return scene.is_one_motion() && !scene.method_refusal(Method::closed_form); }

/// The exact flows between kicks pay where the nutations are so many that to follow them takes long.
bool has_long_horizon(const Scene& scene) {
  constexpr double kWorthwhile_s = 0.3, kGain = 3;
  if (scene.method_refusal(Method::long_horizon)) return false;
  IntegrationOptions options = scene.scenario().numerics;
  const double following = seconds_with(scene, with_taylor(scene));
  options.method = Method::long_horizon;
  return following > kWorthwhile_s && kGain * seconds_with(scene, options) < following;
}

}  // namespace

MethodChoice choose_method(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  IntegrationOptions asked = scenario.numerics;
  if (scenario.effects.applied.coulomb_N_m != 0) {
    asked.observer = Observer::body;  // whose state a motion at rest is simplest in
    asked.form = ModelForm::general;
    if (asked.method == Method::automatic) {
      asked.method = scenario.precision == Precision::bits113 ? Method::extrapolation : Method::rkf78;
      return {asked, "dry friction: short steps end where a motion comes to rest; in body axes"};
    }
    return {asked, "asked for; in body axes, where dry friction can hold a motion at rest"};
  }
  if (asked.method == Method::taylor) return {with_taylor(scene), "asked for"};
  if (asked.method != Method::automatic) return {asked, "asked for"};

  if (scenario.precision != Precision::bits53)
    return {with_finer_tolerance(scene, Method::extrapolation, 100), "its order follows the digits asked for"};
  if (scene.method_refusal(Method::taylor))
    return {with_finer_tolerance(scene, Method::dop853, 10),
            "a platform, a torque left out or one applied: no series is compiled for it"};
  // Who names an observer or the general model wants those equations integrated; in body axes they are what the series is of.
  const bool own_equations = asked.form == ModelForm::general || asked.observer == Observer::inertial;
  if (own_equations && asked.observer != Observer::body)
    return {with_finer_tolerance(scene, Method::rkf78, 100), "the equations of the observer asked for"};
  if (asked.observer == Observer::laboratory && has_cheap_closed_form(scene)) {
    IntegrationOptions options = asked;
    options.method = Method::closed_form;
    return {options, "the motion is known in closed form"};
  }
  if (has_long_horizon(scene)) {
    IntegrationOptions options = asked;
    options.method = Method::long_horizon;
    return {options, "a fast symmetric top over many nutations: exact flows step over them"};
  }
  if (asked.observer == Observer::laboratory && scene.form(asked) == ModelForm::reduced)
    return {with_taylor(scene), "a symmetric top, integrated without its spin: Taylor series take the fewest operations"};
  IntegrationOptions options = with_taylor(scene);
  options.observer = Observer::body;
  options.form = ModelForm::general;
  return {options, "Taylor series of the equations in body axes take the fewest operations"};
}

}  // namespace earthtop
