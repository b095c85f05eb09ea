// SPDX-License-Identifier: GPL-3.0-or-later
// Fits numbers of scenarios to measured motions. The "measured" motions are closed forms, or values in extended precision; none
// is computed by the functions that are fitted to it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "earthtop/frames/earth.hpp"
#include "earthtop/measure/measurement.hpp"
#include "measure/estimated_inputs.hpp"
#include "measure/made_up_measurements.hpp"
#include "measure/weighted_fit.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using namespace test;

/// A published figure of a heavy top: the azimuth drift of steady-precession-slow after 60 s, computed in 113 bits, from its
/// file.
TEST_F(MeasurementTest, TheEarthsRateFromOneDriftOfAHeavyTop) {
  const Measurement measurement = read("t_s,drift_azimuth_rad,drift_azimuth_se_rad\n60,0.0035970975670805857,1e-8\n");
  const auto source = shipped("steady-precession-slow");
  const auto report = compare_with_measurement(
      source, {{"/earth/rotation_rate_rad_s", "6e-5"}, {"/uncertainty", R"({"rotation_rate_rad_s": 2e-5})"}}, measurement,
      {{"rotation_rate_rad_s"}});
  ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
  const ParameterEstimate& rate = report.estimates[0];
  EXPECT_EQ(rate.start, 6e-5);
  EXPECT_EQ(rate.unit, "rad/s");
  // The drift is proportional to the rate, up to a part of the relative size of the drift: dOmega / Omega = 1e-8 / 0.0036. The
  // fit converges to a thousandth of that.
  const double expected_error = kOmega * 1e-8 / 0.0035970975670805857;
  EXPECT_NEAR(*rate.standard_error, expected_error, 0.02 * expected_error);
  EXPECT_NEAR(*rate.estimate, kOmega, 1.1e-3 * expected_error);
  EXPECT_EQ(*rate.standard_error_scaled, *rate.standard_error) << "without freedom there is no scatter";
  EXPECT_EQ(report.fitted->degrees_of_freedom, 0);
  EXPECT_FALSE(report.fitted->p_value);
  EXPECT_TRUE(report.agrees()) << "the scenario says that its rate is known to 2e-5 rad/s";
}

/// Only the vertical component is estimated: the measured motion has another vertical component of the Earth's rate, and the
/// same northward one.
TEST_F(MeasurementTest, TheVerticalRateAlone) {
  const double vertical = 0.8 * kVertical45;
  std::string csv = "t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n";
  double squares = 0;
  for (int i = 1; i <= 20; ++i) {
    const Vec3<double> n = free_axis(kEast, kNorthward45, vertical, 30.0 * i);
    csv += fmt::format("{},{},{},{},1e-6\n", 30 * i, n[0], n[1], n[2]);
    squares += 900.0 * i * i;
  }
  const auto report = compare_with_measurement(shipped("free-gyro"), {}, read(csv), {{"omega_sin_latitude_rad_s"}});
  ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
  const ParameterEstimate& estimate = report.estimates[0];
  EXPECT_NEAR(estimate.start, kVertical45, 1e-15 * kOmega);
  // The axis moves by Omega sin(latitude) t towards South; once it has turned by up to 0.044 rad, it moves less by the square
  // of that.
  const double expected_error = 1e-6 / std::sqrt(squares);
  EXPECT_NEAR(*estimate.standard_error, expected_error, 0.002 * expected_error);
  EXPECT_NEAR(*estimate.estimate, vertical, 1.1e-3 * expected_error + kComputed / 600);
  EXPECT_GT(report.as_given.value, 1e6);
  EXPECT_LT(report.fitted->value, 1e-6);  // the data are exact, and a fit stops a thousandth of an error from the minimum
  EXPECT_EQ(*estimate.standard_error_scaled, *estimate.standard_error) << "less scatter than stated makes no smaller error";
}

/// At the end of a number's range its derivatives are one-sided.
TEST_F(MeasurementTest, ANumberAtTheEndOfItsRange) {
  const double latitude = 89.99;
  const double northward = kOmega * std::cos(latitude * kDegree), vertical = kOmega * std::sin(latitude * kDegree);
  std::string csv = "t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n";
  double squares = 0;
  for (int i = 1; i <= 10; ++i) {
    const Vec3<double> n = free_axis(kEast, northward, vertical, 60 * i);
    csv += fmt::format("{},{},{},{},1e-6\n", 60 * i, n[0], n[1], n[2]);
    squares += std::pow(kOmega * 60 * i, 2);
  }
  const auto report =
      compare_with_measurement(shipped("free-gyro"), {{"/site/latitude_deg", "90"}}, read(csv), {{"latitude_deg"}});
  ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
  const double expected_error = 1e-6 / std::sqrt(squares) / kDegree;
  EXPECT_NEAR(*report.estimates[0].estimate, latitude, 1.1e-3 * expected_error);
  // The neglected terms are of first order in the turn, at most 0.044 rad, and in the step of a thousandth of a radian.
  EXPECT_NEAR(*report.estimates[0].standard_error, expected_error, 0.01 * expected_error);
}

