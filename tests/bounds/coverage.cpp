// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "bounds/table_truth.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"
#include "run/drift_bound.hpp"
#include "run/rows.hpp"

namespace earthtop::testing {
namespace {

Quaternion<float128> quaternion(const std::array<float128, 4>& q) { return {q[0], Vec3<float128>(q[1], q[2], q[3])}; }
double angle_between(const std::array<float128, 4>& p, const std::array<float128, 4>& q) {
  const Quaternion<float128> d = quaternion(p).conjugate() * quaternion(q);
  return static_cast<double>(float128(2) * real::atan2(norm(d.v), real::abs(d.w)));
}

/// A row with all its digits if the run keeps them in extended precision.
ExtendedDriftRow judged_row(const RunResult& result, std::size_t i) {
  return result.extended_rows.empty() ? row_cast<float128>(result.rows[i]) : result.extended_rows[i];
}

TrueRun truth_of(const Scenario& scenario, Truth truth, std::size_t rows) {
  if (scenario.contact) return rows < 2 ? TrueRun{} : truth_on_table(scenario, truth == Truth::bits113, rows);
  constexpr double kAffordable = 4e3;  // rad
  IntegrationOptions options;
  options.observer = Observer::body;
  options.form = ModelForm::general;
  options.method = Method::extrapolation;
  options.relative_tolerance = 1e-22;
  const bool wide = truth == Truth::bits113 || scenario.precision != Precision::bits53;
  if (wide && Scene(scenario).fastest_rate_rad_s() * scenario.duration_s < kAffordable)
    return integrate_truth<float128>(scenario, options);
  options.relative_tolerance = least_tolerance(Precision::bits64);
  if (!Scene(scenario).method_refusal(Method::taylor)) {
    options.method = Method::taylor;
    if (is_reducible(Scene(scenario).problem<float80>().model)) {
      options.observer = Observer::laboratory;
      options.form = ModelForm::automatic;
    }
    options.relative_tolerance = 1e-18;
  }
  return integrate_truth<float80>(scenario, options);
}

double distance(float128 a, float128 b) { return static_cast<double>(real::abs(a - b)); }
double distance(const std::array<float128, 2>& a, const std::array<float128, 2>& b) {
  return static_cast<double>(real::hypot(a[0] - b[0], a[1] - b[1]));
}

}  // namespace

Coverage coverage_of(const RunResult& result, const TrueRun& truth) {
  Coverage coverage;
  coverage.method = result.solution.method;
  coverage.verdict = result.verdict;
  constexpr double kRoundOffUnits = 1024;
  const double round_off = kRoundOffUnits * epsilon_of(result.scene.scenario().precision);
  const auto include = [&](BoundedError& part, double error, double bound) {
    if (error < kTruthError) error = 0;
    part.error = std::max(part.error, error);
    part.bound = std::max(part.bound, bound);
    if (error > 0) coverage.used = std::max(coverage.used, error / bound);
  };
  for (std::size_t i = 0; i < std::min(truth.rows.size(), result.rows.size()); ++i) {
    const DriftRow& row = result.rows[i];
    if (!row.drift_reliable) {
      // On a table a later row may be reliable again.
      if (row.contact) continue;
      break;
    }
    const ExtendedDriftRow judged = judged_row(result, i), &exact = truth.rows[i];
    include(coverage.axis, distance(judged.drift_axis_rad, exact.drift_axis_rad), row.drift_axis_bound_rad);
    include(coverage.attitude, distance(judged.drift_attitude_rad, exact.drift_attitude_rad), row.drift_attitude_bound_rad);
    include(coverage.states, angle_between(judged.q_LB, exact.q_LB), result.attitude_bound_rad);
    include(coverage.states, angle_between(judged.ref_q_LB, exact.ref_q_LB), result.attitude_bound_rad);
    coverage.drift = static_cast<double>(exact.drift_axis_rad);
    coverage.round_off = std::max(coverage.round_off, round_off * static_cast<double>(exact.drift_attitude_rad));
    ++coverage.rows;
    if (!row.contact) continue;
    include(coverage.tip, distance(judged.contact->drift_tip_xy_m, exact.contact->drift_tip_xy_m),
            row.contact->drift_tip_bound_m);
    coverage.tip_drift = static_cast<double>(exact.contact->drift_tip_m);
  }
  if (!result.contact) return coverage;
  for (const ContactEvent& event : result.contact->events)
    for (const ContactEvent& exact : truth.events)
      if (event.kind == exact.kind && event.prediction == exact.prediction && event.bound_s)
        include(coverage.event, std::abs(event.t_s - exact.t_s), *event.bound_s);
  return coverage;
}

Coverage bound_coverage(const Scenario& scenario, Truth truth) {
  const RunResult result = run(scenario);
  if (result.status != RunStatus::completed) throw std::runtime_error("no run: " + std::string(to_string(result.status)));
  constexpr double kNear = 0.3;
  const Coverage coverage = coverage_of(result, truth_of(scenario, truth, result.rows.size()));
  if (truth == Truth::bits113 || coverage.used <= kNear) return coverage;
  return coverage_of(result, truth_of(scenario, Truth::bits113, result.rows.size()));
}

}  // namespace earthtop::testing
