// SPDX-License-Identifier: GPL-3.0-or-later
/// The reference of the tests: the same scene in 113-bit arithmetic, in the equations of an observer that the caller chooses,
/// and by a method unrelated to that of the rows.
#pragma once

#include <algorithm>
#include <cmath>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop::testing {

inline DriftTrajectory<float128> reference_run(const Scenario& scenario, Observer observer, double tolerance = 1e-20) {
  IntegrationOptions options;
  options.observer = observer;
  options.method = Method::extrapolation;
  options.relative_tolerance = tolerance;
  return integrate_drift(Scene(scenario).problem<float128>(), options);
}

/// The distance of a run's rows from the reference, compared with the run's bounds, over all rows.
struct Comparison {
  double worst_axis_error = 0;      ///< relative to the largest axis drift so far
  double worst_attitude_error = 0;  ///< relative to the largest attitude drift so far
  double least_margin = 1e300;      ///< bound / true error, the smaller of axis and attitude; errors at round-off left out
  double worst_excess = 0;          ///< bound / max(true error, 1e-13 rad, 1e-10 x largest drift so far)
};

inline Comparison compare(const RunResult& result, const DriftTrajectory<float128>& reference) {
  Comparison c;
  double largest_axis = 0, largest_attitude = 0;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const DriftRow& row = result.rows[i];
    const DriftMeasures<float128>& exact = reference.samples.at(i).measures;
    const auto follow = [&](double computed, float128 truth, double bound, double& largest, double& worst) {
      const double error = static_cast<double>(real::abs(static_cast<float128>(computed) - truth));
      largest = std::max(largest, static_cast<double>(truth));
      if (largest > 0) worst = std::max(worst, error / largest);
      if (error > 0) c.least_margin = std::min(c.least_margin, bound / error);
      c.worst_excess = std::max(c.worst_excess, bound / std::max({error, 1e-13, 1e-10 * largest}));
    };
    follow(row.drift_axis_rad, exact.axis, row.drift_axis_bound_rad, largest_axis, c.worst_axis_error);
    follow(row.drift_attitude_rad, exact.attitude, row.drift_attitude_bound_rad, largest_attitude, c.worst_attitude_error);
  }
  return c;
}

}  // namespace earthtop::testing
