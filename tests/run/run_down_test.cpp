// SPDX-License-Identifier: GPL-3.0-or-later
// Runs with applied torques compared with closed forms of their motions: a gyrocompass, and tops that run down.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/run.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/effect_scenes.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

using testing::gyrocompass, testing::spinning_top, testing::stopping_top;

using testing::kPi;

struct NorthAngle {
  double t_s, angle;
};

/// The time at which the angle first passes zero: Lagrange interpolation of the time as a function of the angle, through six
/// points.
double first_zero(const std::vector<NorthAngle>& a) {
  std::size_t first = 3;
  while (first + 3 < a.size() && a[first].angle > 0) ++first;
  double t = 0;
  for (std::size_t j = first - 3; j < first + 3; ++j) {
    double weight = 1;
    for (std::size_t k = first - 3; k < first + 3; ++k)
      if (k != j) weight *= a[k].angle / (a[k].angle - a[j].angle);
    t += weight * a[j].t_s;
  }
  return t;
}

TEST(Gyrocompass, SwingsAboutNorthAsKibbleAndBerkshireHaveIt) {
  // Problem 9.15: T = 2 pi sqrt(I1 / (I3 w W cos(lat))), to the digits of a separate evaluation.
  const std::pair<double, double> published[] = {{0, 20.75621601}, {30, 22.30400563}, {45, 24.68343976}, {60, 29.35372219}};
  for (const auto& [latitude_deg, period_s] : published) {
    constexpr double kAmplitude_deg = 0.1, kAmplitude = kAmplitude_deg * kPi / 180;
    Scenario s = gyrocompass(latitude_deg, kAmplitude_deg, 0);
    s.duration_s = 0.3 * period_s;  // from rest, past North: a quarter
    s.output_step_s = period_s / 200;
    s.numerics.relative_tolerance = 1e-13;
    const auto motion = integrate_drift<double>(Scene(s).problem<double>(), Scene(s).choice().options);
    ASSERT_EQ(motion.status, RunStatus::completed);
    std::vector<NorthAngle> angles;
    for (const auto& sample : motion.samples) {
      const Vec3<double> axis_L = rotation_matrix(sample.state.q_LB).col(2);
      EXPECT_NEAR(axis_L[2], 0, 1e-12);
      angles.push_back({sample.state.t_s, std::atan2(axis_L[0], axis_L[1])});
    }
    // The inertial spin, and the centrifugal torque, which the textbook leaves out.
    const double W_level = s.rotation_rate_rad_s * std::cos(latitude_deg * kPi / 180);
    const double spin = s.release.spin_rad_s + W_level * std::cos(kAmplitude);
    EXPECT_NEAR(2 * kPi / std::sqrt(2 * s.release.spin_rad_s * W_level), period_s, 1e-8);
    const double expected = 2 * kPi / std::sqrt(2 * spin * W_level - W_level * W_level) * (1 + kAmplitude * kAmplitude / 16);
    const double period = 4 * first_zero(angles);
    EXPECT_NEAR(period, expected, 1e-8 * expected) << latitude_deg;
  }
}

TEST(Gyrocompass, DampingBringsItToNorth) {
  // I1 phi'' = -D phi' - k phi, on an Earth so fast that ten seconds of spin are many swings.
  Scenario s = gyrocompass(30, 0.1, 1e-4);
  s.rotation_rate_rad_s = 0.01;
  s.release.spin_rad_s = 200;
  s.duration_s = 12;
  s.output_step_s = 0.05;
  const RunResult result = run(s);
  ASSERT_EQ(result.status, RunStatus::completed);
  const double W_level = 0.01 * std::cos(kPi / 6), spin = 200 + W_level, decay = 1e-4 / (2 * 5e-4);
  const double rate = std::sqrt(2 * spin * W_level - W_level * W_level - decay * decay);
  constexpr double kAmplitude = 0.1 * kPi / 180;
  for (const DriftRow& row : result.rows) {
    const double t = row.t_s;
    const double swing = kAmplitude * std::exp(-decay * t) * (std::cos(rate * t) + decay / rate * std::sin(rate * t));
    // A pendulum's frequency falls by a sixteenth of the amplitude's square.
    EXPECT_NEAR(std::atan2(row.axis_L[0], row.axis_L[1]), swing,
                kAmplitude * kAmplitude * kAmplitude * rate * s.duration_s / 16)
        << t;
  }
}

