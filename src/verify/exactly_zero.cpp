// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that must be exactly 0, in all their bits.
#include <cmath>

#include "verify/judge.hpp"

namespace earthtop::verify_detail {
namespace {

bool is_plus_zero(double x) { return x == 0 && !std::signbit(x); }

int nonzero_drifts(const DriftRow& row) {
  int count = row.q_LB == row.ref_q_LB && row.w_LB_B == row.ref_w_LB_B ? 0 : 1;
  for (const double drift : {row.drift_axis_rad, row.drift_axis_bound_rad, row.drift_azimuth_rad.value_or(0),
                             row.drift_tilt_rad, row.drift_attitude_rad, row.drift_attitude_bound_rad, row.drift_spin_rad})
    count += !is_plus_zero(drift);
  return count;
}
int nonzero_axis_drifts(const DriftRow& row) {
  return (row.drift_axis_rad != 0) + (row.drift_tilt_rad != 0) + (row.drift_azimuth_rad.value_or(0) != 0);
}
/// Counts deviations of the reference axis from the vertical; a vertical axis has no azimuth.
int nonzero_reference_tilts(const DriftRow& row) {
  return (row.ref_axis_L[0] != 0) + (row.ref_axis_L[1] != 0) + row.drift_azimuth_rad.has_value();
}

/// The scene with every method, and in every observer's equations, that the scene and its precision allow.
std::vector<Scene> by_all_methods(const Scenario& scenario) {
  std::vector<Scene> scenes;
  for (const MethodRow& row : kMethodRows)
    for (const Observer observer : {Observer::laboratory, Observer::body, Observer::inertial})
      for (const ModelForm form : {ModelForm::automatic, ModelForm::general}) {
        Scenario varied = scenario;
        varied.numerics.method = row.method;
        varied.numerics.observer = observer;
        varied.numerics.form = form;
        if (row.step_s == Need::required) varied.numerics.step_s = varied.output_step_s / 50;
        Scene scene = resolve(std::move(varied));
        if (is_built(row.method, scenario.precision) && !scene.method_refusal()) scenes.push_back(std::move(scene));
      }
  return scenes;
}

}  // namespace

double exactly_zero_error(const CriterionSpec& criterion, Runs& runs) {
  int count = 0;
  if (criterion.quantity == "axis_drift") {
    for (const DriftRow& row : runs.run(criterion.set).rows) count += nonzero_axis_drifts(row);
    return count;
  }
  const auto count_of = criterion.quantity == "drift" ? nonzero_drifts : nonzero_reference_tilts;
  for (const Scene& scene : by_all_methods(runs.scene(criterion.set).scenario()))
    for (const DriftRow& row : completed_run(scene, runs.next_watch()).rows) count += count_of(row);
  return count;
}

}  // namespace earthtop::verify_detail
