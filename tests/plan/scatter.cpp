// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/scatter.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

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
      {"two releases", "toy-top", {{}, {{"/release/spin_rad_s", "-200"}}}, both_ways()},
      {"rates of a phone",
       "asymmetric-top",
       {{}},
       plan_for({{"w_IB_B_x_rad_s", 0.05}, {"w_IB_B_y_rad_s", 0.05}, {"w_IB_B_z_rad_s", 0.05}}, 0.02, 2,
                {"/body/inertia/principal_kg_m2/1", "spin_rad_s", "/instrument/w_x_bias_rad_s"}),
       {{"/instrument", "{}"}}},
      {"turning points",
       "hard/t08-gyrocompass",
       {{{"/release/azimuth_deg", "5"}, {"/site/latitude_deg", "45"}, {"/effects/gimbal", R"({"damping_N_m_s": 2e-6})"}}},
       plan_for("azimuth_turning_deg", 0.01, 12.342, 200,
                {"/instrument/azimuth_zero_deg", "/release/azimuth_deg", "/effects/gimbal/damping_N_m_s"}),
       {{"/instrument", "{}"}}},
      {"passages of a stopwatch",
       "steady-precession-slow",
       {{{"/effects/viscous_torque_N_m_s", "4e-6"}}},
       plan_for("passage_s", 0.05, 2.6, 26, {"spin_rad_s", "/effects/viscous_torque_N_m_s"})}};
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

void expect_scatter_as_planned(const std::string& name) {
  for (const ScatterCase& what : scatter_cases()) {
    if (what.name != name) continue;
    const Scatter scatter = scatter_of(what, 1000);
    for (std::size_t j = 0; j < scatter.names.size(); ++j) {
      const std::string number = name + ' ' + scatter.names[j];
      fmt::print("{}: scatter {:.4f} of the planned one, mean {:+.4f} planned errors, fitted error {:.4f} of it\n", number,
                 scatter.over_prediction[j], scatter.mean_pull[j], scatter.fitted_error[j]);
      EXPECT_NEAR(scatter.fitted_error[j], 1, 0.05) << number;  // planned at the truth, fitted next to it
      EXPECT_NEAR(scatter.over_prediction[j], 1, 0.08) << number;
      EXPECT_NEAR(scatter.mean_pull[j], 0, 0.1) << number;
    }
    return;
  }
  FAIL() << "no case " << name;
}

}  // namespace earthtop::testing
