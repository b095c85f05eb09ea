// SPDX-License-Identifier: GPL-3.0-or-later
// Compares measured motions with scenarios. The "measured" motions are closed forms, or values in extended precision; none is
// computed by the functions that are fitted to it.
#include "earthtop/measure/measurement.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "earthtop/frames/earth.hpp"
#include "error/gsl_errors.hpp"
#include "measure/estimated_inputs.hpp"
#include "measure/made_up_measurements.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using namespace test;

TEST_F(MeasurementTest, AFreeGyroscopesClosedFormHasNoResiduals) {
  std::string csv =
      "t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad,azimuth_rad,azimuth_se_rad,tilt_rad,tilt_se_rad,"
      "drift_azimuth_rad,drift_azimuth_se_rad,drift_tilt_rad,drift_tilt_se_rad\n";
  for (const double t : {0.0, 7.3, 31.0, 60.0, 600.0}) {  // the last one ten times as late as the scenario's end
    const Vec3<double> n = free_axis(kEast, kNorthward45, kVertical45, t);
    csv += fmt::format("{},{},{},{},1e-6,{},1e-6,{},1e-6,{},1e-6,{},1e-6\n", t, n[0], n[1], n[2], azimuth(n), tilt(n),
                       azimuth(n) - kPi / 2, tilt(n) - kPi / 2);
  }
  const Measurement measurement = read(csv);
  EXPECT_EQ(measurement.rows, 5u);
  EXPECT_EQ(measurement.values.size(), 25u);
  const MeasurementReport report = compare_with_measurement(shipped("free-gyro"), {}, measurement, {});
  EXPECT_EQ(report.status, RunStatus::completed);
  EXPECT_EQ(report.reached_s, 600);
  EXPECT_EQ(report.residuals.size(), 30u);
  for (const MeasurementResidual& residual : report.residuals)
    EXPECT_NEAR(residual.residual_rad, 0, kComputed) << residual.quantity << " at " << residual.t_s;
  EXPECT_EQ(report.as_given.degrees_of_freedom, 30);
  EXPECT_EQ(report.fit, FitOutcome::not_asked);
  EXPECT_TRUE(report.agrees());
  EXPECT_EQ(report.notes.size(), 1u) << "scatter far below the stated errors";
}

TEST_F(MeasurementTest, ATextGivesTheValuesOfAFile) {
  const std::string csv = "# made up\r\nt_s\tazimuth_deg\tazimuth_se_deg\r\n0\t90.1\t0.01\r\n\r\n0.1\t90.3\t0.02\r\n";
  const Measurement file = read(csv), text = parse_measurement("<text>", csv);
  EXPECT_EQ(text.file, "<text>");
  EXPECT_EQ(text.rows, 2u);
  ASSERT_EQ(text.values.size(), file.values.size());
  for (std::size_t i = 0; i < text.values.size(); ++i) {
    EXPECT_EQ(text.values[i].t_s, file.values[i].t_s);
    EXPECT_EQ(text.values[i].angle_rad, file.values[i].angle_rad);
    EXPECT_EQ(text.values[i].standard_error_rad, file.values[i].standard_error_rad);
    EXPECT_EQ(text.values[i].line, file.values[i].line);
  }
}

TEST(ReturnedGslErrors, TheLastOfSeveralRestoresTheHandler) {
  gsl_error_handler_t* const given = gsl_set_error_handler_off();
  gsl_error_handler_t* const off = gsl_set_error_handler(given);
  ASSERT_NE(off, given);
  std::optional<ReturnedGslErrors> first(std::in_place), second(std::in_place);
  first.reset();
  EXPECT_EQ(gsl_set_error_handler(off), off) << "another thread may still need it off";
  second.reset();
  EXPECT_EQ(gsl_set_error_handler(given), given);
}