void expect_spin(const Scenario& s, const std::function<double(double)>& spin) {
  const RunResult result = run(s);
  ASSERT_EQ(result.status, RunStatus::completed);
  for (const DriftRow& row : result.rows) {
    EXPECT_NEAR(row.w_LB_B[2], spin(row.t_s), testing::rounding(1000) * s.release.spin_rad_s) << row.t_s;
    EXPECT_NEAR(row.ref_w_LB_B[2], spin(row.t_s), testing::rounding(1000) * s.release.spin_rad_s) << row.t_s;
    EXPECT_EQ(row.drift_attitude_rad, 0);
  }
}

constexpr double kI3OfTheToyTop = 4e-5;

TEST(SpinDown, Viscous) {
  Scenario s = spinning_top();
  s.effects.applied.viscous_N_m_s = 1e-5;
  expect_spin(s, [](double t) { return 100 * std::exp(-1e-5 / kI3OfTheToyTop * t); });
}

TEST(SpinDown, Quadratic) {
  Scenario s = spinning_top();
  s.effects.applied.quadratic_N_m_s2 = 1e-7;
  expect_spin(s, [](double t) { return 100 / (1 + 1e-7 * 100 * t / kI3OfTheToyTop); });
}

TEST(SpinDown, DiscInAir) {
  Scenario s = spinning_top();
  AirDragSpec& air = s.effects.applied.air_drag.emplace();
  air.disc_radius_m = 0.1;
  const double R = air.disc_radius_m, rho = air.density_kg_m3, nu = air.kinematic_viscosity_m2_s;
  air.flow = DiscFlow::laminar;
  const double laminar = 3.87 / 2 * rho * std::pow(R, 4) * std::sqrt(nu);
  expect_spin(s, [&](double t) { return std::pow(1 / std::sqrt(100.0) + laminar * t / (2 * kI3OfTheToyTop), -2); });
  air.flow = DiscFlow::turbulent;
  const double turbulent = 0.146 / 2 * rho * std::pow(R, 4.6) * std::pow(nu, 0.2);
  expect_spin(s, [&](double t) { return std::pow(std::pow(100, -0.8) + 4 * turbulent * t / (5 * kI3OfTheToyTop), -1.25); });
}

void expect_stops(const RunResult& result, double at_s) {
  ASSERT_EQ(result.stops.size(), 2U);
  EXPECT_NE(result.stops[0].prediction, result.stops[1].prediction);
  for (const StopEvent& stop : result.stops) {
    ASSERT_TRUE(stop.bound_s);
    EXPECT_NEAR(stop.t_s, at_s, *stop.bound_s);
    EXPECT_LE(*stop.bound_s,
              1e-10 * at_s);  // thrice the tolerance, over the part of the time in which the last digits of the spin go
  }
}

TEST(SpinDown, DryFrictionStopsTheTop) {
  Scenario s = spinning_top();
  s.effects.applied.coulomb_N_m = 2e-3;
  const double stop_s = kI3OfTheToyTop * 100 / 2e-3;
  expect_spin(s, [&](double t) { return t < stop_s ? 100 - 2e-3 / kI3OfTheToyTop * t : 0; });
  expect_stops(run(s), stop_s);
  s.effects.applied.viscous_N_m_s = 1e-5;
  constexpr double kLimit = 2e-3 / 1e-5;
  const double sooner_s = kI3OfTheToyTop / 1e-5 * std::log(1 + 100 / kLimit);
  expect_spin(s, [&](double t) { return t < sooner_s ? (100 + kLimit) * std::exp(-1e-5 / kI3OfTheToyTop * t) - kLimit : 0; });
  expect_stops(run(s), sooner_s);
}

