// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/scatter.hpp"

#include <cmath>
#include <stdexcept>

#include "earthtop/measure/measurement.hpp"
#include "plan/plans.hpp"

namespace earthtop::testing {
namespace {

MeasurementPlan both_ways() {
  MeasurementPlan plan = plan_for("axis_rad", 1e-5, 0.02, 1, {"spin_rad_s"});
  plan.shared = {"omega_sin_latitude_rad_s", "gravity_m_s2"};
  return plan;
}

}  // namespace

std::vector<ScatterCase> scatter_cases() {
  return {
      {"heavy top",
       "toy-top",
       {{}},
       plan_for("axis_rad", 1e-6, 0.02, 1, {"omega_sin_latitude_rad_s", "spin_rad_s", "tilt_deg"})},
      {"friction",
       "toy-top",
       {{{"/effects/viscous_torque_N_m_s", "1e-6"}}},
       plan_for("axis_rad", 1e-6, 0.02, 1, {"omega_sin_latitude_rad_s", "/effects/viscous_torque_N_m_s", "spin_rad_s"})},
      {"gyrocompass",
       "hard/t08-gyrocompass",
       {{{"/release/azimuth_deg", "5"}, {"/site/latitude_deg", "45"}}},
       plan_for("azimuth_rad", 1e-6, 0.2, 10, {"omega_cos_latitude_rad_s", "/release/azimuth_deg"})},
      {"tilted mount",
       "toy-top",
       {{{"/instrument/turn_east_deg", "-0.3"}, {"/instrument/turn_north_deg", "0.4"}}},
       plan_for({{"azimuth_deg", 0.05}, {"tilt_deg", 0.05}}, 0.05, 2,
                {"/instrument/turn_east_deg", "/instrument/turn_north_deg", "spin_rad_s"}),
       {{"/instrument", "{}"}}},
      {"clock offset",
       "toy-top",
       {{{"/instrument/time_offset_s", "0.004"}}},
       plan_for({{"azimuth_deg", 0.05}, {"tilt_deg", 0.05}}, 0.05, 2, {"/instrument/time_offset_s", "spin_rad_s", "tilt_deg"}),
       {{"/instrument", "{}"}}},
      {"two releases", "toy-top", {{}, {{"/release/spin_rad_s", "-200"}}}, both_ways()}};
}

Scatter scatter_of(const ScatterCase& what, std::uint64_t sets) {
  const ScenarioSource source = shipped(what.scenario);
  std::vector<PlannedRelease> truth;
  for (const Overrides& set : what.releases) truth.push_back({source, set});
  const PlanReport planned = plan_releases(truth, what.plan);
  if (planned.outcome != PlanOutcome::determined) throw std::runtime_error(planned.reason);
  Scatter scatter;
  const std::size_t numbers = planned.estimates.size();
  std::vector<double> sums(numbers, 0), squares(numbers, 0), errors(numbers, 0);
  for (std::uint64_t set = 0; set < sets; ++set) {
    std::vector<MeasuredRelease> releases;
    for (std::size_t r = 0; r < truth.size(); ++r) {
      Overrides from = what.releases[r];
      from.insert(from.end(), what.start.begin(), what.start.end());
      const auto csv = simulated_measurement(source, what.releases[r], what.plan, 1 + set * truth.size() + r);
      releases.push_back({source, from, parse_measurement("simulated.csv", *csv)});
    }
    MeasurementOptions options;
    options.estimates = what.plan.estimates;
    options.shared = what.plan.shared;
    const ReleasesReport fit = compare_releases(releases, options);
    if (fit.fit != FitOutcome::converged) throw std::runtime_error(fit.fit_reason);
    for (std::size_t j = 0; j < numbers; ++j) {
      const PlannedEstimate& known = planned.estimates[j];
      for (const ParameterEstimate& found : fit.estimates) {
        if (found.name != known.name || found.release != known.release) continue;
        const double pull = (*found.estimate - known.value) / *known.standard_error;
        sums[j] += pull;
        squares[j] += pull * pull;
        errors[j] += *found.standard_error / *known.standard_error;
      }
    }
  }
  const auto n = static_cast<double>(sets);
  for (std::size_t j = 0; j < numbers; ++j) {
    const double mean = sums[j] / n;
    scatter.names.push_back(name_in_release(planned.estimates[j].name, planned.estimates[j].release));
    scatter.mean_pull.push_back(mean);
    scatter.over_prediction.push_back(std::sqrt((squares[j] - n * mean * mean) / (n - 1)));
    scatter.fitted_error.push_back(errors[j] / n);
  }
  return scatter;
}

}  // namespace earthtop::testing
