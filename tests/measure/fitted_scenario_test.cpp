// SPDX-License-Identifier: GPL-3.0-or-later
// Scenarios with estimates put in: they must be the motion of the fit, to the last bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "earthtop/frames/rotation.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "measure/made_up_measurements.hpp"

namespace earthtop {
namespace {

using namespace test;

const char* const kTopWithNote = R"({
  "_note": "kept as it is: 1.50, {",
  "site": { "latitude_deg": 45.0, "height_m": 0 },
  "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
            "inertia": { "principal_kg_m2": [1.20e-4, 1.20e-4, 4e-5] } },
  "release": { "tilt_deg": 20, "azimuth_deg": 90, "spin_rad_s": 200 },
  "motion": { "duration_s": 5 }
})";

class FittedScenario : public MeasurementTest {
 protected:
  static void expect_refused(const std::function<void()>& work, const std::string& words) {
    try {
      work();
      ADD_FAILURE() << words;
    } catch (const ScenarioError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  ScenarioSource source() const { return {(directory_.path() / "top.json").string(), kTopWithNote}; }
  /// The motion of a slightly other top, with errors.
  Measurement measurement(const Overrides& truth) const {
    Overrides set = truth;
    set.emplace_back("/motion/output_step_s", "0.25");
    Normal normal(21);
    std::string csv = "t_s,azimuth_rad,azimuth_se_rad,tilt_rad,tilt_se_rad\n";
    for (const DriftRow& row : run(parse_scenario(source(), set)).rows) {
      const auto& q = row.q_LB;
      const Vec3<double> n_L = rotation_matrix(Quaternion<double>{q[0], Vec3<double>(q[1], q[2], q[3])}).col(2);
      csv += fmt::format("{},{},1e-5,{},1e-5\n", row.t_s, azimuth(n_L) + 1e-5 * normal(), tilt(n_L) + 1e-5 * normal());
    }
    return read(csv);
  }
  /// Fits, writes the scenario, and compares it with the same measurement.
  void expect_same_motion(const std::vector<std::string>& names, const Overrides& set, const Overrides& truth) const {
    const std::string file = (directory_.path() / "fitted.json").string();
    const Measurement data = measurement(truth);
    const auto fit = compare_with_measurement(source(), set, data, {.estimates = names});
    ASSERT_TRUE(fit.fitted) << fit.fit_reason;
    require_writable_scenario(source(), set, file);
    const std::string text = fitted_scenario(source(), set, fit, file);
    const auto again = compare_with_measurement({file, text}, {}, data);
    EXPECT_EQ(again.as_given.value, fit.fitted->value) << text;
    ASSERT_EQ(again.residuals.size(), fit.residuals.size());
    for (std::size_t i = 0; i < fit.residuals.size(); ++i)
      EXPECT_EQ(again.residuals[i].residual, fit.residuals[i].residual) << i;
    EXPECT_NE(again.as_given.value, fit.as_given.value);
    EXPECT_NE(text.find("\"_note\": \"kept as it is: 1.50, {\""), text.npos) << text;
    EXPECT_EQ(again.scenario_name, "fitted");
  }
};

TEST_F(FittedScenario, IsTheMotionOfTheFit) {
  expect_same_motion({"spin_rad_s", "tilt_deg"}, {}, {{"/release/spin_rad_s", "200.01"}, {"/release/tilt_deg", "20.001"}});
  expect_same_motion({"/release/azimuth_deg", "rotation_rate_rad_s"}, {}, {{"/release/azimuth_deg", "90.01"}});
  expect_same_motion({"/body/inertia/principal_kg_m2/2", "/body/center_of_mass_m/2"}, {{"/site/gravity_m_s2", "9.81"}},
                     {{"/site/gravity_m_s2", "9.81"}, {"/body/center_of_mass_m/2", "0.030001"}});
  expect_same_motion({"gravity_m_s2"}, {}, {});
  // A spin in the other unit takes the place of the text's.
  expect_same_motion({"tilt_deg"}, {{"/release/spin_rpm", "1909"}},
                     {{"/release/spin_rpm", "1909"}, {"/release/tilt_deg", "20.001"}});
}

// A component of the Earth's rate becomes rate and latitude; gravity, which follows the latitude by default, stays.
TEST_F(FittedScenario, HasTheVerticalRate) {
  expect_same_motion({"omega_sin_latitude_rad_s"}, {}, {{"/earth/rotation_rate_rad_s", "1e-3"}});
  expect_same_motion({"omega_sin_latitude_rad_s", "/release/azimuth_deg"},
                     {{"/site/gravity_m_s2", "9.8"}, {"/effects/excess_length_of_day_ms", "2"}},
                     {{"/site/gravity_m_s2", "9.8"}, {"/earth/rotation_rate_rad_s", "-1e-3"}});
}

TEST_F(FittedScenario, HasInputsThatAreNoNumbersOfTheText) {
  expect_same_motion({"omega_cos_latitude_rad_s", "omega_sin_latitude_rad_s"}, {}, {{"/earth/rotation_rate_rad_s", "1e-3"}});
  expect_same_motion({"inertia_ratio", "center_of_mass_m"}, {}, {{"/body/center_of_mass_m/2", "0.030001"}});
}

// A coefficient of a table's friction from the axis of a top that slips on it, as `run` computes it.
TEST_F(FittedScenario, HasACoefficientOfFriction) {
  const auto top = shipped("toy-top-on-table");
  std::string csv = "t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_rad\n";
  for (const DriftRow& row : run(parse_scenario(top, {{"/motion/duration_s", "1"}, {"/motion/output_step_s", "0.1"}})).rows) {
    const auto& q = row.q_LB;
    const Vec3<double> n_L = rotation_matrix(Quaternion<double>{q[0], Vec3<double>(q[1], q[2], q[3])}).col(2);
    csv += fmt::format("{},{},{},{},1e-5\n", row.t_s, n_L[0], n_L[1], n_L[2]);
  }
  const Measurement data = read(csv);
  const Overrides more = {{"/contact/friction_coefficient", "0.201"}};
  const auto fit = compare_with_measurement(top, more, data, {.estimates = {"/contact/friction_coefficient"}});
  ASSERT_TRUE(fit.fitted) << fit.fit_reason;
  // The fit ends within a thousandth of a standard error of the least sum, which is 0; the data have no errors of their own but
  // twelve digits.
  EXPECT_NEAR(*fit.estimates[0].estimate, 0.2, 2e-3 * *fit.estimates[0].standard_error);
  EXPECT_LT(*fit.estimates[0].standard_error, 1e-3) << "the data must determine it";
  const std::string file = (directory_.path() / "fitted.json").string();
  const std::string text = fitted_scenario(top, more, fit, file);
  EXPECT_EQ(compare_with_measurement({file, text}, {}, data).as_given.value, fit.fitted->value);
  // The scenario's claims on its own numbers are no claims on these.
  EXPECT_NE(top.text.find("\"headline\""), top.text.npos);
  EXPECT_EQ(text.find("\"headline\""), text.npos);
}

TEST_F(FittedScenario, IsRefusedWithoutAFit) {
  const Measurement data = measurement({});
  const auto report = compare_with_measurement(source(), {}, data, {.estimates = {"/release/spin_angle_deg"}});
  EXPECT_EQ(report.fit, FitOutcome::not_determined);
  expect_refused([&] { fitted_scenario(source(), {}, report, "fitted.json"); },
                 "there is no fit whose estimates could be written");
  auto fitted = compare_with_measurement(source(), {}, data, {.estimates = {"tilt_deg"}});
  fitted.estimates[0].estimate = 181;
  expect_refused([&] { fitted_scenario(source(), {}, fitted, "fitted.json"); }, "no scenario has these estimates");
}

// A spin in revolutions gives way to an estimated one in radians, and an anomaly of gravity to gravity itself, where the latitude
// is estimated without it.
TEST_F(FittedScenario, HasOneOfTwoKeysForAQuantity) {
  expect_same_motion({"spin_rad_s"}, {{"/release/spin_rpm", "1910"}}, {{"/release/spin_rad_s", "199"}});
  expect_same_motion({"omega_sin_latitude_rad_s"}, {{"/site/gravity_anomaly_m_s2", "1e-3"}}, {{"/site/latitude_deg", "47"}});
}

// A scenario that names a file is another one in another directory.
TEST_F(FittedScenario, IsRefusedWhereItsFilesAreNot) {
  std::ofstream(directory_.path() / "platform.csv") << "t_s,angle_rad\n0,0\n1,0.1\n2,0.2\n3,0.3\n10,1\n";
  const Overrides set = {{"/platform", R"({"motion": "table", "axis": [0, 0, 1], "file": "platform.csv"})"}};
  EXPECT_NO_THROW(require_writable_scenario(source(), set, (directory_.path() / "fitted.json").string()));
  EXPECT_THROW(require_writable_scenario(source(), set, (directory_.path() / "below" / "fitted.json").string()), ScenarioError);
}

}  // namespace
}  // namespace earthtop
