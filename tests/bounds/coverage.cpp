// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {
namespace {

/// The values of a row that are judged.
struct JudgedRow {
  float128 axis, attitude;
  Quaternion<float128> q_LB, ref_q_LB;
};

template <class T>
Quaternion<float128> widened(const Quaternion<T>& q) {
  const auto wide = [](const T& x) { return static_cast<float128>(x); };
  return {wide(q.w), Vec3<float128>(wide(q.v[0]), wide(q.v[1]), wide(q.v[2]))};
}
template <class T>
Quaternion<float128> widened(const std::array<T, 4>& q) {
  return widened(Quaternion<T>{q[0], Vec3<T>(q[1], q[2], q[3])});
}
double angle_between(const Quaternion<float128>& p, const Quaternion<float128>& q) {
  const Quaternion<float128> d = p.conjugate() * q;
  return static_cast<double>(float128(2) * real::atan2(norm(d.v), real::abs(d.w)));
}

/// A row's values, with all their digits if the run keeps them in extended precision.
JudgedRow judged_row(const RunResult& result, std::size_t i) {
  const auto judged = [](const auto& r) {
    return JudgedRow{float128(r.drift_axis_rad), float128(r.drift_attitude_rad), widened(r.q_LB), widened(r.ref_q_LB)};
  };
  return result.extended_rows.empty() ? judged(result.rows[i]) : judged(result.extended_rows[i]);
}

template <class T>
std::vector<JudgedRow> integrate_truth(const Scenario& scenario, const IntegrationOptions& options) {
  const auto trajectory = integrate_drift(Scene(scenario).problem<T>(), options);
  if (trajectory.status != RunStatus::completed)
    throw std::runtime_error("no truth: " + std::string(to_string(trajectory.status)));
  std::vector<JudgedRow> truths;
  for (const auto& sample : trajectory.samples)
    truths.push_back({float128(sample.measures.axis), float128(sample.measures.attitude),
                      widened(sample.state.q_LB.normalized()), widened(sample.state.ref_q_LB.normalized())});
  return truths;
}

std::vector<JudgedRow> truth_of(const Scenario& scenario, Truth truth) {
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
    if (is_reducible(Scene(scenario).problem<long double>().model)) {
      options.observer = Observer::laboratory;
      options.form = ModelForm::automatic;
    }
    options.relative_tolerance = 1e-18;
  }
  return integrate_truth<long double>(scenario, options);
}

Coverage judge(const RunResult& result, const std::vector<JudgedRow>& truths) {
  Coverage coverage;
  coverage.method = result.solution.method;
  coverage.verdict = result.verdict;
  // The truth is not exact either: where a gimbal holds a wheel that does not drift at all, it drifts by the rounding of 113 bits.
  constexpr double kTruthError = 1e-24;
  const auto include = [&](BoundedError& part, double error, double bound) {
    if (error < kTruthError) error = 0;
    part.error = std::max(part.error, error);
    part.bound = bound;
    if (error > 0) coverage.used = std::max(coverage.used, error / bound);
  };
  const auto distance = [](float128 a, float128 b) { return static_cast<double>(real::abs(a - b)); };
  for (std::size_t i = 0; i < truths.size() && result.rows[i].drift_reliable; ++i) {
    const DriftRow& row = result.rows[i];
    const JudgedRow judged = judged_row(result, i);
    include(coverage.axis, distance(judged.axis, truths[i].axis), row.drift_axis_bound_rad);
    include(coverage.attitude, distance(judged.attitude, truths[i].attitude), row.drift_attitude_bound_rad);
    include(coverage.states, angle_between(judged.q_LB, truths[i].q_LB), result.attitude_bound_rad);
    include(coverage.states, angle_between(judged.ref_q_LB, truths[i].ref_q_LB), result.attitude_bound_rad);
    coverage.drift = static_cast<double>(truths[i].axis);
  }
  return coverage;
}

}  // namespace

Coverage bound_coverage(const Scenario& scenario, Truth truth) {
  const RunResult result = run(scenario);
  if (result.status != RunStatus::completed) throw std::runtime_error("no run: " + std::string(to_string(result.status)));
  constexpr double kNear = 0.3;
  const Coverage coverage = judge(result, truth_of(scenario, truth));
  if (truth == Truth::bits113 || coverage.used <= kNear) return coverage;
  return judge(result, truth_of(scenario, Truth::bits113));
}

}  // namespace earthtop::testing