TEST_F(MeasurementTest, TheVerticalRateLeavesGravityAsItWas) {
  ScenarioSource source{"", R"({"site": {"latitude_deg": 30}, "motion": {"duration_s": 1},
    "body": {"mass_kg": 1, "center_of_mass_m": [0, 0, 0.1], "inertia": {"principal_kg_m2": [0.02, 0.02, 0.01]}},
    "release": {"tilt_deg": 20, "spin_rad_s": 100}})"};
  const Scenario base = parse_scenario(source);
  const measure::EstimatedInputs vertical(source, {}, base, {"omega_sin_latitude_rad_s"});
  const auto varied = vertical.scene({0.9 * kOmega});
  ASSERT_TRUE(varied);
  EXPECT_EQ(varied->site().gravity_m_s2, base.site.gravity_m_s2);
  const Vec3<double> W_L = varied->rotation_rate_rad_s() * celestial_axis_L<double>(varied->site());
  EXPECT_NEAR(W_L[1], kOmega * std::cos(30 * kDegree), 1e-15 * kOmega);
  EXPECT_NEAR(W_L[2], 0.9 * kOmega, 1e-15 * kOmega);
  // Changing the latitude also changes the gravity at the plumb line, as it does with --set.
  const measure::EstimatedInputs latitude(source, {}, base, {"latitude_deg"});
  EXPECT_NE(latitude.scene({31})->site().gravity_m_s2, base.site.gravity_m_s2);
  EXPECT_FALSE(latitude.scene({91}));
}

/// Start values may come from the text, from --set, from the table's defaults, from computed defaults, and from lists.
TEST_F(MeasurementTest, NumbersAreFoundWhereverTheyStand) {
  ScenarioSource source{"", R"({"site": {"latitude_deg": 30}, "motion": {"duration_s": 1},
    "body": {"mass_kg": 1, "center_of_mass_m": [0, 0, 0.1], "inertia": {"principal_kg_m2": [0.02, 0.02, 0.01]}},
    "release": {"tilt_deg": 20, "spin_rad_s": 100}})"};
  const Overrides set = {{"/release/spin_rad_s", "90"}, {"/release/spin_angle_deg", "33"}};
  const Scenario base = parse_scenario(source, set);
  const measure::EstimatedInputs inputs(source, set, base,
                                        {"spin_rad_s", "tilt_deg", "/release/azimuth_deg", "gravity_m_s2",
                                         "rotation_rate_rad_s", "/body/center_of_mass_m/2", "/body/inertia/principal_kg_m2/0"});
  const double expected[] = {90, 20, 0, base.site.gravity_m_s2, kOmega, 0.1, 0.02};
  const std::string units[] = {"rad/s", "deg", "deg", "m/s^2", "rad/s", "m", "kg m^2"};
  ASSERT_EQ(inputs.list().size(), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(inputs.list()[i].start, expected[i]) << inputs.list()[i].name;
    EXPECT_EQ(inputs.list()[i].unit, units[i]) << inputs.list()[i].name;
  }
  const auto varied = inputs.scene({91, 21, 2, 9.7, 7e-5, 0.11, 0.021});
  ASSERT_TRUE(varied);
  EXPECT_EQ(varied->scenario().body.center_of_mass_m[2], 0.11);
  EXPECT_EQ(varied->scenario().release.azimuth_deg, 2);
  EXPECT_EQ(varied->scenario().release.spin_angle_deg, 33);
}

