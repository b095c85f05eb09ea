// SPDX-License-Identifier: GPL-3.0-or-later
/// The rate of a rotor as a measured quantity: its bearing's friction is found from it, also where it does not move the axis.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "earthtop/measure/measurement.hpp"
#include "earthtop/plan/plan.hpp"
#include "measure/document.hpp"
#include "support/rotor_scenes.hpp"

namespace earthtop {
namespace {

constexpr double kViscous = 2e-6;

ScenarioSource source_of(const Scenario& s) { return {"g.json", canonical_json(s)}; }

/// The rotor turns against the cage: ds/dt = -k s (1/C + 1/I3), I3 the cage's own moment about the axis.
double rate_in_cage(double t) { return 300 * std::exp(-kViscous * t * (1 / 1.6e-5 + 1 / 1.2e-5)); }

/// Measured rates in revolutions per minute, with no error.
Measurement rates(double (*rate_rad_s)(double)) {
  std::string csv = "t_s,rotor_rate_rpm,rotor_rate_se_rpm\n";
  for (int k = 0; k <= 20; ++k) csv += fmt::format("{},{:.17g},0.5\n", 0.1 * k, rate_rad_s(0.1 * k) * 30 / std::numbers::pi);
  return parse_measurement("rates.csv", csv);
}

TEST(RotorRate, FindsTheFrictionOfABearing) {
  Scenario s = testing::caged_gyroscope();
  s.rotor->viscous_torque_N_m_s = 1e-6;
  MeasurementOptions options;
  options.estimates = {"rotor_viscous_torque_N_m_s"};
  const MeasurementReport report = compare_with_measurement(source_of(s), {}, rates(rate_in_cage), options);
  ASSERT_EQ(report.fit, FitOutcome::converged);
  EXPECT_NEAR(*report.estimates[0].estimate, kViscous, 1e-6 * kViscous);  // where a fit stops
  EXPECT_EQ(report.residuals.front().quantity, "rotor_rate");
  EXPECT_NEAR(report.residuals.front().predicted, 300, 1e-12);  // a rounding
  EXPECT_EQ(measurement_figure(report).panels.front().y.label, "Rate of the rotor");
  const auto document = nlohmann::ordered_json::parse(measurement_json(report));
  EXPECT_TRUE(document.at("residuals").at(0).contains("residual_rad_s"));
  EXPECT_EQ(measure::measurement_of(document).residuals.back().measured, report.residuals.back().measured);
  // In the equations of a gyrostat, with the axis along: the same rate within the error of a double integration.
  const MeasurementReport whole = compare_with_measurement(
      source_of(s), {{"/numerics/model", "\"general\""}, {"/rotor/viscous_torque_N_m_s", "2e-6"}}, rates(rate_in_cage));
  for (const MeasurementResidual& residual : whole.residuals)
    EXPECT_LT(std::abs(residual.residual), 1e-9) << residual.t_s;  // of 300 rad/s, some steps at 1e-12
}

TEST(RotorRate, IsRefusedWithoutARotor) {
  Scenario s = testing::toy_top();
  try {
    compare_with_measurement(source_of(s), {}, rates(rate_in_cage));
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("rotor_rate was measured, and the scenario has no rotor; give it /rotor, or leave the column out"),
              std::string::npos);
  }
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("rotor_rate_rpm", 1)};
  EXPECT_EQ(plan.quantities[0].unit, "rpm");
  plan.every_s = 0.5;
  plan.estimates = {"spin_rad_s"};
  try {
    plan_measurement(source_of(s), {}, plan);
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(
        std::string(error.what()).find("rotor_rate: the scenario has no rotor; give it /rotor, or measure something else"),
        std::string::npos);
  }
  EXPECT_THROW(planned_quantity("rotor_rate_deg", 1), ScenarioError);
}

/// The standard error of the friction from a planned tachometer is that of the fit to its data.
TEST(RotorRate, IsPlannedAsItIsFitted) {
  Scenario s = testing::caged_gyroscope();
  s.rotor->viscous_torque_N_m_s = kViscous;
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("rotor_rate_rpm", 0.5)};
  plan.every_s = 0.1;
  plan.estimates = {"rotor_viscous_torque_N_m_s"};
  const PlanReport planned = plan_measurement(source_of(s), {}, plan);
  MeasurementOptions options;
  options.estimates = plan.estimates;
  const MeasurementReport fitted = compare_with_measurement(source_of(s), {}, rates(rate_in_cage), options);
  ASSERT_EQ(fitted.fit, FitOutcome::converged);
  EXPECT_NEAR(*planned.estimates[0].standard_error, *fitted.estimates[0].standard_error,
              1e-4 * *fitted.estimates[0].standard_error);  // derivatives by differences
}

}  // namespace
}  // namespace earthtop