TEST(DryFriction, RowsBetweenTheTwoStopsAreNotReliable) {
  // At the pole, of a vertical axis: the Earth turns as the top does, and the laboratory sees so much less of its spin.
  const RunResult result = run(stopping_top(90, 0, 1));
  ASSERT_EQ(result.status, RunStatus::completed);
  ASSERT_EQ(result.stops.size(), 2U);
  const double first_s = kI3OfTheToyTop * 99 / 2e-3, last_s = kI3OfTheToyTop * 100 / 2e-3;
  EXPECT_EQ(result.stops[0].prediction, Prediction::rotating);
  EXPECT_EQ(result.stops[1].prediction, Prediction::reference);
  EXPECT_NEAR(result.stops[0].t_s, first_s, result.stops[0].bound_s.value());
  EXPECT_NEAR(result.stops[1].t_s, last_s, result.stops[1].bound_s.value());
  int between = 0;
  for (const DriftRow& row : result.rows) {
    const double t = row.t_s;
    EXPECT_NEAR(row.w_LB_B[2], t < first_s ? 99 - 2e-3 / kI3OfTheToyTop * t : 0, testing::rounding(500) * 100) << t;
    EXPECT_NEAR(row.ref_w_LB_B[2], t < last_s ? 100 - 2e-3 / kI3OfTheToyTop * t : 0, testing::rounding(500) * 100) << t;
    if (std::abs(t - first_s) < *result.stops[0].bound_s) continue;  // at the stop itself
    if (t < first_s) {
      EXPECT_TRUE(row.drift_reliable) << t;
      EXPECT_NEAR(row.drift_spin_rad, -t, testing::rounding(1000));
    } else if (t < last_s) {
      EXPECT_FALSE(row.drift_reliable) << t;
      ++between;
    } else {
      EXPECT_EQ(row.drift_spin_rad, result.rows.back().drift_spin_rad);
    }
  }
  EXPECT_EQ(between, 3);
}

TEST(DryFriction, BothPredictionsStopAndTheBoundHolds) {
  for (const double rate : {kEarthRateWgs84, -1e-3, 0.3, 1.0}) {
    SCOPED_TRACE(rate);
    const Scenario s = stopping_top(45, 35, rate);
    const RunResult result = run(s);
    ASSERT_EQ(result.status, RunStatus::completed);
    ASSERT_EQ(result.stops.size(), 2U);
    // The spins differ by no more than the Earth's rate.
    for (const StopEvent& stop : result.stops) EXPECT_NEAR(stop.t_s, 2, kI3OfTheToyTop / 2e-3 * std::abs(rate) + 4e-8);
    IntegrationOptions options;
    options.observer = Observer::body, options.method = Method::extrapolation, options.relative_tolerance = 1e-13;
    const auto finer = integrate_drift(Scene(s).problem<double>(), options);
    ASSERT_EQ(finer.samples.size(), result.rows.size());
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
      const DriftRow& row = result.rows[i];
      const DriftMeasures<double>& exact = finer.samples[i].measures;
      EXPECT_NEAR(row.drift_axis_rad, exact.axis, row.drift_axis_bound_rad) << row.t_s;
      EXPECT_NEAR(row.drift_attitude_rad, exact.attitude, row.drift_attitude_bound_rad) << row.t_s;
      if (row.t_s <= result.stops[1].t_s) continue;
      for (const double w : row.w_LB_B) EXPECT_EQ(w, 0);
      for (const double w : row.ref_w_LB_B) EXPECT_EQ(w, 0);
      EXPECT_EQ(row.drift_axis_rad, result.rows.back().drift_axis_rad);
    }
  }
}

/// The angle from Up at which a pendulum released at rest comes to rest, from the energy that dry friction takes on its way.
double resting_angle(double angle, double gravity_torque, double friction) {
  for (double direction = 1; gravity_torque * std::abs(std::sin(angle)) > friction; direction = -direction) {
    // Zero at release, positive on the way, and zero where it turns round.
    const auto energy = [&](double way) {
      return gravity_torque * (std::cos(angle) - std::cos(angle + direction * way)) - friction * way;
    };
    double before = 1e-3, after = before;
    while (energy(after) > 0) before = after, after += 1e-3;
    for (int i = 0; i < 60; ++i) {
      const double middle = (before + after) / 2;
      (energy(middle) > 0 ? before : after) = middle;
    }
    angle += direction * after;
  }
  return angle;
}

TEST(DryFriction, APendulumTurnsRoundUntilFrictionHoldsIt) {
  for (const double rate : {0.0, kEarthRateWgs84}) {
    Scenario s = testing::toy_top();
    s.rotation_rate_rad_s = rate;
    s.release.spin_rad_s = 0;
    s.effects.applied.coulomb_N_m = 0.005;
    s.duration_s = 2;
    const RunResult result = run(s);
    ASSERT_EQ(result.status, RunStatus::completed);
    EXPECT_EQ(result.stops.size(), 2U);
    const double angle = resting_angle(kPi / 9, 0.1 * 9.80665 * 0.03, 0.005);
    const DriftRow& last = result.rows.back();
    EXPECT_NEAR(last.ref_axis_L[0], std::sin(angle), 1e-9);
    EXPECT_NEAR(last.ref_axis_L[2], std::cos(angle), 1e-9);
    EXPECT_NEAR(last.axis_L[0], std::sin(angle), rate + 1e-9);
  }
}

}  // namespace
}  // namespace earthtop