/// The spin is estimated in the unit that is asked for, whichever the scenario gives it in.
TEST_F(MeasurementTest, TheSpinIsEstimatedInEitherUnit) {
  const ScenarioSource source{"", R"({"site": {"latitude_deg": 30}, "motion": {"duration_s": 1},
    "body": {"mass_kg": 1, "center_of_mass_m": [0, 0, 0.1], "inertia": {"principal_kg_m2": [0.02, 0.02, 0.01]}},
    "release": {"tilt_deg": 20, "spin_rpm": 1500}})"};
  const Scene base = parse_scenario(source);
  for (const char* name : {"/release/spin_rpm", "spin_rad_s"}) {
    const measure::EstimatedInputs inputs(source, {}, base, {name});
    const bool in_rpm = std::string(name) != "spin_rad_s";
    EXPECT_EQ(inputs.list()[0].start, in_rpm ? 1500 : rad_s_from_rpm(1500));
    EXPECT_EQ(inputs.list()[0].unit, in_rpm ? "rpm" : "rad/s");
    const auto varied = inputs.scene({160});
    ASSERT_TRUE(varied) << name;
    EXPECT_EQ(varied->scenario().release.spin_rad_s, in_rpm ? rad_s_from_rpm(160) : 160);
  }
  EXPECT_THROW(measure::EstimatedInputs(source, {}, base, {"/release/spin_rpm", "spin_rad_s"}), ScenarioError);
}

/// A straight line through azimuths: its intercept is the azimuth at release, its slope Omega sin(latitude). Standard errors
/// and correlation are those of textbook linear regression.
TEST_F(MeasurementTest, TwoNumbersAtOnceAndTheirCorrelation) {
  const double error = 1e-5;
  const int rows = 25;
  std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
  double sum = 0, squares = 0;
  for (int i = 0; i < rows; ++i) {
    const double t = 4.0 * i;
    csv += fmt::format("{},{},{}\n", t, azimuth(free_axis(kEast, kNorthward45, kVertical45, t)) + 2e-3, error);
    sum += t;
    squares += t * t;
  }
  const auto report =
      compare_with_measurement(shipped("free-gyro"), {}, read(csv), {{"/release/azimuth_deg", "omega_sin_latitude_rad_s"}});
  ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
  const double spread = squares - sum * sum / rows;
  const double slope_error = error / std::sqrt(spread), intercept_error = error * std::sqrt(squares / rows / spread);
  // Deviations from the line: an axis 2e-3 rad from East that has turned by 7e-3 rad moves differently by less than the product
  // of the two.
  constexpr double kBeyond = 1e-3;
  EXPECT_NEAR(*report.estimates[0].standard_error, intercept_error / kDegree, kBeyond * intercept_error / kDegree);
  EXPECT_NEAR(*report.estimates[1].standard_error, slope_error, kBeyond * slope_error);
  ASSERT_EQ(report.correlation.size(), 2u);
  EXPECT_EQ(report.correlation[0][0], 1);
  EXPECT_NEAR(report.correlation[0][1], -sum / std::sqrt(rows * squares), kBeyond);
  EXPECT_EQ(report.correlation[0][1], report.correlation[1][0]);
  EXPECT_NEAR(*report.estimates[0].estimate, 90 + 2e-3 / kDegree, 0.02 * intercept_error / kDegree);
  EXPECT_NEAR(*report.estimates[1].estimate, kVertical45, 0.02 * slope_error + 2e-3 * 7e-3 * kVertical45);
}

