// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/work.hpp"

#include <algorithm>
#include <cmath>

#include "earthtop/drift/sensitivity.hpp"

namespace earthtop {
namespace {

/// Rough factors of a right-hand side with variations against one of both motions and their deviation, as measured on a toy
/// top, a body of three moments and a gyrocompass.
constexpr double kOfGrowth = 1.2, kOfSensitivities = 4;

/// An embedded Runge-Kutta method in the general form, whose steps no output time cuts.
double embedded_work(Scenario scenario, double time_s, double relative_tolerance) {
  if (!(time_s > 0)) return 0;
  scenario.duration_s = time_s;
  scenario.output_step_s = time_s;
  scenario.precision = Precision::bits53;
  IntegrationOptions options;
  options.method = Method::rkf78;
  options.relative_tolerance = relative_tolerance;
  return integration_work(std::move(scenario), options, ModelForm::general);
}

}  // namespace

double integration_work(Scenario scenario, const IntegrationOptions& options, ModelForm form) {
  scenario.numerics = options;
  // The laboratory's is the observer of which a reduced form is expected.
  scenario.numerics.observer = Observer::laboratory;
  scenario.numerics.form = form == ModelForm::reduced ? ModelForm::automatic : ModelForm::general;
  // A row has its measures, its angles followed, and its place in memory.
  const double rows = (scenario.precision == Precision::bits53 ? 7e-7 : 3e-5) * scenario.duration_s / scenario.output_step_s;
  const double seconds = estimated_seconds(scenario, scenario.numerics) + rows;
  return std::isfinite(seconds) ? seconds : 0;
}

double growth_work(const Scenario& scenario, double time_s, double relative_tolerance) {
  return 2 * kOfGrowth * embedded_work(scenario, time_s, relative_tolerance);
}

double sensitivity_work(const Scenario& scenario, double time_s, double relative_tolerance, std::size_t inputs) {
  const std::size_t groups = (inputs + kInputsAtOnce - 1) / kInputsAtOnce;
  return double(groups) * kOfSensitivities * embedded_work(scenario, time_s, relative_tolerance);
}

}  // namespace earthtop