TEST_F(MeasurementTest, ResidualsAreMeasuredLessPredictedAndAnAxisHasTwo) {
  const double d = 3e-6, e = 1e-6;
  const Vec3<double> n = free_axis(kEast, kNorthward45, kVertical45, 60);
  const double a = azimuth(n) + d, z = tilt(n) - 2 * d;
  const Vec3<double> m(std::sin(z) * std::sin(a), std::sin(z) * std::cos(a), std::cos(z));
  const auto report = compare_with_measurement(
      shipped("free-gyro"), {},
      read(
          fmt::format("t_s,azimuth_rad,azimuth_se_rad,drift_tilt_rad,drift_tilt_se_rad,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n"
                      "60,{},{},{},{},{},{},{},{}\n",
                      a, e, z - kPi / 2, e, m[0], m[1], m[2], e)),
      {});
  ASSERT_EQ(report.residuals.size(), 4u);
  const std::pair<std::string_view, double> expected[] = {
      {"azimuth", d}, {"axis_tilt", -2 * d}, {"axis_azimuth", d * std::sin(z)}, {"drift_tilt", -2 * d}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(report.residuals[i].quantity, expected[i].first);
    EXPECT_NEAR(report.residuals[i].residual_rad, expected[i].second, kComputed);  // and d^2
  }
  // The sum 9 + 36 + 9 + 36; each term is good to twice its root times kComputed / e.
  EXPECT_NEAR(report.as_given.value, 90, 36 * kComputed / e);
  ASSERT_TRUE(report.largest);
  EXPECT_NEAR(report.residuals[*report.largest].normalised(), -6, kComputed / e);
  EXPECT_FALSE(report.agrees());
}

TEST_F(MeasurementTest, TheChanceOfOneNumberIsThatOfANormalError) {
  const double a = azimuth(free_axis(kEast, kNorthward45, kVertical45, 60));
  const auto report = compare_with_measurement(
      shipped("free-gyro"), {}, read(fmt::format("t_s,azimuth_rad,azimuth_se_rad\n60,{},1e-6\n", a + 2.5e-6)), {});
  ASSERT_TRUE(report.as_given.p_value);
  EXPECT_NEAR(*report.as_given.p_value, std::erfc(2.5 / std::sqrt(2)), kComputed / 1e-6);  // density below 1 a standard error
  EXPECT_TRUE(report.agrees());
}

TEST_F(MeasurementTest, UnitsAndWholeTurnsChangeNothing) {
  // After a release towards North, the azimuth passes 360 degrees.
  const Overrides north = {{"/release/azimuth_deg", "359.999"}};
  const double a0 = -0.001 * kDegree;
  const Vec3<double> n0(std::sin(a0), std::cos(a0), 0);
  struct Variant {
    std::string unit, error_unit;
    double rad, error_rad, turn;
  };
  double first = 0, first_estimate = 0;
  for (const Variant& v : {Variant{"rad", "rad", 1, 1, 0}, Variant{"deg", "arcsec", kDegree, kArcsecond, 0},
                           Variant{"arcsec", "deg", kArcsecond, kDegree, 0}, Variant{"deg", "deg", kDegree, kDegree, 2 * kPi},
                           Variant{"rad", "arcsec", 1, kArcsecond, -6 * kPi}}) {
    std::string csv = fmt::format("t_s,azimuth_{},azimuth_se_{}\n", v.unit, v.error_unit);
    for (int i = 1; i <= 12; ++i) {
      const double t = 10.0 * i;
      const double measured = azimuth(free_axis(n0, kNorthward45, kVertical45, t)) + (i % 3 - 1) * 1e-5;
      csv += fmt::format("{},{},{}\n", t, (measured + v.turn) / v.rad, 1e-5 / v.error_rad);
    }
    const auto report = compare_with_measurement(shipped("free-gyro"), north, read(csv), {{"omega_sin_latitude_rad_s"}});
    ASSERT_EQ(report.fit, FitOutcome::converged) << v.unit;
    if (first == 0) {
      first = report.as_given.value;
      first_estimate = *report.estimates[0].estimate;
    }
    // Eight residuals of one standard error each, good to 20 eps of up to four turns or to the accuracy of the prediction.
    EXPECT_NEAR(report.as_given.value, 8, 16 * kComputed / 1e-5) << v.unit << " " << v.turn;
    EXPECT_NEAR(report.as_given.value, first, 16 * kComputed / 1e-5);
    EXPECT_NEAR(*report.estimates[0].estimate, first_estimate, 1e-3 * *report.estimates[0].standard_error);
  }
}

