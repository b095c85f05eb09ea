// SPDX-License-Identifier: GPL-3.0-or-later
// The method that "auto" stands for in a scene.
#include <algorithm>
#include <cmath>

#include "drift/long_horizon/long_horizon_work.hpp"
#include "scene/second_integration.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {
namespace {

/// Returns options for the Taylor series. Series exist for the reduced form in laboratory axes and for any body in body axes;
/// the motion is the same for every observer, so the observer is set to one of these.
IntegrationOptions with_taylor(const Scene& scene) {
  IntegrationOptions options = scene.scenario().numerics;
  options.method = Method::taylor;
  if (options.observer == Observer::inertial) options.observer = Observer::laboratory;
  if (scene.form(options) != ModelForm::reduced) options.observer = Observer::body;
  return options;
}

/// Returns options with a tolerance `times` finer, because local errors add up over the thousands of steps of a run.
IntegrationOptions with_finer_tolerance(const Scene& scene, Method method, double times) {
  IntegrationOptions options = scene.scenario().numerics;
  options.method = method;
  options.relative_tolerance = std::max(options.relative_tolerance / times, least_tolerance(scene.scenario().precision));
  return options;
}

/// Returns the estimated time of both integrations of a run (s).
double seconds_with(const Scene& scene, const IntegrationOptions& options) {
  return scene.cost(options).seconds + scene.cost(second_options(scene, options)).seconds;
}

/// Returns whether the long-horizon method pays. Its bound was 16 to 100,000 times as wide as that of a series, over 20 gyroscopes: so
/// the run has to be several times as fast, with its looks, which a series has for nothing; and its error a small part of the drift, as
/// predicted. The number of output rows has no part in it: they change no digit of a series.
bool has_long_horizon(const Scene& given) {
  constexpr double kGain = 2.5, kRows = 200, kOfDrift = 1e-4;
  if (given.method_refusal(Method::long_horizon)) return false;
  Scenario usual = given.scenario();
  usual.output_step_s = usual.duration_s / kRows;
  const Scene scene = usual.output_step_s == given.scenario().output_step_s ? given : resolve(usual);
  IntegrationOptions options = scene.scenario().numerics;
  options.method = Method::long_horizon;
  const LongHorizonDriftWork expected = long_horizon_drift_work(scene.problem_without_rows<double>(), options, kRows - 1);
  return expected.error_rad <= kOfDrift * expected.drift_rad &&
         kGain * (seconds_with(scene, options) + seconds_looking(scene, options)) < seconds_with(scene, with_taylor(scene));
}

/// Returns whether Fourier sums pay: found and evaluated, for the rows and for looks between them, in a part of the time of `other`. They
/// are only sought where that is long enough to be noticed: most of a short run's time is not that of its integrations.
bool has_fourier_sums(const Scene& scene, const IntegrationOptions& other) {
  constexpr double kGain = 2, kNoticed_s = 0.06;
  const double seconds = seconds_with(scene, other) + seconds_looking(scene, other);
  if (!(seconds > kNoticed_s) || scene.method_refusal(Method::fourier)) return false;
  IntegrationOptions options = scene.scenario().numerics;
  options.method = Method::fourier;
  return kGain * (seconds_with(scene, options) + seconds_looking(scene, options)) < seconds;
}

}  // namespace

bool has_cheap_closed_form(const Scene& scene) { return scene.is_one_motion() && !scene.method_refusal(Method::closed_form); }

MethodChoice PivotLaws::choose_method(const Scene& scene) const {
  const Scenario& scenario = scene.scenario();
  IntegrationOptions asked = scenario.numerics;
  const bool series = !scene.method_refusal(Method::taylor);
  if (scenario.effects.applied.coulomb_N_m != 0 &&
      !(series && (asked.method == Method::taylor || asked.method == Method::automatic))) {
    asked.observer = Observer::body;  // in body axes the state of a motion at rest is simplest
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
            scenario.effects.all_on() ? "drag may brake a rate to zero: no series passes that corner"
                                      : "one of the non-inertial torques is left out, which no series allows"};
  // A user who names an observer or the general model wants these equations integrated; for body axes the series does so.
  const bool own_equations = asked.form == ModelForm::general || asked.observer == Observer::inertial;
  if (own_equations && asked.observer != Observer::body)
    return {with_finer_tolerance(scene, Method::rkf78, 100), "the equations of the observer asked for"};
  if (asked.observer == Observer::laboratory && has_cheap_closed_form(scene)) {
    IntegrationOptions options = asked;
    options.method = Method::closed_form;
    return {options, "the motion is known in closed form"};
  }
  const bool steps_over = has_long_horizon(scene);
  IntegrationOptions over = asked;
  over.method = Method::long_horizon;
  if (may_have_fourier_sums(scene) && has_fourier_sums(scene, steps_over ? over : with_taylor(scene))) {
    IntegrationOptions options = asked;
    options.method = Method::fourier;
    return {options, "a heavy symmetric top over many turns: its two motions are Fourier sums, which need no steps"};
  }
  if (steps_over) return {over, "a fast symmetric top over many nutations: exact flows step over them"};
  if (asked.observer == Observer::laboratory && scene.form(with_taylor(scene)) == ModelForm::reduced)
    return {with_taylor(scene), "a symmetric top, integrated without its spin: Taylor series take the fewest operations"};
  IntegrationOptions options = with_taylor(scene);
  options.observer = Observer::body;
  options.form = ModelForm::general;
  return {options, "Taylor series of the equations in body axes take the fewest operations"};
}

ModelForm PivotLaws::form(const Scene& scene, const IntegrationOptions& options) const {
  const bool reducible = scene.is_reducible() || (options.method == Method::taylor && scene.is_reducible_when_driven());
  return takes_reduced_form(reducible, options) ? ModelForm::reduced : ModelForm::general;
}

}  // namespace earthtop
