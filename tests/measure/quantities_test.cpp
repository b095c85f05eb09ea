// SPDX-License-Identifier: GPL-3.0-or-later
// Instruments write more than angles: spins, rates along body axes, turning points, periods, passages, the ellipse of a swing. Each
// is held against a closed form, or against the rows of a run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>

#include "earthtop/frames/rotation.hpp"
#include "earthtop/measure/measurement.hpp"
#include "earthtop/plan/plan.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/top_figures.hpp"
#include "measure/document.hpp"
#include "measure/made_up_measurements.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using namespace test;

constexpr double kI1 = 6e-4, kI3 = 5e-4;
/// Errors of double integrations to 1e-12: of angles over minutes (rad), of rates of some hundred rad/s, of times of some ten seconds.
constexpr double kAngleError = 1e-10, kRateError = 1e-9, kTimeError_s = 1e-9;
constexpr double kSpin = 90, kTorque = 0.1 * 9.8 * 0.03;  // rad/s, N m

/// A symmetric top; on an Earth that does not rotate, and released at rest, unless something else is said.
std::string top(const std::string& release, const std::string& more = "",
                const std::string& earth = R"("rotation_rate_rad_s": 0)", double center_m = 0.03) {
  return fmt::format(R"({{"site": {{"latitude_deg": 50, "gravity_m_s2": 9.8}}, "earth": {{{}}},
    "body": {{"mass_kg": 0.1, "center_of_mass_m": [0, 0, {}], "inertia": {{"principal_kg_m2": [{}, {}, {}]}}}},
    "release": {{{}}}, "motion": {{"duration_s": 2}}{}}})",
                     earth, center_m, kI1, kI1, kI3, release, more);
}

/// The residuals of a measurement without errors.
std::vector<MeasurementResidual> residuals(const std::string& scenario, const std::string& csv,
                                           const MeasurementFormat& format = {}) {
  return compare_with_measurement({"top.json", scenario}, {}, parse_measurement("m.csv", csv, format)).residuals;
}
void expect_none(const std::vector<MeasurementResidual>& all, std::size_t count, double within) {
  ASSERT_EQ(all.size(), count);
  for (const MeasurementResidual& one : all) EXPECT_LT(std::abs(one.residual), within) << one.quantity << " at " << one.t_s;
}

/// A free symmetric body on the rotating Earth: its inertial rate about axis 3 stays, and that across it turns in the body at (I1 - I3) / I1
/// times that rate.
TEST(MeasuredRates, InertialRatesOfAFreeBodyAreEulers) {
  const std::string scenario =
      top(R"("quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0}, "angular_velocity_body_rad_s": [0.3, -0.2, 5])", "",
          R"("rotation_rate_rad_s": 0.01)", 0);
  const double up = 0.01 * std::sin(50 * kDegree), north = 0.01 * std::cos(50 * kDegree);
  const double axial = 5 + up, turning = (kI1 - kI3) / kI1 * axial;
  std::string csv = "t_s,w_IB_B_x_rad_s,w_IB_B_y_rad_s,w_IB_B_z_deg_s\n";
  for (const double t : {0.0, 0.4, 1.7}) {
    // dw1/dt = turning w2, dw2/dt = -turning w1
    const std::complex<double> across =
        std::complex<double>(0.3, -0.2 + north) * std::exp(std::complex<double>(0, -turning * t));
    csv += fmt::format("{},{},{},{}\n", t, across.real(), across.imag(), axial / kDegree);
  }
  expect_none(residuals(scenario, csv, {{}, {"w_IB_B_x_rad_s=1", "w_IB_B_y_rad_s=1", "w_IB_B_z_rad_s=1"}}), 9,
              1e-11);  // of 5 rad/s
}