TEST_F(MeasurementTest, AzimuthsCountedTheOtherWayDoNotAgree) {
  std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
  for (int i = 0; i <= 10; ++i)
    csv += fmt::format("{},{},1e-6\n", 6 * i, -azimuth(free_axis(kEast, kNorthward45, kVertical45, 6 * i)));
  const auto report = compare_with_measurement(shipped("free-gyro"), {}, read(csv), {});
  // Half a turn off, from East to West: (pi / 1e-6)^2 a row.
  EXPECT_GT(report.as_given.value, 0.9 * 11 * std::pow(kPi / 1e-6, 2));
  EXPECT_FALSE(report.agrees());
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("clockwise"), std::string::npos);
}

/// A published figure of a heavy top: the azimuth drift of steady-precession-slow after 60 s, computed in 113 bits, from its
/// file.
TEST_F(MeasurementTest, TheEarthsRateFromOneDriftOfAHeavyTop) {
  const Measurement measurement = read("t_s,drift_azimuth_rad,drift_azimuth_se_rad\n60,0.0035970975670805857,1e-8\n");
  const auto source = shipped("steady-precession-slow");
  const auto report =
      compare_with_measurement(source, {{"/earth/rotation_rate_rad_s", "6e-5"}}, measurement, {{"rotation_rate_rad_s"}});
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
  EXPECT_TRUE(report.agrees());
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
  EXPECT_LT(report.fitted->value, 1e-4);
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
  outcome({"rotation_rate_rad_s", "latitude_deg"}, "do not tell apart rotation_rate_rad_s, latitude_deg");
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
  refused({"/site/latitud_deg"}, "no number that the motion depends on");
  refused({"/motion/duration_s"}, "no number that the motion depends on");
  refused({"/release/precession"}, "no number that the motion depends on");
  refused({"/platform/rate_rad_s"}, "/platform/motion");  // what a platform needs, and there is none
  refused({"/body/solids/0/radius_m"}, "is not in the scenario");
  refused({"latitude_deg", "/site/latitude_deg"}, "asked for twice");
  refused({"latitude_deg", "omega_sin_latitude_rad_s"}, "stands for the rotation rate and the latitude");
  refused({"latitude_deg", "tilt_deg", "spin_rad_s"}, "3 numbers cannot be estimated from 2 measured ones");
  refused({"a", "b", "c", "d", "e", "f", "g", "h", "i"}, "at most 8");
  refused({"omega_sin_latitude_rad_s"}, "deflection of the vertical",
          {{"/effects/deflection_of_vertical", R"({"north_arcsec": 5, "east_arcsec": 0})"}});
}

TEST_F(MeasurementTest, AVerticalAxisHasNoAzimuth) {
  const Measurement measurement = read(
      "t_s,azimuth_rad,azimuth_se_rad,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n"
      "0,,,1e-5,0,1,1e-5\n0,0.1,1e-3,,,,\n");
  EXPECT_EQ(measurement.values.size(), 2u);
  try {
    compare_with_measurement(shipped("free-gyro"), {{"/release/tilt_deg", "0"}}, measurement, {});
    ADD_FAILURE();
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.diagnostics().at(0).line, 3);
    EXPECT_NE(std::string(error.what()).find("has no azimuth"), std::string::npos);
  }
  // The axis itself is compared: 1e-5 rad towards East of Up.
  const auto report = compare_with_measurement(shipped("free-gyro"), {{"/release/tilt_deg", "0"}},
                                               read("t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n0,1e-5,0,1,1e-5\n"), {});
  ASSERT_EQ(report.residuals.size(), 2u);
  EXPECT_NEAR(report.residuals[0].residual_rad, 1e-5, kComputed);  // towards East its tilt grows
  EXPECT_NEAR(report.residuals[1].residual_rad, 0, kComputed);
  EXPECT_TRUE(testing::parse_json(measurement_json(report)).at("residuals").at(1).at("predicted_rad").is_null());
}

