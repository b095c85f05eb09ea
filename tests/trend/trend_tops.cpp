// SPDX-License-Identifier: GPL-3.0-or-later
#include "trend/trend_tops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/drift/drift_integration.hpp"
#include "run/trend.hpp"

namespace earthtop::testing {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// The trend from one integration at a loose tolerance, without bounds and verdict.
std::optional<SecularDrift> trend_of(const Scenario& scenario) {
  const Scene scene(scenario);
  const TrendPlan plan = plan_trend(scene);
  if (plan.times_s.empty()) return std::nullopt;
  DriftProblem<double> problem = scene.problem<double>();
  problem.times_s = plan.times_s;
  IntegrationOptions options;
  options.method = Method::taylor;
  options.relative_tolerance = 1e-12;
  options.observer = Observer::laboratory;
  if (!takes_reduced_form(problem.model, options)) options.observer = Observer::body, options.form = ModelForm::general;
  const DriftTrajectory<double> trajectory = integrate_drift(problem, options);
  RunResult result;
  result.scene = result.modelled = scene;
  result.reached_s = result.verdict.reliable_until_s = scenario.duration_s;
  std::vector<AzimuthSample> azimuths;
  for (const DriftSample<double>& sample : trajectory.samples) {
    azimuths.push_back(azimuth_sample(sample));
    DriftRow row;
    row.t_s = sample.state.t_s;
    row.axis_L = row.ref_axis_L = {1, 0, 0};
    if (sample.measures.azimuth_defined) row.drift_azimuth_rad = sample.azimuth;
    result.looks.push_back(row);
  }
  std::optional<SecularDrift> trend = assess_trend(result, plan, azimuths);
  if (trend && !trend->azimuth_rate_rad_s) trend.reset();
  return trend;
}

}  // namespace

std::optional<Scenario> random_trend_top(std::uint64_t index, double most_phase) {
  Random random(77'000 + index);
  Scenario s;
  s.name = "trend-" + std::to_string(index);
  s.site = {random.uniform(-90, 90), 0, 0, random.uniform(9.76, 9.84)};
  s.rotation_rate_rad_s = kEarthRateWgs84 * (random.coin() ? 1 : random.log_uniform(1, 1e3));
  const bool hangs = random.uniform(0, 1) < 0.25;
  s.release.tilt_deg = hangs ? random.uniform(95, 175) : random.uniform(5, 85);
  s.release.azimuth_deg = random.uniform(-180, 180);
  s.release.spin_angle_deg = random.uniform(-180, 180);
  s.release.rates_relative_to = random.coin() ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  const double size = random.log_uniform(1e-5, 1e-3), mass = random.log_uniform(0.02, 1), l = random.log_uniform(5e-3, 5e-2);
  const double across = size * random.log_uniform(0.05, 1), along = size * random.log_uniform(0.05, 1);
  double other = across;
  const double kind = random.uniform(0, 1);
  if (kind < 0.1) other *= 1 + random.log_uniform(1e-3, 1e-1);
  if (kind > 0.95) other *= random.uniform(1.1, 2.5);
  s.body.mass_kg = mass;
  set_principal(s.body, other + along, across + along, across + other);
  s.body.inertia_about = InertiaAbout::center_of_mass;
  s.body.center_of_mass_m = {0, 0, l};
  const double mgl = mass * s.site.gravity_m_s2 * l, I1 = (across + other) / 2 + along + mass * l * l, I3 = across + other;
  const double critical = 2 * std::sqrt(I1 * mgl) / I3;
  const bool slow = random.uniform(0, 1) < 0.25;
  s.release.spin_rad_s =
      (random.coin() ? 1 : -1) * critical * (slow ? random.log_uniform(0.2, 1.2) : random.log_uniform(1.2, 20));
  const double precession = random.uniform(0, 1);
  if (precession > 0.75 || (precession > 0.45 && across != other)) {
    s.release.precession = Precession::given;
    s.release.precession_rate_rad_s = std::sqrt(mgl / I1) * random.uniform(-1.5, 1.5);
  } else if (precession > 0.45) {
    s.release.precession = precession > 0.6 ? Precession::steady_fast : Precession::steady_slow;
  }
  const double turns = random.log_uniform(1, 30);
  try {
    Scenario symmetric = s;  // of which the rate of precession is known
    set_principal(symmetric.body, across / 2 + other / 2 + along, across / 2 + other / 2 + along, across + other);
    symmetric.duration_s = symmetric.output_step_s = 1;
    const Scene scene(symmetric);
    const TrendPlan plan = plan_trend(scene);
    if (!plan.frequencies) return std::nullopt;
    s.duration_s = turns * kTurn / std::abs(plan.frequencies->precession_rad_s);
    if (s.duration_s * scene.fastest_rate_rad_s() > most_phase) return std::nullopt;
  } catch (const ScenarioError&) {  // a spin too slow for steady precession
    return std::nullopt;
  }
  s.output_step_s = s.duration_s / 20;
  return s;
}

std::optional<TrendJudged> judge_trend(const Scenario& scenario, double times) {
  const RunResult result = run(scenario);
  if (result.status != RunStatus::completed || result.verdict.verdict != Verdict::reliable) return std::nullopt;
  if (!result.drift.secular || !result.drift.secular->azimuth_rate_rad_s) return std::nullopt;
  Scenario longer = scenario;
  longer.duration_s *= times;
  longer.output_step_s *= times;
  const std::optional<SecularDrift> truth = trend_of(longer);
  // Where both bounds are what rounding leaves, the longer run's may be the larger one by a little.
  constexpr double kAlike = 2;
  if (!truth || *truth->azimuth_rate_bound_95_rad_s > kAlike * *result.drift.secular->azimuth_rate_bound_95_rad_s)
    return std::nullopt;
  TrendJudged judged{*result.drift.secular, {}, *truth->azimuth_rate_rad_s, *truth->azimuth_rate_bound_95_rad_s};
  if (!result.theory.empty()) judged.theory = result.theory.front();
  return judged;
}

}  // namespace earthtop::testing