/// Estimates scatter about the true values by their standard errors, and the remaining sum of squares is distributed by its
/// degrees of freedom.
TEST_F(MeasurementTest, ErrorsOfEstimatesAreWhatIsStated) {
  constexpr std::uint64_t kSeed = 20250711;
  constexpr int kDraws = 60, kRows = 15;
  RecordProperty("seed", std::to_string(kSeed));
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  Normal normal(kSeed);
  const double latitude = 47.3, error = 2e-5;
  const double northward = kOmega * std::cos(latitude * kDegree), vertical = kOmega * std::sin(latitude * kDegree);
  double sum = 0, squares = 0, chi_squared = 0;
  int covered = 0;
  std::int64_t freedom = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::string csv = "t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n";
    for (int i = 1; i <= kRows; ++i) {
      Vec3<double> n = free_axis(kEast, northward, vertical, 20.0 * i);
      const Vec3<double> a = Vec3<double>(n.cross(Vec3<double>(0, 0, 1)).normalized()), b = n.cross(a);
      n += a * std::tan(error * normal()) + b * std::tan(error * normal());
      n /= norm(n);
      csv += fmt::format("{},{},{},{},{}\n", 20 * i, n[0], n[1], n[2], error);
    }
    const auto report =
        compare_with_measurement(shipped("free-gyro"), {}, read(csv), {{"latitude_deg", "rotation_rate_rad_s"}});
    ASSERT_EQ(report.fit, FitOutcome::converged) << report.fit_reason;
    const double pulls[] = {(*report.estimates[0].estimate - latitude) / *report.estimates[0].standard_error,
                            (*report.estimates[1].estimate - kOmega) / *report.estimates[1].standard_error};
    for (const double pull : pulls) {
      sum += pull;
      squares += pull * pull;
      covered += std::abs(pull) < 1 ? 1 : 0;
    }
    chi_squared += report.fitted->value;
    freedom += report.fitted->degrees_of_freedom;
  }
  // The tolerances are four standard errors of the mean of n normal pulls, of their standard deviation and of the share within
  // 1.
  const int n = 2 * kDraws;
  const double share = std::erf(1 / std::sqrt(2.0));
  const double deviation = std::sqrt(squares / n), mean = sum / n;
  RecordProperty("pull_standard_deviation", fmt::format("{:.3f}", deviation));
  EXPECT_NEAR(mean, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(deviation, 1, 4 / std::sqrt(2.0 * n));
  EXPECT_NEAR(static_cast<double>(covered) / n, share, 4 * std::sqrt(share * (1 - share) / n));
  EXPECT_EQ(freedom, kDraws * (2 * kRows - 2));
  EXPECT_NEAR(chi_squared, static_cast<double>(freedom), 4 * std::sqrt(2.0 * static_cast<double>(freedom)));
  fmt::print("pulls: mean {:.3f}, standard deviation {:.3f}, {} of {} within 1; chi-squared {:.1f} of {}\n", mean, deviation,
             covered, n, chi_squared, freedom);
}

TEST_F(MeasurementTest, ScatterAboveTheStatedErrorsWidensTheScaledOne) {
  std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
  for (int i = 1; i <= 40; ++i)
    csv += fmt::format("{},{},1e-6\n", 3 * i,
                       azimuth(free_axis(kEast, kNorthward45, kVertical45, 3 * i)) + (i % 2 == 0 ? 3e-6 : -3e-6));
  const auto report = compare_with_measurement(shipped("free-gyro"), {}, read(csv), {{"rotation_rate_rad_s"}});
  ASSERT_EQ(report.fit, FitOutcome::converged);
  const ParameterEstimate& rate = report.estimates[0];
  EXPECT_NEAR(*rate.standard_error_scaled / *rate.standard_error, std::sqrt(report.fitted->value / 39), 1e-12);
  EXPECT_GT(report.fitted->value, 0.9 * 9 * 40);
  EXPECT_FALSE(report.agrees());
}

TEST_F(MeasurementTest, WhatTheDataDoNotTellIsNamed) {
  std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
  for (int i = 0; i <= 10; ++i)
    csv += fmt::format("{},{},1e-6\n", 6 * i, azimuth(free_axis(kEast, kNorthward45, kVertical45, 6 * i)));
  const Measurement measurement = read(csv);
  const auto outcome = [&](const std::vector<std::string>& names, const std::string& named) {
    const auto report = compare_with_measurement(shipped("free-gyro"), {}, measurement, {names});
    EXPECT_EQ(report.fit, FitOutcome::not_determined) << names[0];
    EXPECT_NE(report.fit_reason.find(named), std::string::npos) << report.fit_reason;
    EXPECT_FALSE(report.fitted);
    EXPECT_FALSE(report.agrees());
    EXPECT_TRUE(report.correlation.empty());
    for (const ParameterEstimate& estimate : report.estimates) EXPECT_FALSE(estimate.estimate || estimate.standard_error);
    EXPECT_EQ(report.residuals.size(), 11u);
    EXPECT_TRUE(testing::parse_json(measurement_json(report)).at("estimates").at(0).at("estimate").is_null());
  };
  outcome({"/release/spin_angle_deg"}, "do not determine /release/spin_angle_deg");
  outcome({"rotation_rate_rad_s", "/body/mass_kg"}, "do not determine /body/mass_kg");
  // tan(azimuth - 90 deg) = sin(latitude) tan(Omega t): the two inputs can be told apart only by terms of third order in Omega
  // t = 0.004.
  outcome({"rotation_rate_rad_s", "latitude_deg"}, "these data do not tell apart rotation_rate_rad_s, latitude_deg");
}