/// The same rates, and those in the laboratory, as a run has them in its rows: of a heavy top on the Earth, with friction, in a cage.
TEST(MeasuredRates, AreThoseOfARun) {
  const std::string release = R"("tilt_deg": 40, "azimuth_deg": 70, "spin_angle_deg": 25, "spin_rad_s": 90)";
  const std::string cage =
      R"(, "rotor": {"mass_kg": 0.02, "axial_kg_m2": 1e-4, "transverse_kg_m2": 6e-5, "spin_rad_s": 40, "viscous_torque_N_m_s": 1e-5})";
  for (const std::string& more : {std::string(), std::string(R"(, "effects": {"viscous_torque_N_m_s": 2e-5})"), cage}) {
    const std::string scenario = top(release, more, "");
    const RunResult result = run(parse_scene({"top.json", scenario}, {}));
    std::string csv =
        "t_s,w_LB_B_x_rad_s,w_LB_B_y_rad_s,w_LB_B_z_rad_s,w_IB_B_x_rad_s,w_IB_B_y_rad_s,w_IB_B_z_rad_s,spin_rad_s\n";
    const Vec3<double> earth_L(0, kOmega * std::cos(50 * kDegree), kOmega * std::sin(50 * kDegree));
    for (std::size_t i = 0; i < result.rows.size(); i += 250) {
      const DriftRow& row = result.rows[i];
      const auto& w = row.w_LB_B;
      const Mat3<double> R_LB = rotation_matrix(Quaternion<double>{row.q_LB[0], {row.q_LB[1], row.q_LB[2], row.q_LB[3]}});
      const Vec3<double> earth_B = R_LB.transpose() * earth_L;
      csv += fmt::format("{},{},{},{},{},{},{},{}\n", row.t_s, w[0], w[1], w[2], w[0] + earth_B[0], w[1] + earth_B[1],
                         w[2] + earth_B[2], w[2]);
    }
    MeasurementFormat format;
    for (const char* name : {"w_LB_B_x", "w_LB_B_y", "w_LB_B_z", "w_IB_B_x", "w_IB_B_y", "w_IB_B_z", "spin"})
      format.sigmas.push_back(fmt::format("{}_rad_s=1", name));
    expect_none(residuals(scenario, csv, format), 35, 1e-8);  // of 90 rad/s after 30 turns
  }
}

/// With viscous friction alone about the axis: exp(-k t / I3).
TEST(MeasuredRates, ASpinFallsExponentially) {
  const std::string scenario = top(R"("tilt_deg": 0, "spin_rpm": 1000)", R"(, "effects": {"viscous_torque_N_m_s": 1e-5})",
                                   R"("rotation_rate_rad_s": 0)", 0);
  std::string csv = "t_s,spin_rpm,spin_se_rpm\n";
  for (int k = 0; k <= 5; ++k) csv += fmt::format("{},{},10\n", 30 * k, 1000 * std::exp(-2e-5 / 1e-3 * 30.0 * k));
  expect_none(residuals(scenario, csv), 6, kRateError);
  // A tachometer that shows 2 % more, and 1 rad/s at rest.
  const auto shown =
      compare_with_measurement({"top.json", scenario}, {{"/instrument", R"({"spin_scale": 1.02, "spin_bias_rad_s": 1})"}},
                               parse_measurement("m.csv", csv));
  EXPECT_NEAR(shown.residuals[0].residual, -1 - 0.02 * 1000 * kPi / 30, kRateError);
  const auto turned =
      compare_with_measurement({"top.json", scenario}, {{"/instrument", R"({"w_z_bias_rad_s": 2, "w_scale": 0.5})"}},
                               parse_measurement("m.csv", "t_s,w_LB_B_z_rpm\n0,1000\n", {{}, {"w_LB_B_z_rpm=1"}}));
  EXPECT_NEAR(turned.residuals[0].residual, 500 * kPi / 30 - 2, kRateError);
}

