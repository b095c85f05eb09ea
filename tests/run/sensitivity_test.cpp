// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the drift with respect to the inputs, compared with differences of 113-bit runs in which the input was
// changed.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/scenario/inputs.hpp"
#include "earthtop/scene/scene.hpp"
#include "run/sensitivities.hpp"
#include "scene/sensitivity_route.hpp"
#include "support/scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

DriftMeasures<float128> exact_drift(const Scenario& scenario) {
  auto problem = Scene(scenario).problem<float128>();
  problem.times_s = {0, scenario.duration_s};
  IntegrationOptions options;
  options.method = Method::extrapolation;
  options.observer = Observer::body;
  options.form = ModelForm::general;
  options.relative_tolerance = 1e-24;
  return integrate_drift(problem, options).samples.back().measures;
}

/// The scenario's number that belongs to an input, and how much it changes with the input.
struct InputHandle {
  std::function<double&(Scenario&)> number;
  double input_per_number = 1;
};

std::array<InputHandle, kCommonInputs> knobs(const Scenario& scenario) {
  const double I1 = scenario.body.inertia_kg_m2[0][0];
  return {InputHandle{[](Scenario& s) -> double& { return s.site.latitude_deg; }},
          InputHandle{[](Scenario& s) -> double& { return s.site.gravity_m_s2; }},
          InputHandle{[](Scenario& s) -> double& { return s.release.spin_rad_s; }},
          InputHandle{[](Scenario& s) -> double& { return s.release.tilt_deg; }},
          InputHandle{[](Scenario& s) -> double& { return s.rotation_rate_rad_s; }},
          InputHandle{[](Scenario& s) -> double& { return s.body.inertia_kg_m2[2][2]; }, 1 / I1},
          InputHandle{[](Scenario& s) -> double& { return s.body.center_of_mass_m[2]; }}};
}

void expect_exact_derivatives(const Scenario& scenario) {
  Scenario asked = scenario;
  asked.sensitivities = true;
  const auto report = run(asked).sensitivities;
  ASSERT_TRUE(report);
  ASSERT_EQ(report->inputs.size(), kCommonInputs) << report->unavailable;
  EXPECT_EQ(report->at_s, scenario.duration_s);
  const auto numbers = knobs(scenario);
  for (std::size_t i = 0; i < kCommonInputs; ++i) {
    const InputSensitivity& input = report->inputs[i];
    Scenario high = scenario, low = scenario;
    double &up = numbers[i].number(high), &down = numbers[i].number(low);
    const double step = 0x1p-34 * std::max(1e-3, std::abs(up));
    up += step, down -= step;
    const double moved = (up - down) * numbers[i].input_per_number;
    const auto a = exact_drift(high), b = exact_drift(low);
    const auto expect = [&](const char* name, double derivative, float128 at_high, float128 at_low) {
      const auto expected = static_cast<double>((at_high - at_low) / float128(moved));
      EXPECT_NEAR(derivative, expected,
                  testing::truncation(scenario.numerics.relative_tolerance) *
                      (std::abs(expected) + static_cast<double>(real::abs(at_high))))
          << input.name << ", " << name;
    };
    expect("axis", input.axis_rad, a.axis, b.axis);
    const auto exact = static_cast<double>((a.axis - b.axis) / float128(moved));
    EXPECT_LE(std::abs(input.axis_rad - exact),
              input.axis_bound_rad + testing::truncation(scenario.numerics.relative_tolerance) * static_cast<double>(a.axis))
        << input.name;
    EXPECT_LE(input.axis_bound_rad,
              testing::truncation(scenario.numerics.relative_tolerance, 100) * (std::abs(exact) + static_cast<double>(a.axis)))
        << input.name;
    expect("attitude", input.attitude_rad, a.attitude, b.attitude);
    expect("tilt", input.tilt_rad, a.tilt, b.tilt);
    ASSERT_TRUE(input.azimuth_rad);
    expect("azimuth", *input.azimuth_rad, a.azimuth, b.azimuth);
  }
}

TEST(Sensitivity, OfASymmetricTopIsThatOfMovedInputs) {
  Scenario scenario = testing::toy_top();
  scenario.duration_s = 0.3;
  scenario.output_step_s = 0.3;
  expect_exact_derivatives(scenario);
}

TEST(Sensitivity, OfAnAsymmetricTopMatchedInInertialRates) {
  Scenario scenario = testing::asymmetric_top();
  scenario.site.latitude_deg = -33.7;
  scenario.release.rates_relative_to = RatesRelativeTo::inertial;
  scenario.release.azimuth_deg = 33;
  scenario.duration_s = 0.3;
  scenario.output_step_s = 0.3;
  expect_exact_derivatives(scenario);
}

