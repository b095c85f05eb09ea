// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/table_checks.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {
namespace {

constexpr double kChange = 1e-6;

/// A release whose attitude is turned and whose rate is changed by vectors in the table's axes.
Release<double> changed(const Release<double>& release, const Vec3<double>& turn, const Vec3<double>& rate) {
  const Vec3<double> w = times(rotation_matrix(release.q_LB), release.w_XB_B);
  Release<double> made = release;
  made.q_LB = (Quaternion<double>{1, turn / 2}.normalized() * release.q_LB).normalized();
  made.w_XB_B = transposed_times(rotation_matrix(made.q_LB), Vec3<double>(w + rate));
  return made;
}

std::vector<DriftSample<double>> followed(const DriftProblem<double>& problem, IntegrationOptions options) {
  options.relative_tolerance = 1e-13;
  return integrate_drift(problem, options).samples;
}
Vec3<double> axis(const DriftSample<double>& sample) {
  const auto& n = sample.contact->axis_L;
  return {n[0].ref, n[1].ref, n[2].ref};
}

}  // namespace

Agreement agreement(const Scenario& scenario) {
  Scenario other = scenario;
  other.numerics.observer = Observer::inertial;
  const RunResult a = run(scenario), b = run(other);
  if (a.status != RunStatus::completed || b.status != RunStatus::completed) throw std::runtime_error("no run");
  Agreement agreement;
  const auto include = [](double& part, double distance, double bound) {
    if (distance > 0) part = std::max(part, distance / bound);
  };
  for (std::size_t i = 1; i < std::min(a.rows.size(), b.rows.size()); ++i) {
    const DriftRow &p = a.rows[i], &q = b.rows[i];
    if (!p.drift_reliable || !q.drift_reliable) continue;
    ++agreement.rows;
    include(agreement.axis, std::abs(p.drift_axis_rad - q.drift_axis_rad),
            std::max(p.drift_axis_bound_rad, q.drift_axis_bound_rad));
    include(agreement.attitude, std::abs(p.drift_attitude_rad - q.drift_attitude_rad),
            std::max(p.drift_attitude_bound_rad, q.drift_attitude_bound_rad));
    const auto &x = p.contact->drift_tip_xy_m, &y = q.contact->drift_tip_xy_m;
    include(agreement.tip, std::hypot(x[0] - y[0], x[1] - y[1]),
            std::max(p.contact->drift_tip_bound_m, q.contact->drift_tip_bound_m));
  }
  return agreement;
}

GrowthCheck growth_check(const Scenario& scenario) {
  constexpr int kRows = 400;
  constexpr double kSettlingPath = 3;
  const Scene scene(scenario);
  DriftProblem<double> problem = scene.problem<double>();
  problem.times_s.clear();
  for (int i = 0; i <= kRows; ++i) problem.times_s.push_back(scenario.duration_s * i / kRows);
  const IntegrationOptions options = scene.choice().options;
  const auto base = followed(problem, options);
  GrowthCheck check;
  check.estimate = contact_growth(problem, base.back().state.t_s);
  const double rate = norm(problem.release.w_XB_B);
  std::vector<double> grown(base.size());
  for (const ContactDisturbance& direction : kContactDisturbances) {
    DriftProblem<double> near = problem;
    near.release = changed(problem.release, kChange * direction.turn(), kChange * rate * direction.rate());
    const auto moved = followed(near, options);
    grown.resize(std::min(grown.size(), moved.size()));
    for (std::size_t i = 0; i < grown.size(); ++i) {
      const double spin = moved[i].contact->spin.ref - base[i].contact->spin.ref;
      const double apart = norm(Vec3<double>(axis(moved[i]) - axis(base[i])));
      grown[i] = std::max(grown[i], std::hypot(apart, spin / problem.units.rate_from_rad_s(rate)) / kChange);
    }
  }
  double path = kSettlingPath;
  for (std::size_t i = 1; i < grown.size(); ++i) {
    path += norm(Vec3<double>(axis(base[i]) - axis(base[i - 1])));
    check.largest_ratio = std::max(check.largest_ratio, grown[i] / path);
    check.largest = std::max(check.largest, grown[i]);
  }
  return check;
}

}  // namespace earthtop::testing