/// A top that is released at rest falls to u = L - sqrt(L^2 - 2 L u0 + 1) and comes back, with u = cos(tilt) and L = (I3 w)^2 / (4 I1 m g l).
TEST(TurningPoints, OfACuspedTopAreRootsOfItsEnergy) {
  const double L = kI3 * kSpin * kI3 * kSpin / (4 * kI1 * kTorque), u0 = std::cos(40 * kDegree);
  const double lowest_deg = std::acos(L - std::sqrt(L * L - 2 * L * u0 + 1)) / kDegree;
  const std::string scenario = top(R"("tilt_deg": 40, "spin_rad_s": 90)");
  const double half_s = kPi / *parse_scene({"top.json", scenario}, {}).top().nutation_rad_s;
  std::string csv = "t_s,tilt_turning_deg,extreme\n";
  for (int k = 0; k <= 8; ++k)
    csv += fmt::format("{},{},{}\n", (k + 0.1) * half_s, k % 2 == 0 ? 40 : lowest_deg, k % 2 == 0 ? "min" : "max");
  csv += fmt::format("{},{},\n", 9.3 * half_s, lowest_deg);  // the next one in time
  const auto found = residuals(scenario, csv, {{}, {"tilt_turning_deg=1"}});
  expect_none(found, 10, kAngleError);
  EXPECT_EQ(found.back().quantity, "tilt_turning");
}

/// A level gyrocompass without friction swings between equal azimuths on both sides of North, whatever its period.
TEST(TurningPoints, OfACompassAreAsFarFromNorthOnBothSides) {
  const auto turning = [](const std::string& instrument) {
    const std::string scenario =
        top(R"("tilt_deg": 90, "azimuth_deg": 20, "spin_rad_s": 500)", R"(, "effects": {"gimbal": {}})" + instrument, "", 0);
    const double half_s = kPi / std::sqrt(kI3 * 500 * kOmega * std::cos(50 * kDegree) / kI1);
    std::string csv = "t_s,azimuth_turning_deg,azimuth_turning_se_deg,extreme\n";
    for (int k = 0; k <= 4; ++k)
      csv += fmt::format("{},{},1,{}\n", k * half_s, k % 2 == 0 ? 20 : -20, k % 2 == 0 ? "max" : "min");
    return residuals(scenario, csv);
  };
  expect_none(turning(""), 5, kAngleError);
  // A circle that is read the other way round has its largest readings where the azimuth is least; its zero is off by 3 degrees.
  for (const MeasurementResidual& one : turning(R"(, "instrument": {"azimuth_reversed": true, "azimuth_zero_deg": 3})"))
    EXPECT_NEAR(one.residual, -3 * kDegree, kAngleError);
}

/// A steady precession goes round in 2 pi over its rate, the root of I1 cos(tilt) x^2 - I3 w x + m g l.
TEST(Passages, OfASteadyPrecessionAreEvenlySpaced) {
  const double a = kI1 * std::cos(40 * kDegree), b = kI3 * kSpin;
  const double turn_s = 2 * kPi / (2 * kTorque / (b + std::sqrt(b * b - 4 * a * kTorque)));
  const std::string scenario = top(R"("tilt_deg": 40, "azimuth_deg": 17, "spin_rad_s": 90, "precession": "steady_slow")");
  std::string csv = "t_s,precession_period_s,passage_s,passage_turns\n";
  csv += fmt::format("0,{},{},1\n3,{},{},0.25\n", turn_s, turn_s, turn_s, turn_s / 4);
  csv += fmt::format("{},{},{},\n", 4.02 * turn_s, turn_s, 4 * turn_s);  // as many turns as fit best
  const auto found = residuals(scenario, csv, {{}, {"precession_period_s=0.1", "passage_s=0.1"}});
  expect_none(found, 6, kTimeError_s);
  // Times by a clock that is fast by a thousandth.
  const auto fast =
      compare_with_measurement({"top.json", scenario}, {{"/instrument", R"({"clock_rate": 1.001})"}},
                               parse_measurement("m.csv", csv, {{}, {"precession_period_s=0.1", "passage_s=0.1"}}));
  EXPECT_NEAR(fast.residuals[0].residual, -0.001 * turn_s, kTimeError_s);
  EXPECT_NEAR(fast.reached_s, 5.02 * turn_s, kTimeError_s);
}

