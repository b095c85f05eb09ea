// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/scatter.hpp"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "earthtop/measure/measurement.hpp"
#include "plan/plans.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop::testing {
std::vector<ScatterCase> scatter_cases() {
  return {
      {"heavy top", "toy-top", {}, plan_for("axis_rad", 1e-6, 0.02, 1, {"omega_sin_latitude_rad_s", "spin_rad_s", "tilt_deg"})},
      {"friction",
       "toy-top",
       {{"/effects/viscous_torque_N_m_s", "1e-6"}},
       plan_for("axis_rad", 1e-6, 0.02, 1, {"omega_sin_latitude_rad_s", "/effects/viscous_torque_N_m_s", "spin_rad_s"})},
      {"gyrocompass",
       "hard/t08-gyrocompass",
       {{"/release/azimuth_deg", "5"}, {"/site/latitude_deg", "45"}},
       plan_for("azimuth_rad", 1e-6, 0.2, 10, {"omega_cos_latitude_rad_s", "/release/azimuth_deg"})}};
}

Scatter scatter_of(const ScatterCase& what, std::uint64_t sets) {
  const ScenarioSource source = shipped(what.scenario);
  const PlanReport planned = plan_measurement(source, what.set, what.plan);
  if (planned.outcome != PlanOutcome::determined) throw std::runtime_error(planned.reason);
  const TemporaryDirectory directory;
  const std::string file = (directory.path() / "simulated.csv").string();
  Scatter scatter;
  const std::size_t numbers = planned.estimates.size();
  std::vector<double> sums(numbers, 0), squares(numbers, 0);
  for (std::uint64_t seed = 1; seed <= sets; ++seed) {
    std::ofstream(file, std::ios::binary) << *simulated_measurement(source, what.set, what.plan, seed);
    const MeasurementReport fit = compare_with_measurement(source, what.set, read_measurement(file), {what.plan.estimates});
    if (fit.fit != FitOutcome::converged) throw std::runtime_error(fit.fit_reason);
    for (std::size_t j = 0; j < numbers; ++j) {
      const double pull = (*fit.estimates[j].estimate - planned.estimates[j].value) / *planned.estimates[j].standard_error;
      sums[j] += pull;
      squares[j] += pull * pull;
    }
  }
  const auto n = static_cast<double>(sets);
  for (std::size_t j = 0; j < numbers; ++j) {
    const double mean = sums[j] / n;
    scatter.names.push_back(planned.estimates[j].name);
    scatter.mean_pull.push_back(mean);
    scatter.over_prediction.push_back(std::sqrt((squares[j] - n * mean * mean) / (n - 1)));
  }
  return scatter;
}

}  // namespace earthtop::testing