TEST_F(MeasurementTest, ALeastSumBeyondARangeIsNoFit) {
  // An Earth that turns about an axis beyond the pole, which no latitude describes.
  const double beyond = 93 * kDegree;
  std::string csv = "t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n";
  for (int i = 1; i <= 10; ++i) {
    const Vec3<double> n = free_axis(kEast, kOmega * std::cos(beyond), kOmega * std::sin(beyond), 60 * i);
    csv += fmt::format("{},{},{},{},1e-5\n", 60 * i, n[0], n[1], n[2]);
  }
  const auto report =
      compare_with_measurement(shipped("free-gyro"), {{"/site/latitude_deg", "89"}}, read(csv), {{"latitude_deg"}});
  EXPECT_EQ(report.fit, FitOutcome::not_converged);
  EXPECT_NE(report.fit_reason.find("beyond a number's range"), std::string::npos) << report.fit_reason;
  EXPECT_TRUE(report.fit_reason.ends_with("; latitude_deg is at the end of its range")) << report.fit_reason;
  EXPECT_FALSE(report.agrees());
}

TEST_F(MeasurementTest, NamesThatCannotBeEstimatedAreRefused) {
  const Measurement measurement = read("t_s,azimuth_rad,azimuth_se_rad\n10,1.57,1e-3\n20,1.57,1e-3\n");
  const auto refused = [&](const std::vector<std::string>& names, const std::string& words, const Overrides& set = {}) {
    try {
      compare_with_measurement(shipped("free-gyro"), set, measurement, {names});
      ADD_FAILURE() << "accepted: " << names[0];
    } catch (const ScenarioError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused({"latitude"}, "did you mean latitude_deg?");
  refused({"weather"}, "allowed are omega_sin_latitude_rad_s");
  refused({"/site/latitud_deg"}, "not a number on which the motion or its readings depend");
  refused({"/motion/duration_s"}, "not a number on which the motion or its readings depend");
  refused({"/release/precession"}, "not a number on which the motion or its readings depend");
  refused({"/platform/rate_rad_s"}, "/platform/motion");  // what a platform needs, and there is none
  refused({"/body/solids/0/radius_m"}, "is not in the scenario");
  refused({"latitude_deg", "/site/latitude_deg"}, "asked for twice");
  refused({"latitude_deg", "omega_sin_latitude_rad_s"}, "stands for the rotation rate and the latitude");
  refused({"latitude_deg", "tilt_deg", "spin_rad_s"}, "3 numbers cannot be estimated from 2 measured ones");
  refused({"a", "b", "c", "d", "e", "f", "g", "h", "i"}, "at most 8");
  refused({"omega_sin_latitude_rad_s"}, "deflection of the vertical",
          {{"/effects/deflection_of_vertical", R"({"north_arcsec": 5, "east_arcsec": 0})"}});
}

/// A fit of one number, from 0, to residuals that are a function of it; no number is where there is no prediction.
measure::Fit fit_of(const std::function<std::optional<double>(double)>& residual) {
  measure::FitProblem problem;
  problem.start = {0};
  problem.scales = problem.standard_error = {1};
  problem.period = {0};
  problem.residuals_at = [&](const std::vector<double>& numbers, std::vector<double>& residuals) {
    const std::optional<double> found = residual(numbers[0]);
    residuals = {found.value_or(0)};
    return found.has_value();
  };
  problem.stopped = [] { return false; };
  return fit_weighted(problem);
}

TEST(WeightedFit, SaysWhyItDoesNotConverge) {
  const auto exponential = fit_of([](double x) { return std::optional(1e60 * std::exp(-x)); });
  EXPECT_EQ(exponential.outcome, FitOutcome::not_converged);
  EXPECT_EQ(exponential.reason, "the sum of squares is still decreasing");
  EXPECT_EQ(exponential.iterations, 100);
  EXPECT_EQ(fit_of([](double x) { return std::optional(1e10 * std::exp(-x)); }).outcome, FitOutcome::converged);
  const auto kink = fit_of([](double x) { return std::optional(1 + std::abs(x) * (x < 0 ? 1 : 3)); });
  EXPECT_EQ(kink.outcome, FitOutcome::not_converged);
  EXPECT_EQ(kink.reason, "no step reduces the sum of squares, though to first order it is not at its minimum");
  // Next to numbers beyond 0.5 there is no prediction, so that they have no derivative.
  double before = 0;
  const auto alone = fit_of([&](double x) {
    const bool is_beside = before > 0.5 && std::abs(x - before) < 0.03;
    before = x;
    return is_beside ? std::nullopt : std::optional(x - 1);
  });
  EXPECT_EQ(alone.outcome, FitOutcome::prediction_failed);
  EXPECT_EQ(alone.reason, "on the way to the minimum of the sum of squares there is no prediction");
}

}  // namespace
}  // namespace earthtop