/// On the Earth a top with nutation passes when its rows say so.
TEST(Passages, AreThoseOfARun) {
  const std::string scenario =
      top(R"("tilt_deg": 40, "azimuth_deg": 30, "spin_rad_s": 90)", R"(, "effects": {"viscous_torque_N_m_s": 1e-6})", "");
  const RunResult result =
      run(parse_scene({"top.json", scenario}, {{"/motion/duration_s", "12"}, {"/motion/output_step_s", "1e-3"}}));
  double turned = 0, passed_s = 0;
  for (std::size_t i = 1; i < result.rows.size() && passed_s == 0; ++i) {
    const auto &a = result.rows[i - 1].axis_L, &b = result.rows[i].axis_L;
    const double step = std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);  // counterclockwise
    if (turned + step >= 2 * kPi) passed_s = result.rows[i - 1].t_s + 1e-3 * (2 * kPi - turned) / step;
    turned += step;
  }
  ASSERT_GT(passed_s, 5);
  const auto found =
      residuals(scenario, fmt::format("t_s,precession_period_s\n0,{}\n", passed_s), {{}, {"precession_period_s=0.1"}});
  EXPECT_LT(std::abs(found.at(0).residual), 2e-5);  // of the straight line between two rows
}

/// An undisturbed pendulum keeps its semi-axes and its apsidal rate; where it turns back, the swing's plane is that of its axis.
TEST(Swings, OfASphericalPendulumStayAndTurnEvenly) {
  const std::string scenario = top(R"("tilt_deg": 12, "azimuth_deg": 30, "spin_rad_s": 0, "precession": {"rate_rad_s": 1.5})",
                                   "", R"("rotation_rate_rad_s": 0)", -0.03);
  const RunResult result =
      run(parse_scene({"top.json", scenario}, {{"/motion/duration_s", "3"}, {"/motion/output_step_s", "1e-4"}}));
  double least = kPi, most = 0;
  std::vector<std::pair<double, double>> outermost;  // time, azimuth
  for (std::size_t i = 1; i + 1 < result.rows.size(); ++i) {
    const auto tilt_at = [&](std::size_t k) {
      const auto& n = result.rows[k].axis_L;
      return std::atan2(std::hypot(n[0], n[1]), n[2]);
    };
    const double before = tilt_at(i - 1), here = tilt_at(i), after = tilt_at(i + 1);
    least = std::min(least, here), most = std::max(most, here);
    if (here >= before && here > after)
      outermost.emplace_back(result.rows[i].t_s, std::atan2(result.rows[i].axis_L[0], result.rows[i].axis_L[1]));
  }
  ASSERT_GT(outermost.size(), 3u);
  std::string csv = "t_s,swing_azimuth_rad,swing_major_rad,swing_minor_rad\n";
  csv += fmt::format("0,{},{},{}\n", 30 * kDegree, 12 * kDegree, -least);  // released counterclockwise, at its outermost
  for (const auto& [t_s, azimuth_rad] : outermost) csv += fmt::format("{},{},{},{}\n", t_s, azimuth_rad, most, -least);
  const MeasurementFormat format{{}, {"swing_azimuth_rad=1", "swing_major_rad=1", "swing_minor_rad=1"}};
  for (const MeasurementResidual& one : residuals(scenario, csv, format))
    EXPECT_LT(std::abs(one.residual), one.quantity == "swing_azimuth" ? 2e-3 : 1e-7)
        << one.quantity << one.t_s;  // by rows 0.1 ms apart
}

