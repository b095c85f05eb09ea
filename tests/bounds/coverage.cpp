#include "bounds/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "scenario/problem.hpp"

namespace earthtop::testing {
namespace {

struct Truth {
  double axis, attitude;
};

template <class T>
std::vector<Truth> integrate_truth(const Scenario& scenario, const IntegrationOptions& options) {
  const auto trajectory = integrate_drift(make_problem<T>(scenario), options);
  if (trajectory.status != RunStatus::completed)
    throw std::runtime_error("no truth: " + std::string(to_string(trajectory.status)));
  std::vector<Truth> truths;
  for (const auto& sample : trajectory.samples)
    truths.push_back({static_cast<double>(sample.measures.axis), static_cast<double>(sample.measures.attitude)});
  return truths;
}

std::vector<Truth> truth_of(const Scenario& scenario) {
  constexpr double kAffordable = 4e3;  // rad
  IntegrationOptions options;
  options.observer = Observer::body;
  options.form = ModelForm::general;
  options.method = Method::extrapolation;
  options.relative_tolerance = 1e-22;
  if (fastest_rate_rad_s(scenario) * scenario.duration_s < kAffordable) return integrate_truth<float128>(scenario, options);
  options.observer = Observer::laboratory;
  options.form = ModelForm::automatic;
  options.method = Method::taylor;
  options.relative_tolerance = 1e-18;
  return integrate_truth<long double>(scenario, options);
}

}  // namespace

Coverage bound_coverage(const Scenario& scenario) {
  const RunResult result = run(scenario);
  if (result.status != RunStatus::completed) throw std::runtime_error("no run: " + std::string(to_string(result.status)));
  const std::vector<Truth> truth = truth_of(scenario);
  Coverage coverage;
  coverage.method = result.solution.method;
  coverage.verdict = result.verdict;
  for (std::size_t i = 0; i < truth.size() && result.rows[i].drift_reliable; ++i) {
    const DriftRow& row = result.rows[i];
    const double axis = std::abs(row.drift_axis_rad - truth[i].axis),
                 attitude = std::abs(row.drift_attitude_rad - truth[i].attitude);
    const auto share = [](double error, double bound) { return error == 0 ? 0 : error / bound; };
    coverage.used =
        std::max({coverage.used, share(axis, row.drift_axis_bound_rad), share(attitude, row.drift_attitude_bound_rad)});
    coverage.error = std::max(coverage.error, axis);
    coverage.attitude_error = std::max(coverage.attitude_error, attitude);
    coverage.bound = row.drift_axis_bound_rad;
    coverage.attitude_bound = row.drift_attitude_bound_rad;
    coverage.drift = truth[i].axis;
  }
  const auto tight = [](double error, double bound) { return error < 1e-13 || error > 0.01 * bound; };
  coverage.tight = tight(coverage.error, coverage.bound) && tight(coverage.attitude_error, coverage.attitude_bound);
  return coverage;
}

}  // namespace earthtop::testing