TEST(Sensitivity, OfASteadyPrecessionMovesItsRateToo) {
  Scenario scenario = testing::toy_top();
  scenario.release.precession = Precession::steady_slow;
  scenario.duration_s = 0.5;
  scenario.output_step_s = 0.5;
  Scenario asked = scenario;
  asked.sensitivities = true;
  const auto report = run(asked).sensitivities;
  Scenario high = scenario, low = scenario;
  high.site.gravity_m_s2 += 0x1p-30, low.site.gravity_m_s2 -= 0x1p-30;
  const auto expected = static_cast<double>((exact_drift(high).axis - exact_drift(low).axis) / float128(0x1p-29));
  EXPECT_NEAR(report->inputs[1].axis_rad, expected, testing::rounding(100) * std::abs(expected));
}

TEST(Sensitivity, OfAnAttitudeGivenAsAQuaternion) {
  Scenario angles = testing::toy_top();
  angles.duration_s = angles.output_step_s = 0.3;
  angles.sensitivities = true;
  Scenario quaternion = angles;
  const auto q = release_attitude<double>(angles.release.tilt_deg, angles.release.azimuth_deg, angles.release.spin_angle_deg);
  quaternion.release.quaternion_LB = {q.w, q.v[0], q.v[1], q.v[2]};
  quaternion.release.angular_velocity_body_rad_s = {0, 0, angles.release.spin_rad_s};
  const auto a = run(angles).sensitivities, b = run(quaternion).sensitivities;
  for (std::size_t i = 0; i < kCommonInputs; ++i)
    EXPECT_NEAR(a->inputs[i].axis_rad, b->inputs[i].axis_rad,
                testing::truncation(angles.numerics.relative_tolerance, 100) * std::abs(a->inputs[i].axis_rad))
        << a->inputs[i].name;
}

TEST(Sensitivity, ErrorsOfTheInputsAddUpInSquares) {
  Scenario scenario = testing::toy_top();
  scenario.duration_s = scenario.output_step_s = 1;
  scenario.sensitivities = true;
  scenario.uncertainty = {{0.01, 0, 0.5, 0, 0, 1e-3, 0}};
  const auto report = run(scenario).sensitivities;
  double square = 0;
  for (std::size_t i = 0; i < kCommonInputs; ++i) {
    const double part = report->inputs[i].axis_rad * (*scenario.uncertainty)[i];
    EXPECT_DOUBLE_EQ(report->inputs[i].axis_error_rad, std::abs(part));
    square += part * part;
  }
  EXPECT_NEAR(report->axis_error_rad, std::sqrt(square), 1e-14 * std::sqrt(square));
}

TEST(Sensitivity, AtATinyEarthRateIsProportionalToIt) {
  Scenario scenario = testing::toy_top();
  scenario.duration_s = scenario.output_step_s = 0.5;
  scenario.sensitivities = true;
  const auto ordinary = run(scenario).sensitivities;
  scenario.rotation_rate_rad_s *= 0x1p-900;
  const auto tiny = run(scenario).sensitivities;
  for (std::size_t i = 0; i < kCommonInputs; ++i) {
    const double scale = kInputNames[i] == "rotation_rate_rad_s" ? 1 : 0x1p-900;
    EXPECT_NEAR(tiny->inputs[i].axis_rad / scale, ordinary->inputs[i].axis_rad, 2e-4 * std::abs(ordinary->inputs[i].axis_rad))
        << kInputNames[i];
  }
}

TEST(Sensitivity, SaysWhyThereIsNone) {
  Scenario scenario = testing::toy_top();
  scenario.duration_s = scenario.output_step_s = 0.1;
  EXPECT_FALSE(run(scenario).sensitivities);
  scenario.sensitivities = true;
  scenario.rotation_rate_rad_s = 0;
  EXPECT_NE(run(scenario).sensitivities->unavailable.find("does not turn"), std::string::npos);
  // A body with three different moments at 1e5 rad/s for an hour: no route is cheap.
  scenario = testing::asymmetric_top();
  scenario.sensitivities = true;
  scenario.release.spin_rad_s = 1e5, scenario.duration_s = 3600;
  EXPECT_NE(plan_sensitivities(Scene(scenario), 3600).refusal.find("would take"), std::string::npos);
}

TEST(Sensitivity, SaysHowItsIntegrationEnded) {
  Scenario scenario = testing::toy_top();
  scenario.duration_s = scenario.output_step_s = 0.1;
  scenario.sensitivities = true;
  const RunResult result = run(scenario);
  EXPECT_EQ(assess_sensitivities(result, {})->unavailable, "");
  const std::atomic<bool> stop = true;
  const auto stopped = assess_sensitivities(result, Watch(&stop, nullptr));
  EXPECT_EQ(stopped->unavailable, "their integration ended with interrupted");
  EXPECT_TRUE(stopped->inputs.empty());
}

}  // namespace
}  // namespace earthtop