TEST_F(MeasurementTest, RefusalsSayWhereAndWhatInstead) {
  struct Case {
    std::string text;
    int line, column;
    std::string words;
  };
  const std::string header = "t_s,azimuth_deg,azimuth_se_deg\n";
  const Case cases[] = {
      {"_time,azimuth_deg,azimuth_se_deg\n0,1,1\n", 1, 1, "no column t_s"},
      {"t_s\n0\n", 1, 1, "no measured quantity; allowed are t_s; azimuth"},
      {"t_s,azimuth_deg\n0,1\n", 1, 1, "azimuth has no standard error; give azimuth_se_rad"},
      {"t_s,tilt_deg,tilt_se_deg,azimuth_se_deg\n0,1,1,1\n", 1, 1, "azimuth_se_deg without a column azimuth_rad"},
      {"t_s,azimuth_deg,azimuth_rad,azimuth_se_deg\n0,1,1,1\n", 1, 1, "azimuth_rad and azimuth_deg are the same in two units"},
      {"t_s,azimut_deg,azimuth_se_deg\n0,1,1\n", 1, 1, "did you mean \"azimuth_deg\"?"},
      {"t_s,axis_L_x,axis_L_z,axis_se_rad\n0,1,0,1\n", 1, 1, "axis_se_rad without all of axis_L_x"},
      {header + "-1,1,1\n", 2, 1, "t_s must be a number from 0"},
      {header + ",1,1\n", 2, 1, "t_s must be a number from 0"},
      {header + "nan,1,1\n", 2, 1, "t_s must be a number from 0"},
      {header + "1,1,1\n0.5,1,1\n", 3, 1, "sort the rows by time"},
      {header + "1,nan,1\n", 2, 3, "leave the cell empty"},
      {header + "1,inf,1\n", 2, 3, "leave the cell empty"},
      {header + "10,1,\n", 2, 6, "needs a standard error above 0"},
      {header + "10,1,0\n", 2, 6, "needs a standard error above 0"},
      {header + "10,1,-1\n", 2, 6, "needs a standard error above 0"},
      {header + "10,1,nan\n", 2, 6, "needs a standard error above 0"},
      {header + "10,1,inf\n", 2, 6, "needs a standard error above 0"},
      {header + "10,x,1\n", 2, 4, "is no number"},
      {"t_s;azimuth_deg;azimuth_se_deg\n0,1;12,5;0,1\n", 1, 1, "semicolons separate these columns"},
      {"t_s;azimuth_deg;azimuth_se_deg\n0.1;12.5;0.1\n", 1, 1, "separate them by commas or tabs"},
      {header + "0,1,12,5,0,1\n", 2, 1, "are there decimal commas?"},
      {"t_s\tazimuth_deg\tazimuth_se_deg\n1\t12,5\t0,1\n", 2, 3, "write decimal points: 0.1"},
      {"\xFF\xFEt_s\n", 1, 1, "is UTF-16"},
      {header + "10,,1\n", 2, 1, "no measured value"},
      {header, 1, 1, "no measured value"},
      {"t_s,tilt_rad,tilt_se_rad\n0,20,1\n", 2, 3, "at most 180 deg"},
      {"t_s,tilt_deg,tilt_se_rad\n0,180,1\n1,180.1,1\n", 3, 3, "at most 180 deg"},
      {"t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n0,1,0,0.1,1\n", 2, 3, "this one has the length 1.00499"},
      {"t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n0,1,,0,1\n", 2, 3, "give all or none"},
  };
  for (const Case& c : cases) {
    const Diagnostic first = refusal(c.text).at(0);
    EXPECT_EQ(first.line, c.line) << c.text;
    EXPECT_EQ(first.column, c.column) << c.text;
    EXPECT_NE(first.message.find(c.words), std::string::npos) << c.text << first.message;
  }
  // All at once, up to twenty.
  EXPECT_EQ(refusal(header + "0,1,0\n1,1,1\n2,nan,1\n1,1,1\n").size(), 3u);
  std::string many = header;
  for (int i = 0; i < 30; ++i) many += "0,1,0\n";
  const auto diagnostics = refusal(many);
  ASSERT_EQ(diagnostics.size(), 21u);
  EXPECT_NE(diagnostics.back().message.find("10 more errors"), std::string::npos);
}