TEST(MeasuredQuantities, DocumentsAndPicturesHaveTheirUnits) {
  const std::string scenario = top(R"("tilt_deg": 40, "spin_rad_s": 90, "precession": "steady_slow")");
  MeasurementOptions options;
  options.curve_points = 101;
  const MeasurementReport report = compare_with_measurement(
      {"top.json", scenario}, {},
      parse_measurement("m.csv", "t_s,spin_rad_s,precession_period_s,azimuth_deg\n0,90,9,0\n1,90,,40\n",
                        {{}, {"spin_rad_s=1", "precession_period_s=1", "azimuth_deg=1"}}),
      options);
  const auto document = nlohmann::ordered_json::parse(measurement_json(report));
  EXPECT_TRUE(document.at("residuals").at(0).contains("measured_rad"));
  EXPECT_TRUE(document.at("residuals").at(1).contains("measured_rad_s"));
  EXPECT_TRUE(document.at("residuals").at(2).contains("measured_s"));
  EXPECT_EQ(document.at("curve").at("spin_rad_s").at(3), 90);
  const MeasurementReport again = measure::measurement_of(document);
  ASSERT_EQ(again.residuals.size(), report.residuals.size());
  for (std::size_t i = 0; i < again.residuals.size(); ++i) EXPECT_EQ(again.residuals[i].measured, report.residuals[i].measured);
  EXPECT_EQ(svg(measurement_figure(again)), svg(measurement_figure(report)));
  const Figure figure = measurement_figure(report);
  ASSERT_EQ(figure.panels.size(), 6u);
  EXPECT_EQ(figure.panels[2].y.unit, "rad/s");
  EXPECT_EQ(figure.panels[4].y.label, "Time of a turn of the axis");
  EXPECT_EQ(figure.panels[4].y.unit, "s");
}

/// Simulated data are read back, and fits the numbers that it was made with.
TEST(MeasuredQuantities, SimulatedOnesFitWhatTheyWereMadeWith) {
  struct Arrangement {
    std::string scenario;
    std::vector<PlannedQuantity> quantities;
    double every_s, until_s;
    std::vector<std::string> estimates;
    std::string off;  // where the fit starts
  };
  const std::string phone = R"("quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0}, "angular_velocity_body_rad_s": [3, -0.2, 5])";
  const Arrangement all[] = {{top(phone, "", "", 0),
                              {planned_quantity("w_IB_B_x_rad_s", 0.02), planned_quantity("w_IB_B_y_rad_s", 0.02),
                               planned_quantity("w_IB_B_z_rad_s", 0.02)},
                              0.05,
                              2,
                              {"inertia_ratio", "/release/angular_velocity_body_rad_s/0"},
                              "2.9"},
                             {top(R"("tilt_deg": 90, "azimuth_deg": 20, "spin_rad_s": 500)",
                                  R"(, "effects": {"gimbal": {"damping_N_m_s": 2e-6}})", "", 0),
                              {planned_quantity("azimuth_turning_deg", 0.01)},
                              22.6,
                              210,
                              {"/release/azimuth_deg", "/effects/gimbal/damping_N_m_s"},
                              "20.5"},
                             {top(R"("tilt_deg": 40, "spin_rad_s": 90, "precession": "steady_slow")"),
                              {planned_quantity("passage_s", 0.05)},
                              9.6,
                              90,
                              {"spin_rad_s", "gravity_m_s2"},
                              "91"}};
  for (const Arrangement& one : all) {
    const MeasurementPlan plan{one.quantities, one.every_s, one.until_s, 0, {one.estimates[0]}, {one.estimates[1]}};
    const PlanReport planned = plan_measurement({"top.json", one.scenario}, {}, plan);
    ASSERT_TRUE(planned.outcome == PlanOutcome::determined || one.quantities[0].name == "passage_s") << planned.reason;
    const auto csv = simulated_measurement({"top.json", one.scenario}, {}, plan, 3);
    ASSERT_TRUE(csv);
    MeasurementOptions options;
    options.estimates = {one.estimates[0]};
    const MeasurementReport fit =
        compare_with_measurement({"top.json", one.scenario}, {}, parse_measurement("m.csv", *csv), options);
    ASSERT_EQ(fit.fit, FitOutcome::converged) << fit.fit_reason;
    const ParameterEstimate& e = fit.estimates[0];
    EXPECT_LT(std::abs(*e.estimate - e.start), 4 * *e.standard_error) << e.name;
    EXPECT_LT(fit.fitted->value / static_cast<double>(fit.fitted->degrees_of_freedom), 3);
  }
}

