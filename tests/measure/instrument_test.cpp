// SPDX-License-Identifier: GPL-3.0-or-later
/// An instrument between the motion and the numbers: a balanced gyroscope on an Earth that turns fast, read by an instrument whose
/// formulas are written here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "earthtop/plan/plan.hpp"
#include "measure/made_up_measurements.hpp"

namespace earthtop {
namespace {

using test::kDegree;

constexpr double kRate = 0.1;  // of the Earth, rad/s

/// The circles, the clock and the mount of an instrument.
struct Made {
  double azimuth_zero_deg = 0, azimuth_sense = 1, tilt_zero_deg = 0, tilt_sense = 1;
  Vec3<double> turn_deg = Vec3<double>::Zero();
  double time_offset_s = 0, clock_rate = 1;
};

class InstrumentTest : public test::MeasurementTest {
 protected:
  static test::Overrides on_a_fast_earth(test::Overrides more = {}) {
    more.insert(more.begin(), {"/earth/rotation_rate_rad_s", fmt::format("{}", kRate)});
    return more;
  }

  /// Readings every 0.7 s from the clock's 2.1 s on, with normal errors of the size `noise` of a standard error.
  Measurement readings(const Made& made, double noise = 0, std::uint64_t seed = 1, double error_deg = 0.05) const {
    std::string csv = "t_s,azimuth_deg,azimuth_se_deg,tilt_deg,tilt_se_deg\n";
    test::Normal normal(seed);
    for (int k = 3; k < 83; ++k) {
      const double shown_s = 0.7 * k, t_s = (shown_s - made.time_offset_s) / made.clock_rate;
      Vec3<double> n = test::free_axis(test::kEast, kRate * std::cos(45 * kDegree), kRate * std::sin(45 * kDegree), t_s);
      const double angle = made.turn_deg.norm() * kDegree;
      if (angle > 0) n = Eigen::AngleAxisd(angle, made.turn_deg.normalized()) * n;
      csv += fmt::format(
          "{:.17g},{:.17g},{},{:.17g},{}\n", shown_s,
          made.azimuth_zero_deg + made.azimuth_sense * test::azimuth(n) / kDegree + noise * error_deg * normal(), error_deg,
          made.tilt_zero_deg + made.tilt_sense * test::tilt(n) / kDegree + noise * error_deg * normal(), error_deg);
    }
    return read(csv);
  }