/// As spreadsheets write it: a byte order mark, tabs, the line ends of Windows.
TEST_F(MeasurementTest, ReadsTabsAndAByteOrderMark) {
  const Measurement m = read("\xEF\xBB\xBFt_s\ttilt_deg\ttilt_se_deg\r\n0.5\t20.25\t0.5\r\n1\t\t\r\n");
  EXPECT_EQ(m.rows, 2u);
  ASSERT_EQ(m.values.size(), 1u);
  EXPECT_EQ(m.values[0].t_s, 0.5);
  EXPECT_NEAR(m.values[0].angle_rad, 20.25 * kDegree, 1e-15);
}

TEST_F(MeasurementTest, ReadsWhatIsThere) {
  const Measurement m = read("# by theodolite\n_note,tilt_arcsec,t_s,tilt_se_deg\nfoo,3600,1,0.5\nbar,,2,\nbaz,7200,2,0.25\n");
  EXPECT_EQ(m.rows, 3u);
  ASSERT_EQ(m.values.size(), 2u);
  EXPECT_EQ(m.values[0].line, 3u);
  EXPECT_NEAR(m.values[0].angle_rad, kDegree, 4e-18);  // an ulp
  EXPECT_NEAR(m.values[0].standard_error_rad, kDegree / 2, 4e-18);
  EXPECT_EQ(m.values[1].t_s, 2);
  EXPECT_EQ(m.values[1].quantity, MeasuredQuantity::tilt);
}

/// If no drift is measured, only one motion is integrated, and for a symmetric top only its axis; otherwise both are. Either
/// way it is the motion that `run` writes: for an asymmetric body, with a platform, with dry friction, and for a body symmetric
/// about another axis than the third, and for a top on a table.
TEST_F(MeasurementTest, MotionsAreThoseOfARun) {
  struct Scene {
    std::string name;
    Overrides set;
  };
  const Overrides about_first = {{"/release/rates_relative_to", "laboratory"},
                                 {"/body/inertia/principal_kg_m2", "[3e-4, 2e-4, 2e-4]"},
                                 {"/body/center_of_mass_m", "[0.01, 0, 0]"}};
  const Overrides stops = {{"/effects/coulomb_torque_N_m", "0.05"}};
  for (const Scene& scene :
       {Scene{"toy-top", {}}, Scene{"asymmetric-top", {}}, Scene{"turntable", {}}, Scene{"dzhanibekov", {}},
        Scene{"toy-top", stops}, Scene{"north-pole", about_first}, Scene{"toy-top-on-table", {}}}) {
    const auto source = shipped(scene.name);
    Overrides set = scene.set;
    set.insert(set.end(), {{"/motion/duration_s", "0.5"}, {"/motion/output_step_s", "0.1"}});
    const RunResult result = run(parse_scenario(source, set));
    for (const bool drift : {false, true}) {
      std::string csv = "t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad,drift_tilt_rad,drift_tilt_se_rad\n";
      for (const DriftRow& row : result.rows) {
        const auto& q = row.q_LB;
        const Vec3<double> n_L = rotation_matrix(Quaternion<double>{q[0], Vec3<double>(q[1], q[2], q[3])}).col(2);
        csv += fmt::format("{},{},{},{},1e-3,{},1e-3\n", row.t_s, n_L[0], n_L[1], n_L[2],
                           drift ? fmt::format("{}", row.drift_tilt_rad) : "");
      }
      // Two integrations of tolerance 1e-12, some 1e3 rad of fast motion.
      for (const MeasurementResidual& residual : compare_with_measurement(source, set, read(csv), {}).residuals)
        EXPECT_NEAR(residual.residual_rad, 0, 1e-9) << scene.name << " " << residual.quantity << " at " << residual.t_s;
      // Whatever tolerance the scenario asks of a run.
      if (!scene.set.empty()) continue;
      Overrides loose = set;
      loose.emplace_back("/numerics/relative_tolerance", "1e-3");
      for (const MeasurementResidual& residual : compare_with_measurement(source, loose, read(csv), {}).residuals)
        EXPECT_NEAR(residual.residual_rad, 0, 1e-9) << scene.name << " " << residual.quantity << " at " << residual.t_s;
    }
  }
}