/// A racquet thrown into the air with a phone on it, whose clock showed 23.2 s: moments and rates from its rates, told by the middle axis's
/// unsteady turn.
TEST(MeasuredQuantities, APhoneOnARacquetTellsItsMoments) {
  const auto racquet = [](double I1, double I2, double rate) {
    return fmt::format(R"({{"site": {{"latitude_deg": 49.26}}, "body": {{"mass_kg": 0.457, "center_of_mass_m": [0, 0, 0],
      "inertia": {{"principal_kg_m2": [{}, {}, 0.02]}}}}, "release": {{"quaternion_LB": {{"w": 1, "x": 0, "y": 0, "z": 0}},
      "angular_velocity_body_rad_s": [{}, -2.5, -0.3]}}, "motion": {{"duration_s": 0.84}}}})",
                       I1, I2, rate);
  };
  const MeasurementPlan plan{{planned_quantity("w_IB_B_x_rad_s", 0.1), planned_quantity("w_IB_B_y_rad_s", 0.1),
                              planned_quantity("w_IB_B_z_rad_s", 0.1)},
                             0.04,
                             0.84,
                             0,
                             {"inertia_ratio"},
                             {}};
  const auto csv = simulated_measurement({"racquet.json", racquet(0.01881, 0.001235, 5.4)}, {}, plan, 11);
  std::string table = *csv;  // by the clock of the phone
  std::string shifted;
  for (std::size_t at = 0, line = 0; at < table.size(); ++line) {
    const std::size_t end = table.find('\n', at);
    const std::string text = table.substr(at, end - at);
    shifted += line < 2 ? text : fmt::format("{}{}", 23.2 + std::stod(text), text.substr(text.find(',')));
    shifted += '\n';
    at = end + 1;
  }
  MeasurementOptions options;
  options.estimates = {"/body/inertia/principal_kg_m2/0", "/body/inertia/principal_kg_m2/1",
                       "/release/angular_velocity_body_rad_s/0"};
  const MeasurementReport fit = compare_with_measurement({"racquet.json", racquet(0.0188, 0.00121, 5.1)}, {},
                                                         parse_measurement("m.csv", shifted, {{}, {}, 23.2}), options);
  ASSERT_EQ(fit.fit, FitOutcome::converged) << fit.fit_reason;
  EXPECT_TRUE(fit.agrees());
  const double truth[] = {0.01881, 0.001235, 5.4};
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_LT(std::abs(*fit.estimates[j].estimate - truth[j]), 3 * *fit.estimates[j].standard_error);
}

TEST(MeasuredQuantities, WhatASceneDoesNotHaveIsRefused) {
  const std::string heavy = top(R"("tilt_deg": 40, "spin_rad_s": 90)");
  const auto refusal = [](const std::string& scenario, const std::string& quantity, const std::string& row = "1,1") {
    try {
      residuals(scenario, fmt::format("t_s,{}\n{}\n", quantity, row), {{}, {quantity + "=1"}});
    } catch (const ScenarioError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto expect = [](const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_NE(message.find("m.csv:2:1"), std::string::npos) << message;
  };
  expect(refusal(heavy, "tip_L_x_m"),
         "tip_L_x was measured, and the top does not stand on a table; give it /contact, or leave the column out");
  expect(refusal(heavy, "outer_angle_deg"), "the scenario has no gimbals");
  expect(refusal(heavy, "swing_major_deg"),
         "swing_major was measured, and only a symmetric body on a pivot that swings below it");
  expect(refusal(top(R"("tilt_deg": 40, "spin_rad_s": 90, "precession": "steady_slow")"), "tilt_turning_deg", "1,40"),
         "tilt_turning was measured at 1 s, and there is no turning point near this time, or leave the row out");
  expect(refusal(top(R"("tilt_deg": 40, "spin_rad_s": 90)", "", R"("rotation_rate_rad_s": 0)", 0), "precession_period_s"),
         "the azimuth of the axis does not go round within sixteen times that time");
}

}  // namespace
}  // namespace earthtop
