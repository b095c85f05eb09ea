// SPDX-License-Identifier: GPL-3.0-or-later
// Compares measured motions with scenarios. The "measured" motions are closed forms, or values in extended precision; none is
// computed by the functions that are compared with it.
#include "earthtop/measure/measurement.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>

#include "earthtop/frames/rotation.hpp"
#include "error/gsl_errors.hpp"
#include "measure/made_up_measurements.hpp"
#include "support/json.hpp"
#include "support/tolerances.hpp"

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
    EXPECT_NEAR(residual.residual, 0, kComputed) << residual.quantity << " at " << residual.t_s;
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
    EXPECT_EQ(text.values[i].value, file.values[i].value);
    EXPECT_EQ(text.values[i].standard_error, file.values[i].standard_error);
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
    EXPECT_NEAR(report.residuals[i].residual, expected[i].second, kComputed);  // and d^2
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
  EXPECT_NEAR(*report.as_given.p_value, std::erfc(2.5 / std::sqrt(2)),
              testing::rounding(1) / 1e-6);  // density below 1 a standard error
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
    // Eight residuals of one standard error each, good to two roundings of up to four turns.
    const double rounded = testing::rounding(2) * 8 * kPi / 1e-5;
    EXPECT_NEAR(report.as_given.value, 8, 16 * rounded) << v.unit << " " << v.turn;
    EXPECT_NEAR(report.as_given.value, first, 16 * rounded);
    EXPECT_NEAR(*report.estimates[0].estimate, first_estimate, rounded * *report.estimates[0].standard_error);
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
  EXPECT_NEAR(report.residuals[0].residual, 1e-5, kComputed);  // towards East its tilt grows
  EXPECT_NEAR(report.residuals[1].residual, 0, kComputed);
  EXPECT_TRUE(testing::parse_json(measurement_json(report)).at("residuals").at(1).at("predicted_rad").is_null());
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
      // The same motion, rounded when it is written and read.
      for (const MeasurementResidual& residual : compare_with_measurement(source, set, read(csv), {}).residuals)
        EXPECT_NEAR(residual.residual, 0, testing::rounding(500))
            << scene.name << " " << residual.quantity << " at " << residual.t_s;
      // Whatever tolerance the scenario asks of a run.
      if (!scene.set.empty()) continue;
      Overrides loose = set;
      loose.emplace_back("/numerics/relative_tolerance", "1e-3");
      for (const MeasurementResidual& residual : compare_with_measurement(source, loose, read(csv), {}).residuals)
        EXPECT_NEAR(residual.residual, 0, testing::rounding(500))
            << scene.name << " " << residual.quantity << " at " << residual.t_s;
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