  static MeasurementReport compared(const Measurement& measurement, const test::Overrides& overrides,
                                    const std::vector<std::string>& estimates = {}, bool priors = false) {
    MeasurementOptions options;
    options.estimates = estimates;
    options.priors = priors;
    return compare_with_measurement(test::shipped("free-gyro"), on_a_fast_earth(overrides), measurement, options);
  }
};

TEST_F(InstrumentTest, ReadsAsItsFormulasSay) {
  const Made made{179.5, -1, 90, -1, {0.4, -0.3, 0.2}, 1.3, 1.01};
  const MeasurementReport report = compared(readings(made), {{"/instrument/azimuth_zero_deg", "179.5"},
                                                             {"/instrument/azimuth_reversed", "true"},
                                                             {"/instrument/tilt_zero_deg", "90"},
                                                             {"/instrument/tilt_reversed", "true"},
                                                             {"/instrument/turn_east_deg", "0.4"},
                                                             {"/instrument/turn_north_deg", "-0.3"},
                                                             {"/instrument/turn_up_deg", "0.2"},
                                                             {"/instrument/time_offset_s", "1.3"},
                                                             {"/instrument/clock_rate", "1.01"}});
  ASSERT_EQ(report.residuals.size(), 160);
  for (const MeasurementResidual& residual : report.residuals)
    EXPECT_LT(std::abs(residual.residual), test::kComputed) << residual.t_s << ' ' << residual.quantity;
}

TEST_F(InstrumentTest, HoldsTheTopBeforeItsRelease) {
  const MeasurementReport report = compared(readings({}), {{"/instrument/time_offset_s", "10"}});
  for (const MeasurementResidual& residual : report.residuals)
    if (residual.t_s <= 10) EXPECT_NEAR(residual.predicted, 90 * kDegree, test::kComputed);
  EXPECT_GT(std::abs(report.residuals.back().predicted - 90 * kDegree), 0.1);
}

TEST_F(InstrumentTest, NoMotionDependsOnIt) {
  const ScenarioSource source = test::shipped("free-gyro");
  const Scene plain = parse_scene(source, {}), read = parse_scene(source, {{"/instrument/time_offset_s", "1"}});
  EXPECT_EQ(plain.sha256(), read.sha256());
  EXPECT_EQ(parse_scene({"copy.json", canonical_json(read.scenario())}).scenario().instrument, read.scenario().instrument);
}

TEST_F(InstrumentTest, ItsNumbersAreEstimated) {
  const Made made{.tilt_zero_deg = 4, .turn_deg = {0.4, -0.3, 0}, .time_offset_s = 0.2, .clock_rate = 1.002};
  const MeasurementReport report =
      compared(readings(made, 1), {},
               {"/instrument/tilt_zero_deg", "/instrument/turn_east_deg", "/instrument/turn_north_deg",
                "/instrument/time_offset_s", "/instrument/clock_rate"});
  ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
  const double truth[] = {4, 0.4, -0.3, 0.2, 1.002};
  for (std::size_t j = 0; j < 5; ++j) {
    const ParameterEstimate& estimate = report.estimates[j];
    EXPECT_LT(std::abs(*estimate.estimate - truth[j]), 4 * *estimate.standard_error) << estimate.name;
    EXPECT_LT(*estimate.standard_error, 0.1) << estimate.name;
  }
}

/// The pulls of simulated sets have the standard deviation 1: 40 here, of a mount that is tilted and a clock that is late.
TEST_F(InstrumentTest, ErrorsAreWhatTheyAreSaidToBe) {
  const Made made{.turn_deg = {0.4, -0.3, 0}, .time_offset_s = 0.2};
  double squares = 0;
  constexpr int kSets = 40;
  for (int seed = 1; seed <= kSets; ++seed) {
    const MeasurementReport report =
        compared(readings(made, 1, static_cast<std::uint64_t>(seed)), {{"/instrument/time_offset_s", "0.15"}},
                 {"/instrument/turn_east_deg", "/instrument/turn_north_deg", "/instrument/time_offset_s"});
    ASSERT_EQ(report.fit, FitOutcome::converged);
    const double truth[] = {0.4, -0.3, 0.2};
    for (std::size_t j = 0; j < 3; ++j)
      squares += std::pow((*report.estimates[j].estimate - truth[j]) / *report.estimates[j].standard_error, 2);
  }
  // A mean of 120 squares of normal numbers has the standard deviation sqrt(2/120) = 0.13.
  EXPECT_NEAR(squares / (3 * kSets), 1, 4 * std::sqrt(2.0 / (3 * kSets)));
}

TEST_F(InstrumentTest, WhatIsKnownBeforehandEnters) {
  const Measurement measurement = readings({.time_offset_s = 0.2}, 1);
  const std::vector<std::string> offset = {"/instrument/time_offset_s"};
  const MeasurementReport free = compared(measurement, {}, offset);
  const double error = *free.estimates[0].standard_error;
  const MeasurementReport known =
      compared(measurement, {{"/instrument/time_offset_s", "0.2"}, {"/instrument/time_offset_se_s", fmt::format("{}", error)}},
               offset, true);
  ASSERT_EQ(known.priors.size(), 1);
  EXPECT_EQ(known.priors[0].name, "/instrument/time_offset_s");
  // Its fifth digit is that of differences, its third that of where a fit stops.
  EXPECT_NEAR(*known.estimates[0].standard_error, error / std::sqrt(2), 1e-3 * error);
  const MeasurementReport other =
      compared(measurement, {{"/instrument/clock_rate_se", "0.001"}, {"/instrument/time_offset_se_s", "1"}}, offset, true);
  ASSERT_EQ(other.unused_priors.size(), 1);
  EXPECT_EQ(other.unused_priors[0].name, "/instrument/clock_rate");
}

TEST_F(InstrumentTest, IsPlannedAsItIsFitted) {
  MeasurementPlan plan;
  plan.quantities = {planned_quantity("azimuth_deg", 0.05), planned_quantity("tilt_deg", 0.05)};
  plan.every_s = 0.7;
  plan.until_s = 56;
  plan.estimates = {"/instrument/turn_east_deg"};
  plan.nuisances = {"/instrument/turn_north_deg", "/instrument/time_offset_s"};
  const test::Overrides set = on_a_fast_earth({{"/instrument/turn_east_deg", "0.4"}, {"/instrument/time_offset_s", "-0.2"}});
  const PlanReport planned = plan_measurement(test::shipped("free-gyro"), set, plan);
  const auto data = simulated_measurement(test::shipped("free-gyro"), set, plan, 3);
  ASSERT_TRUE(data);
  const MeasurementReport report =
      compared(read(*data), {}, {"/instrument/turn_east_deg", "/instrument/turn_north_deg", "/instrument/time_offset_s"});
  ASSERT_EQ(report.fit, FitOutcome::converged);
  EXPECT_LT(std::abs(*report.estimates[0].estimate - 0.4), 4 * *report.estimates[0].standard_error);
  // Planned at the true numbers, fitted at those of noisy data.
  EXPECT_NEAR(*planned.estimates[0].standard_error, *report.estimates[0].standard_error,
              0.05 * *report.estimates[0].standard_error);
}

TEST_F(InstrumentTest, HintsNameWhatWouldMendAFit) {
  const auto hinted = [&](const Made& made, const std::vector<std::string>& names, const std::vector<double>& truth) {
    const MeasurementReport report = compared(readings(made, 1), {}, {"rotation_rate_rad_s"});
    ASSERT_EQ(report.fit, FitOutcome::converged);
    EXPECT_FALSE(report.agrees());
    ASSERT_FALSE(report.hints.empty()) << names.front();
    const FitHint& best = report.hints.front();
    ASSERT_EQ(best.values.size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      EXPECT_EQ(best.values[k].name, names[k]);
      EXPECT_LT(std::abs(best.values[k].value - truth[k]), 5 * best.values[k].standard_error);
    }
    // What the hint says is what a fit of these inputs finds.
    std::vector<std::string> estimates = {"rotation_rate_rad_s"};
    estimates.insert(estimates.end(), names.begin(), names.end());
    const MeasurementReport mended = compared(readings(made, 1), {}, estimates);
    ASSERT_TRUE(mended.fitted);
    EXPECT_FALSE(mended.scatters_more());
    EXPECT_TRUE(mended.hints.empty());
    // To first order: the turns are 0.5 degrees of a radian.
    EXPECT_NEAR(best.chi_squared, mended.fitted->value, 0.05 * mended.fitted->value);
  };
  hinted({.turn_deg = {0.4, -0.3, 0}}, {"/instrument/turn_east_deg", "/instrument/turn_north_deg"}, {0.4, -0.3});
  hinted({.time_offset_s = 0.08}, {"/instrument/time_offset_s"}, {0.08});
  hinted({.tilt_zero_deg = 0.3}, {"/instrument/tilt_zero_deg"}, {0.3});
}

TEST_F(InstrumentTest, WhatIsNoInstrumentIsRefused) {
  const auto refused = [](const std::string& pointer, const std::string& value, const std::string& words) {
    try {
      parse_scene(test::shipped("free-gyro"), {{pointer, value}});
      ADD_FAILURE() << "accepted: " << pointer;
    } catch (const ScenarioError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused("/instrument/azimuth_reversed", "1", "must be true or false");
  refused("/instrument/rotor_rate_scale", "0", "must be a number from 1e-06 to 1e+06");
  refused("/instrument/clock_rate", "0", "must be a number from 0.001 to 1000");
  refused("/instrument/turn_east_deg", "31", "must be a number from -30 to 30");
  refused("/instrument/time_offset_se_s", "-1", "must be a number from 0");
  refused("/instrument/azimuth_zero", "1", "azimuth_zero_deg");
  const Measurement measurement = readings({});
  EXPECT_THROW(compared(measurement, {}, {"/instrument/azimuth_reversed"}), ScenarioError);
  EXPECT_THROW(compared(measurement, {}, {"/instrument/time_offset_se_s"}), ScenarioError);
}

}  // namespace
}  // namespace earthtop