TEST_F(MeasurementTest, RowsBeyondWhatCanBePredictedAreRefused) {
  const auto source = shipped("hard/h11-chaotic");
  const Scenario scenario = parse_scenario(source);
  const std::string csv = "t_s,tilt_deg,tilt_se_deg\n0.5,90,200\n";
  EXPECT_EQ(compare_with_measurement(source, {}, read(csv), {}).status, RunStatus::completed);
  try {
    compare_with_measurement(source, {}, read(csv + fmt::format("{},90,200\n", scenario.duration_s)), {});
    ADD_FAILURE();
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.diagnostics().at(0).line, 3);
    EXPECT_NE(std::string(error.what()).find("chaotic"), std::string::npos) << error.what();
  }
}

TEST_F(MeasurementTest, TheDocumentHasEverything) {
  std::string csv = "t_s,azimuth_rad,azimuth_se_rad\n";
  for (int i = 1; i <= 4; ++i)
    csv += fmt::format("{},{},1e-6\n", 15 * i, azimuth(free_axis(kEast, kNorthward45, kVertical45, 15 * i)) + (i % 2) * 1e-6);
  const auto report = compare_with_measurement(shipped("free-gyro"), {}, read(csv), {{"rotation_rate_rad_s"}});
  const auto document = testing::parse_json(measurement_json(report));
  EXPECT_EQ(document.at("$schema"), "earthtop-measurement-1.json");
  EXPECT_EQ(document.at("scenario").at("name"), "free-gyro");
  EXPECT_EQ(document.at("scenario").at("sha256").get<std::string>().size(), 64u);
  EXPECT_EQ(document.at("rows"), 4);
  EXPECT_EQ(document.at("quantities").at(0).at("name"), "azimuth");
  EXPECT_EQ(document.at("agrees"), report.agrees());
  EXPECT_EQ(document.at("fit").at("outcome"), "converged");
  EXPECT_EQ(document.at("chi_squared").at("as_given").at("degrees_of_freedom"), 4);
  EXPECT_EQ(document.at("chi_squared").at("fitted").at("degrees_of_freedom"), 3);
  EXPECT_EQ(document.at("estimates").at(0).at("estimate"), *report.estimates[0].estimate);
  EXPECT_EQ(document.at("residuals").size(), 4u);
  EXPECT_EQ(document.at("residuals").at(3).at("t_s"), 60);
  EXPECT_EQ(document.at("residuals_of"), "fitted");
  EXPECT_EQ(document.at("largest_residual").at("t_s"), report.residuals[*report.largest].t_s);
}

}  // namespace
}  // namespace earthtop
