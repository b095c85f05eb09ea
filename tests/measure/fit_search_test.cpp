// SPDX-License-Identifier: GPL-3.0-or-later
/// Fits whose start is far off: a toy gyroscope filmed at 30 frames a second, whose nutation passes the rows' own frequency.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "earthtop/plan/plan.hpp"
#include "measure/made_up_measurements.hpp"

namespace earthtop {
namespace {

constexpr double kRpm = test::kPi / 30;

/// The scenario of a toy gyroscope with air drag.
ScenarioSource toy(double spin_rpm, double disc_radius_m, double lever_m) {
  return {"toy.json", fmt::format(R"({{"name": "toy", "site": {{"latitude_deg": 52, "gravity_m_s2": 9.8128}},
    "body": {{"mass_kg": 0.12, "center_of_mass_m": [0, 0, {}],
              "inertia": {{"about": "center_of_mass", "principal_kg_m2": [2.35e-5, 2.35e-5, 2.4e-5]}}}},
    "release": {{"tilt_deg": 35, "azimuth_deg": 20, "spin_rpm": {}}},
    "effects": {{"viscous_torque_N_m_s": 2e-8, "air_drag": {{"disc_radius_m": {}}}}},
    "motion": {{"duration_s": 12, "output_step_s": 0.1}}}})",
                                  lever_m, spin_rpm, disc_radius_m)};
}

class FitSearchTest : public test::MeasurementTest {
 protected:
  Measurement filmed(const ScenarioSource& source, std::uint64_t seed) const {
    MeasurementPlan plan;
    plan.quantities = {planned_quantity("azimuth_deg", 0.2), planned_quantity("tilt_deg", 0.1)};
    plan.every_s = 1.0 / 30;
    plan.until_s = 12;
    return read(*simulated_measurement(source, {}, plan, seed));
  }
  static MeasurementReport fitted(const ScenarioSource& source, const Measurement& measurement) {
    MeasurementOptions options;
    options.estimates = {"spin_rad_s", "tilt_deg", "/release/azimuth_deg", "/effects/air_drag/disc_radius_m",
                         "/body/center_of_mass_m/2"};
    return compare_with_measurement(source, {}, measurement, options);
  }
};

TEST_F(FitSearchTest, FindsTheMinimumFromAFarStart) {
  const Measurement measurement = filmed(toy(7953, 0.0171, 0.03807), 5);
  const double truth[] = {7953 * kRpm, 35, 20, 0.0171, 0.03807};
  std::vector<double> chi_squared;
  for (const auto& [spin, radius, lever] :
       {std::array{8000.0, 0.02, 0.038}, std::array{7250.0, 0.0155, 0.0387}, std::array{8700.0, 0.018, 0.0375}}) {
    SCOPED_TRACE(spin);
    const MeasurementReport report = fitted(toy(spin, radius, lever), measurement);
    ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
    EXPECT_GT(report.search.spans, 3);
    EXPECT_TRUE(report.agrees());
    for (std::size_t j = 0; j < 5; ++j)
      EXPECT_LT(std::abs(*report.estimates[j].estimate - truth[j]), 4 * *report.estimates[j].standard_error)
          << report.estimates[j].name;
    chi_squared.push_back(report.fitted->value);
  }
  for (const double value : chi_squared) EXPECT_NEAR(value, chi_squared.front(), 1e-4);  // where a fit stops: 1e-6 of it
}

/// The measured precession tells the spin's sign, and its size from any start.
TEST_F(FitSearchTest, BeginsWithTheMeasuredPrecession) {
  const Measurement measurement = filmed(toy(7953, 0.0171, 0.03807), 5);
  for (const double spin : {-8000.0, 5000.0, 12000.0}) {
    SCOPED_TRACE(spin);
    const MeasurementReport report = fitted(toy(spin, 0.02, 0.038), measurement);
    ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
    EXPECT_TRUE(report.agrees());
    EXPECT_LT(std::abs(*report.estimates[0].estimate - 7953 * kRpm), 4 * *report.estimates[0].standard_error);
    EXPECT_EQ(report.search.attempts, 1);
  }
}

/// A film that begins two seconds after the release: attitude and rates there are estimated beside the top's own numbers, which are known.
TEST_F(FitSearchTest, AFreeStartTakesTheMotionAsItIsAtTheFirstRow) {
  Measurement measurement = filmed(toy(7953, 0.0171, 0.03807), 5);
  std::erase_if(measurement.values, [](const MeasuredValue& value) { return value.t_s < 2; });
  const double first_s = measurement.values.front().t_s;
  for (MeasuredValue& value : measurement.values) value.t_s -= first_s;
  MeasurementOptions options;
  options.estimates = with_free_start_estimates({"/effects/air_drag/disc_radius_m", "/body/center_of_mass_m/2"});
  ASSERT_EQ(options.estimates.size(), 7);
  EXPECT_EQ(with_free_start_estimates(options.estimates), options.estimates);
  const ScenarioSource source = with_free_start(toy(7900, 0.018, 0.0379), {{"/release/tilt_deg", "36"}});
  const MeasurementReport report = compare_with_measurement(source, {}, measurement, options);
  ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
  EXPECT_TRUE(report.agrees());
  EXPECT_LT(std::abs(*report.estimates[0].estimate - 0.0171), 4 * *report.estimates[0].standard_error);
  EXPECT_LT(std::abs(*report.estimates[1].estimate - 0.03807), 4 * *report.estimates[1].standard_error);
  EXPECT_EQ(report.estimates[2].start, 36);
  EXPECT_LT(*report.estimates[6].estimate, 7953 * kRpm);  // air has taken some of the spin
}

TEST_F(FitSearchTest, ANearStartIsFittedAtOnce) {
  const MeasurementReport report = fitted(toy(7953, 0.0171, 0.03807), filmed(toy(7953, 0.0171, 0.03807), 5));
  EXPECT_EQ(report.fit, FitOutcome::converged);
  EXPECT_EQ(report.search.spans, 0);
  EXPECT_EQ(report.search.attempts, 1);
}

/// Azimuths that grow the other way: there is no such motion, and no error bar either.
TEST_F(FitSearchTest, AFalseMinimumIsCalledSo) {
  const Measurement right = filmed(toy(7953, 0.0171, 0.03807), 5);
  Measurement mirrored = right;
  for (MeasuredValue& value : mirrored.values)
    if (value.quantity == MeasuredQuantity::azimuth) value.value = std::fmod(2 * test::kPi - value.value, 2 * test::kPi);
  MeasurementOptions options;
  options.estimates = {"tilt_deg", "/release/azimuth_deg"};
  const MeasurementReport report = compare_with_measurement(toy(7953, 0.0171, 0.03807), {}, mirrored, options);
  EXPECT_EQ(report.fit, FitOutcome::false_minimum) << report.fit_reason;
  EXPECT_NE(report.fit_reason.find("more than a quarter turn"), std::string::npos);
  EXPECT_FALSE(report.fitted);
  EXPECT_FALSE(report.agrees());
  for (const ParameterEstimate& estimate : report.estimates) {
    EXPECT_FALSE(estimate.estimate);
    EXPECT_FALSE(estimate.standard_error);
  }
}

}  // namespace
}  // namespace earthtop
