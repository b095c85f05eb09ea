// What "auto" means for a scene.
#include <algorithm>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {
namespace {

/// Whether the scene is a symmetric top that may be integrated without its spin.
bool takes_reduced_form(const Scenario& scenario) {
  const IntegrationOptions& asked = scenario.numerics;
  return asked.form == ModelForm::automatic && !scenario.platform && scenario.effects.all_on() &&
         symmetry_axis(make_body<double>(scenario.body)) >= 0;
}

/// The series are those of the reduced form in laboratory axes, or of any body in its own axes: the same motion, whatever the
/// observer.
IntegrationOptions with_taylor(const Scenario& scenario) {
  IntegrationOptions options = scenario.numerics;
  options.method = Method::taylor;
  options.observer = takes_reduced_form(scenario) ? Observer::laboratory : Observer::body;
  return options;
}

/// Local errors add up over the thousands of steps of a run.
IntegrationOptions with_finer_tolerance(const Scenario& scenario, Method method) {
  IntegrationOptions options = scenario.numerics;
  options.method = method;
  options.relative_tolerance = std::max(options.relative_tolerance / 100, least_tolerance(scenario.precision));
  return options;
}

}  // namespace

MethodChoice method_choice(const Scenario& scenario) {
  const IntegrationOptions& asked = scenario.numerics;
  if (asked.method == Method::taylor) return {with_taylor(scenario), "asked for"};
  if (asked.method != Method::automatic) return {asked, "asked for"};

  if (scenario.precision != Precision::bits53)
    return {with_finer_tolerance(scenario, Method::extrapolation), "its order follows the digits asked for"};
  if (method_refusal(Method::taylor, scenario))
    return {with_finer_tolerance(scenario, Method::rkf78), "a platform or a torque left out: no series is compiled for it"};
  // Who names an observer or the general model wants those equations integrated; in body axes they are what the series is of.
  const bool own_equations = asked.form == ModelForm::general || asked.observer == Observer::inertial;
  if (own_equations && asked.observer != Observer::body)
    return {with_finer_tolerance(scenario, Method::rkf78), "the equations of the observer asked for"};
  if (asked.observer == Observer::laboratory && takes_reduced_form(scenario))
    return {with_taylor(scenario), "a symmetric top, integrated without its spin: Taylor series take the fewest operations"};
  IntegrationOptions options = with_taylor(scenario);
  options.observer = Observer::body;
  options.form = ModelForm::general;
  return {options, "Taylor series of the equations in body axes take the fewest operations"};
}

}  // namespace earthtop
