// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/sensitivity_route.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "drift/derivatives/contact_derivatives.hpp"
#include "earthtop/drift/sensitivity.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/parts.hpp"

namespace earthtop {
namespace {

constexpr double kCheap = 10;         // s: variations that take no longer are not compared with differences
constexpr double kAffordable = 1200;  // s: most that either route may take
constexpr double kRunsAnInput = 8;    // that differences take: three pairs of steps, and one of the fastest phase

}  // namespace

double variations_seconds(const Scene& scene, double time_s, double relative_tolerance, std::size_t inputs) {
  // Measured on toy tops, a body with three different moments, a turntable, a pendulum and a gyrocompass, with and without effects.
  struct Seconds {
    double recording, order;
  };
  constexpr Seconds kOnPivot = {5e-3, 2.2e-6}, kInGimbal = {5e-3, 5.5e-6};
  // Measured on shipped scenes and hard cases on a table, of every law: 1.7 to 4.5e-6 s an order, and 7 to 14e-6 s of any body.
  constexpr Seconds kOnTable = {3.3e-3, 2.9e-6}, kAnyOnTable = {1e-2, 9e-6};
  const bool on_table = scene.scenario().contact.has_value(), symmetric = scene.symmetry_axis() == 2;
  const bool in_gimbal = scene.scenario().effects.applied.gimbal.has_value();
  const Seconds& each = on_table ? (symmetric ? kOnTable : kAnyOnTable) : in_gimbal ? kInGimbal : kOnPivot;
  const double groups = std::ceil(double(inputs) / double(kInputsAtOnce));
  IntegrationOptions series;
  series.method = Method::taylor, series.relative_tolerance = relative_tolerance;
  Pace pace = scene.pace();
  pace.rows = pace.judgement_looks = 0;
  const bool reduced = on_table ? symmetric : !in_gimbal && scene.is_reducible_when_driven();
  const double orders = estimated_work(pace, series, reduced).evaluations;
  return groups * (each.recording + each.order * orders * time_s / scene.scenario().duration_s);
}

Scene scene_for_differences(const Scene& scene) {
  Scenario scenario = scene.scenario();
  const IntegrationOptions given = scene.choice().options;
  const bool fixed = scenario.numerics.step_s.has_value();
  scenario.sensitivities = false;
  scenario.uncertainty.reset();
  scenario.ledger.reset();
  scenario.threshold_rad.reset();
  scenario.accuracy_rad.reset();
  const double finest = default_tolerance(Precision::bits53);
  const bool wider = scenario.precision != Precision::bits53;
  scenario.precision = Precision::bits53;
  double& tolerance = scenario.numerics.relative_tolerance;
  tolerance = wider ? finest : std::min(tolerance, finest);
  if (!fixed && scenario.numerics.method != Method::automatic && !is_built(given.method, Precision::bits53))
    scenario.numerics.method = Method::automatic;
  return resolve(std::move(scenario));
}

Phases phases_until(const Scene& scene, double time_s) {
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  const double momentum = norm(times(inertia, scene.release<double>().w_XB_B));
  const double torque = scene.gravity_torque_N_m(scene.platform_demand().acceleration_m_s2);
  const double pendulum = std::sqrt(torque / inertia.trace() * 3);
  const double precession = torque > 0 ? std::min(pendulum, torque / std::max(momentum, 1e-300)) : 0;
  const double damping = scene.pace_by_rule().damping / scene.scenario().duration_s;
  const double slow = std::max({precession, scene.platform_demand().rate_rad_s, std::min(damping, pendulum)});
  return {slow * time_s, std::max(slow, scene.fastest_rate_rad_s()) * time_s};
}

SensitivityPlan plan_sensitivities(const Scene& scene, double time_s) {
  const Scenario& scenario = scene.scenario();
  SensitivityPlan plan;
  if (!scene.has_drift())
    plan.refusal = "the Earth does not turn: there is no drift";
  else if (time_s == 0)
    plan.refusal = "no row of the drift is reliable";
  if (!plan.refusal.empty()) return plan;
  const std::size_t inputs = inputs_of(scenario).size();
  const bool varied =
      scenario.contact ? has_tangents(scene.problem_without_rows<double>())
                       : scenario.effects.applied.coulomb_N_m == 0 && !scene.support().has_moving_parts() && !scenario.travel;
  if (varied)
    for (const double tolerance : {kSensitivityTolerance, kCoarseSensitivityTolerance})
      plan.seconds += variations_seconds(scene, time_s, tolerance, inputs);
  if (varied && plan.seconds <= kCheap) return plan;
  const Scene moved = scene_for_differences(scene);
  const double differences = double(inputs) * kRunsAnInput * moved.costs()[0].seconds * time_s / scenario.duration_s;
  if (!varied || differences < plan.seconds) plan = {SensitivityRoute::differences, differences, ""};
  if (!(plan.seconds <= kAffordable))
    plan.refusal = fmt::format("they would take {}; at most {} are spent", about_seconds(plan.seconds, kAffordable),
                               about_seconds(kAffordable).substr(6));
  return plan;
}

}  // namespace earthtop
